//! Polygonisation of the left half of an implicit function: marching tetrahedra over an uneven grid.
//!
//! Every cell is cut into the six tetrahedra round its main diagonal, so that neighbouring cells agree on their
//! common face and the result is a manifold for any function. The first grid plane is x = 0, where the half is open.

use glam::DVec3;
use rayon::prelude::*;

use super::field::Field;
use crate::geometry::mesh::TriMesh;

/// Number of cells along each side of the blocks that are tested for emptiness.
const BLOCK: usize = 4;

/// A grid: ascending coordinates of its planes along each axis.
#[derive(Clone, Debug)]
pub struct Grid {
    /// Coordinates of the planes across x, y and z, metres. The first across x is 0.
    pub planes: [Vec<f64>; 3],
}

impl Grid {
    /// Coordinates of planes from `from` to `to`, about `spacing(x)` apart; their number makes whole blocks.
    pub fn planes(from: f64, to: f64, spacing: impl Fn(f64) -> f64) -> Vec<f64> {
        let mut planes = vec![from];
        let mut at = from;
        while at < to || !(planes.len() - 1).is_multiple_of(BLOCK) {
            at += spacing(at);
            planes.push(at);
        }
        planes
    }

    fn cells(&self, axis: usize) -> usize {
        self.planes[axis].len() - 1
    }

    fn point(&self, [i, j, k]: [usize; 3]) -> DVec3 {
        DVec3::new(self.planes[0][i], self.planes[1][j], self.planes[2][k])
    }
}

/// The surface where `field` is zero, over `grid`: open at x = 0, facing outward.
pub fn polygonised(field: &Field, grid: &Grid) -> TriMesh {
    let blocks = near_blocks(field, grid);
    let nodes = Nodes::evaluate(field, grid, &blocks);
    let mut out = Builder {
        grid,
        nodes: &nodes,
        slots: vec![[u32::MAX; 7]; nodes.values.len()],
        mesh: TriMesh::default(),
    };
    for block in &blocks {
        for_each_in(*block, |cell| out.cell(cell));
    }
    out.mesh
}

fn for_each_in(block: [usize; 3], mut f: impl FnMut([usize; 3])) {
    for i in 0..BLOCK {
        for j in 0..BLOCK {
            for k in 0..BLOCK {
                f([block[0] + i, block[1] + j, block[2] + k]);
            }
        }
    }
}

/// The first cells of all blocks through which the surface may pass.
fn near_blocks(field: &Field, grid: &Grid) -> Vec<[usize; 3]> {
    let [nx, ny, nz] = [0, 1, 2].map(|a| grid.cells(a) / BLOCK);
    (0..nx)
        .into_par_iter()
        .flat_map_iter(|i| {
            let mut near = Vec::new();
            for j in 0..ny {
                for k in 0..nz {
                    let first = [i * BLOCK, j * BLOCK, k * BLOCK];
                    let lower = grid.point(first);
                    let upper = grid.point(first.map(|c| c + BLOCK));
                    // The field is only approximately a distance: leave a margin.
                    let reach = 1.3 * (upper - lower).length() + 0.006;
                    if field.value((lower + upper) / 2.0).abs() < reach {
                        near.push(first);
                    }
                }
            }
            near
        })
        .collect()
}

struct Nodes {
    /// For each grid node its index among the evaluated ones; `u32::MAX` for the others.
    index: Vec<u32>,
    stride: [usize; 2],
    values: Vec<f64>,
}

impl Nodes {
    fn evaluate(field: &Field, grid: &Grid, blocks: &[[usize; 3]]) -> Self {
        let [nx, ny, nz] = [0, 1, 2].map(|a| grid.planes[a].len());
        let stride = [ny * nz, nz];
        let mut index = vec![u32::MAX; nx * ny * nz];
        let mut places = Vec::new();
        for b in blocks {
            for i in 0..=BLOCK {
                for j in 0..=BLOCK {
                    for k in 0..=BLOCK {
                        let node = [b[0] + i, b[1] + j, b[2] + k];
                        let at = node[0] * stride[0] + node[1] * stride[1] + node[2];
                        if index[at] == u32::MAX {
                            index[at] = places.len() as u32;
                            places.push(node);
                        }
                    }
                }
            }
        }
        let values = places.par_iter().map(|&node| field.value(grid.point(node))).collect();
        Self { index, stride, values }
    }

    fn of(&self, [i, j, k]: [usize; 3]) -> u32 {
        self.index[i * self.stride[0] + j * self.stride[1] + k]
    }
}

struct Builder<'a> {
    grid: &'a Grid,
    nodes: &'a Nodes,
    /// For each node the mesh vertices on the seven edges that leave it in ascending direction.
    slots: Vec<[u32; 7]>,
    mesh: TriMesh,
}

/// The six tetrahedra of a cell, four corners each, as bits of steps along the axes (bit 0: x, 1: y, 2: z); all have
/// the same orientation.
const TETRAHEDRA: [[u8; 4]; 6] =
    [[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]];

impl Builder<'_> {
    fn cell(&mut self, cell: [usize; 3]) {
        let corner = |bits: u8| [0, 1, 2].map(|a| cell[a] + usize::from(bits >> a & 1));
        let value = |bits: u8| self.nodes.values[self.nodes.of(corner(bits)) as usize];
        let inside: u8 = (0..8u8).map(|c| u8::from(value(c) < 0.0) << c).sum();
        if inside == 0 || inside == 255 {
            return;
        }
        for tetrahedron in TETRAHEDRA {
            self.tetrahedron(cell, tetrahedron, inside);
        }
    }

    fn tetrahedron(&mut self, cell: [usize; 3], [a, b, c, d]: [u8; 4], inside: u8) {
        let is = |corner: u8| inside >> corner & 1 == 1;
        // Even permutations of the corners that bring the odd one, or the inner pair, to the front.
        let count = [a, b, c, d].into_iter().filter(|&x| is(x)).count();
        let orders = [
            [a, b, c, d],
            [b, a, d, c],
            [c, d, a, b],
            [d, c, b, a],
            [a, c, d, b],
            [a, d, b, c],
            [b, c, a, d],
            [b, d, c, a],
        ];
        match count {
            1 | 3 => {
                let lone = count == 1;
                let Some(&[p, q, r, s]) = orders[..4].iter().find(|o| is(o[0]) == lone) else { return };
                let [x, y, z] = [q, r, s].map(|o| self.vertex(cell, p, o));
                self.mesh.triangles.push(if lone { [x, y, z] } else { [x, z, y] });
            }
            2 => {
                let Some(&[p, q, r, s]) = orders.iter().find(|o| is(o[0]) && is(o[1])) else { return };
                let [w, x, y, z] = [(p, r), (p, s), (q, s), (q, r)].map(|(i, o)| self.vertex(cell, i, o));
                self.mesh.triangles.push([w, x, y]);
                self.mesh.triangles.push([w, y, z]);
            }
            _ => {}
        }
    }

    /// The mesh vertex on the edge between two corners of a cell, created on first use.
    fn vertex(&mut self, cell: [usize; 3], a: u8, b: u8) -> u32 {
        // All edges run along ascending axes: the steps of one end contain those of the other.
        let (low, high) = if a & b == a { (a, b) } else { (b, a) };
        let corner = |bits: u8| [0, 1, 2].map(|axis| cell[axis] + usize::from(bits >> axis & 1));
        let (from, to) = (corner(low), corner(high));
        let (i, j) = (self.nodes.of(from) as usize, self.nodes.of(to) as usize);
        let slot = usize::from(high ^ low) - 1;
        if self.slots[i][slot] == u32::MAX {
            let (u, v) = (self.nodes.values[i], self.nodes.values[j]);
            let t = (u / (u - v)).clamp(0.03, 0.97);
            let (p, q) = (self.grid.point(from), self.grid.point(to));
            self.slots[i][slot] = self.mesh.positions.len() as u32;
            self.mesh.positions.push(p + (q - p) * t);
        }
        self.slots[i][slot]
    }
}
