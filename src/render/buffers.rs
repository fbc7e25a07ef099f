//! Meshes on the device. A mesh is kept from one picture to the next while each of them draws it.

use std::sync::Arc;

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3, Vec4};

use super::decal::{Decal, MOST_DECALS, pictures};
use super::picture_array::PictureArray;
use super::pipelines::{MESH_STRIDE, Pipelines};
use super::scene::Mesh;
use super::srgb::linear;
use super::strokes::Stroke;
use super::{Gpu, RenderError};

/// The GPU buffers of a mesh.
#[derive(Debug)]
pub(super) struct DeviceMesh {
    mesh: Arc<Mesh>,
    pub(super) vertices: wgpu::Buffer,
    pub(super) indices: wgpu::Buffer,
    pub(super) index_count: u32,
    /// Index buffer of all edges, for [`Wire::Thin`], and the number of its indices; made when the edges are first drawn so.
    pub(super) edges: Option<(wgpu::Buffer, u32)>,
    /// The edges as they were drawn last as strokes: the buffer of these and their number.
    strokes: Option<(Wire, wgpu::Buffer, u32)>,
    pub(super) material: wgpu::BindGroup,
    /// The pictures of its decals.
    pictures: PictureArray,
}

/// How the edges of triangles are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Wire {
    /// As lines of one pixel.
    Thin,
    /// As strokes: `half_width` pixels, nearer to the eye by `lift` metres.
    Strokes { half_width: f32, lift: f32 },
}

impl Wire {
    /// Lines as wide as `drawn_per_pixel` pixels (see [`Look::drawn_per_pixel`](super::Look)); strokes are nearer to the eye by
    /// `lift` metres.
    pub(super) fn new(drawn_per_pixel: f32, lift: f32) -> Self {
        if drawn_per_pixel > 1.0 {
            Self::Strokes { half_width: drawn_per_pixel / 2.0, lift }
        } else {
            Self::Thin
        }
    }
}

/// Colour of edges of triangles and opacity, sRGB. As in shaders/wire.wgsl.
const WIRE: [u8; 4] = [15, 23, 20, 128];

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Vertex {
    position: Vec3,
    normal: Vec3,
    colour: [u8; 4],
    flat: Vec2,
}

/// Matches `Material` in shaders/material.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Material {
    front: Vec4,
    back: Vec4,
    second: Vec4,
    threads: Vec4,
    gloss: Vec4,
    print: Vec4,
    repeat: Vec4,
    decals: [PlacedPicture; MOST_DECALS],
}

/// Matches `PlacedPicture` in shaders/material.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Default, Pod, Zeroable)]
struct PlacedPicture {
    map: Vec4,
    place: Vec4,
}

impl PlacedPicture {
    fn of((decal, layer): (&Decal, &usize)) -> Self {
        let (map, move_by) = decal.picture_from_flat;
        Self {
            map: Vec4::new(map.x_axis.x, map.x_axis.y, map.y_axis.x, map.y_axis.y),
            place: Vec4::new(move_by.x, move_by.y, *layer as f32, f32::from(u8::from(decal.repeats))),
        }
    }
}

impl Material {
    /// The material of `mesh`; `layers` are the layers of the pictures of its decals.
    fn of(mesh: &Mesh, layers: &[usize]) -> Self {
        let textile = &mesh.textile;
        let [weave, print] = if mesh.flat.is_empty() { [0; 2] } else { [textile.weave, textile.print] };
        let count = if mesh.flat.is_empty() { 0 } else { mesh.decals.len().min(MOST_DECALS) };
        let mut decals = [PlacedPicture::default(); MOST_DECALS];
        for (place, decal) in decals.iter_mut().zip(mesh.decals.iter().zip(layers)).take(count) {
            *place = PlacedPicture::of(decal);
        }
        let second = linear(textile.second.unwrap_or(mesh.front));
        Self {
            front: linear(mesh.front).extend(if mesh.covered { 1.0 } else { mesh.cloth }),
            back: linear(mesh.back).extend(0.0),
            second: second.extend(weave as f32),
            threads: Vec4::new(textile.pitch, textile.relief, textile.sheen, textile.slubs),
            gloss: Vec4::new(textile.gloss, textile.roughness, textile.cover, textile.along),
            print: linear(textile.ink).extend(print as f32),
            repeat: Vec4::new(textile.repeat, textile.mean_cover, count as f32, 0.0),
            decals,
        }
    }
}

/// Uploads the meshes of one picture, reusing those of the last one; with `wire` also the edges of cloth, unless they are there.
pub(super) fn upload(
    gpu: &Gpu,
    pipelines: &Pipelines,
    mut last: Vec<DeviceMesh>,
    meshes: &[Arc<Mesh>],
    wire: Option<Wire>,
) -> Result<Vec<DeviceMesh>, RenderError> {
    let mut known: Vec<PictureArray> = last.iter().map(|mesh| mesh.pictures.clone()).collect();
    let mut all: Vec<DeviceMesh> = meshes
        .iter()
        .filter(|m| !m.triangles.is_empty())
        .map(|mesh| match last.iter().position(|d| Arc::ptr_eq(&d.mesh, mesh)) {
            Some(i) => Ok(last.swap_remove(i)),
            None => DeviceMesh::new(gpu, pipelines, mesh, &mut known),
        })
        .collect::<Result<_, _>>()?;
    for mesh in all.iter_mut().filter(|mesh| mesh.is_cloth()) {
        match wire {
            Some(Wire::Thin) if mesh.edges.is_none() => mesh.edges = Some(mesh.edge_buffer(gpu)),
            Some(strokes @ Wire::Strokes { half_width, lift }) if mesh.strokes_as(strokes).is_none() => {
                let (buffer, count) = mesh.stroke_buffer(gpu, half_width, lift);
                mesh.strokes = Some((strokes, buffer, count));
            }
            _ => {}
        }
    }
    Ok(all)
}

impl DeviceMesh {
    /// Uploads `mesh`, and its pictures unless they are `known`.
    fn new(
        gpu: &Gpu,
        pipelines: &Pipelines,
        mesh: &Arc<Mesh>,
        known: &mut Vec<PictureArray>,
    ) -> Result<Self, RenderError> {
        let limit = gpu.device.limits().max_buffer_size;
        if mesh.positions.len() as u64 * MESH_STRIDE > limit || mesh.triangles.len() as u64 * 12 > limit {
            return Err(RenderError::TooLarge {
                what: format!("a mesh of {} triangles", mesh.triangles.len()),
                limit: format!("{} MiB a buffer", limit >> 20),
            });
        }
        let count = mesh.positions.len() as u32;
        let indices: Vec<[u32; 3]> =
            mesh.triangles.iter().copied().filter(|t| t.iter().all(|&v| v < count)).collect();
        let (vertices, indices) = flat_vertices(mesh, vertices(mesh), indices);
        let (pictures, layers) = pictures(&mesh.decals);
        let pictures = match known.iter().find(|other| other.has(&pictures)) {
            Some(found) => found.clone(),
            None => {
                let made = PictureArray::new(gpu, pictures);
                known.push(made.clone());
                made
            }
        };
        let material = Material::of(mesh, &layers);
        let material = gpu.buffer("material", bytemuck::bytes_of(&material), wgpu::BufferUsages::UNIFORM);
        Ok(Self {
            mesh: Arc::clone(mesh),
            vertices: gpu.buffer("vertices", bytemuck::cast_slice(&vertices), wgpu::BufferUsages::VERTEX),
            indices: gpu.buffer("indices", bytemuck::cast_slice(&indices), wgpu::BufferUsages::INDEX),
            index_count: indices.len() as u32 * 3,
            edges: None,
            strokes: None,
            material: bind(
                gpu,
                &pipelines.material_layout,
                &[
                    material.as_entire_binding(),
                    wgpu::BindingResource::TextureView(&pictures.view),
                    wgpu::BindingResource::Sampler(&pipelines.picture_sampler),
                ],
            ),
            pictures,
        })
    }

    /// Whether the mesh is woven cloth, not skin.
    pub(super) fn is_cloth(&self) -> bool {
        self.mesh.cloth > 0.5
    }

    /// Whether it is transparent cloth.
    pub(super) fn is_open(&self) -> bool {
        self.is_cloth() && self.mesh.textile.mean_cover < 1.0
    }

    /// Its edges as they are drawn as `wire`, where that are strokes and they are uploaded: the buffer of these and their number.
    pub(super) fn strokes_as(&self, wire: Wire) -> Option<(&wgpu::Buffer, u32)> {
        self.strokes.as_ref().filter(|(made, ..)| *made == wire).map(|(_, buffer, count)| (buffer, *count))
    }

    /// Uploads lines along all edges, one stroke each; returns their number, too.
    fn stroke_buffer(&self, gpu: &Gpu, half_width: f32, lift: f32) -> (wgpu::Buffer, u32) {
        let positions = &self.mesh.positions;
        let edges = edges(&self.mesh.triangles, positions.len() as u32);
        let stroke = |[a, b]: [u32; 2]| {
            Stroke::along(positions[a as usize], positions[b as usize], WIRE, half_width, lift)
        };
        let strokes: Vec<Stroke> = edges.into_iter().map(stroke).collect();
        let buffer = gpu.buffer("strokes", bytemuck::cast_slice(&strokes), wgpu::BufferUsages::VERTEX);
        (buffer, strokes.len() as u32)
    }

    fn edge_buffer(&self, gpu: &Gpu) -> (wgpu::Buffer, u32) {
        let edges = edges(&self.mesh.triangles, self.mesh.positions.len() as u32);
        let buffer = gpu.buffer("edges", bytemuck::cast_slice(&edges), wgpu::BufferUsages::INDEX);
        (buffer, edges.len() as u32 * 2)
    }
}

/// Both ends of every edge, each edge once. Triangles with an index of `count` or more are left out.
fn edges(triangles: &[[u32; 3]], count: u32) -> Vec<[u32; 2]> {
    let inside = triangles.iter().filter(|t| t.iter().all(|&v| v < count));
    let ends = inside.flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let mut all: Vec<[u32; 2]> = ends.map(|[a, b]| [a.min(b), a.max(b)]).collect();
    all.sort_unstable();
    all.dedup();
    all
}

fn vertices(mesh: &Mesh) -> Vec<Vertex> {
    let computed;
    let normals = if mesh.normals.len() == mesh.positions.len() {
        &mesh.normals
    } else {
        computed = area_weighted_normals(mesh);
        &computed
    };
    let coloured = mesh.colours.len() == mesh.positions.len();
    mesh.positions
        .iter()
        .zip(normals)
        .enumerate()
        .map(|(i, (&position, &normal))| {
            let [r, g, b] = if coloured { mesh.colours[i] } else { [255; 3] };
            Vertex { position, normal, colour: [r, g, b, 255], flat: Vec2::ZERO }
        })
        .collect()
}

/// Writes texture coordinates into `vertices`. A vertex with several, as on a seam, or with several wedges, as on a fold line, is
/// duplicated; returns the vertices and the triangles that use them.
fn flat_vertices(
    mesh: &Mesh,
    mut vertices: Vec<Vertex>,
    mut triangles: Vec<[u32; 3]>,
) -> (Vec<Vertex>, Vec<[u32; 3]>) {
    if mesh.flat.len() != triangles.len() {
        return (vertices, triangles);
    }
    // Next duplicate of each vertex, and whether its coordinates are set.
    let mut next: Vec<u32> = vec![u32::MAX; vertices.len()];
    let mut is_set = vec![false; vertices.len()];
    let mut wedges: Vec<u32> = vec![0; vertices.len()];
    for (t, (triangle, flat)) in triangles.iter_mut().zip(&mesh.flat).enumerate() {
        let own = mesh.wedges.get(t).copied().unwrap_or_default();
        for ((corner, &place), wedge) in triangle.iter_mut().zip(flat).zip(own) {
            let mut v = *corner as usize;
            while is_set[v] && (vertices[v].flat, wedges[v]) != (place, wedge) && next[v] != u32::MAX {
                v = next[v] as usize;
            }
            if is_set[v] && (vertices[v].flat, wedges[v]) != (place, wedge) {
                let twin = vertices.len();
                vertices.push(vertices[v]);
                (next[v], v) = (twin as u32, twin);
                next.push(u32::MAX);
                is_set.push(false);
                wedges.push(wedge);
            }
            (vertices[v].flat, wedges[v], is_set[v], *corner) = (place, wedge, true, v as u32);
        }
    }
    let first_twin = mesh.positions.len();
    let is_shared: Vec<bool> =
        next.iter().enumerate().map(|(v, &n)| v >= first_twin || n != u32::MAX).collect();
    part_normals(&mut vertices, &triangles, &is_shared);
    (vertices, triangles)
}

/// Cosines of the angle between the normal of a vertex on a seam or a fold line and that of one of its sides, from which on the side
/// has more and more of its own normal, and beyond which it has it wholly.
const SHARP: [f32; 2] = [0.86, 0.5];

/// Gives the vertices that `is_shared` by the sides of a seam or a fold line the normals of their own sides where they are on a sharp
/// fold, as of a turn-up: those of both sides cancel each other out there.
fn part_normals(vertices: &mut [Vertex], triangles: &[[u32; 3]], is_shared: &[bool]) {
    let mut own = vec![Vec3::ZERO; vertices.len()];
    for t in triangles {
        let [a, b, c] = t.map(|v| vertices[v as usize].position);
        let n = (b - a).cross(c - a);
        t.iter().filter(|&&v| is_shared[v as usize]).for_each(|&v| own[v as usize] += n);
    }
    for (vertex, own) in vertices.iter_mut().zip(own) {
        let Some(own) = own.try_normalize() else { continue };
        let share = (SHARP[0] - own.dot(vertex.normal)) / (SHARP[0] - SHARP[1]);
        if share > 0.0 {
            vertex.normal = vertex.normal.lerp(own, share.min(1.0)).normalize_or(own);
        }
    }
}

fn area_weighted_normals(mesh: &Mesh) -> Vec<Vec3> {
    let mut normals = vec![Vec3::ZERO; mesh.positions.len()];
    let count = mesh.positions.len() as u32;
    for t in mesh.triangles.iter().filter(|t| t.iter().all(|&v| v < count)) {
        let [a, b, c] = t.map(|v| mesh.positions[v as usize]);
        let n = (b - a).cross(c - a);
        t.iter().for_each(|&v| normals[v as usize] += n);
    }
    normals.into_iter().map(Vec3::normalize_or_zero).collect()
}

/// A bind group whose bindings 0, 1, ... are `resources`.
pub(super) fn bind(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    resources: &[wgpu::BindingResource<'_>],
) -> wgpu::BindGroup {
    let entries: Vec<wgpu::BindGroupEntry<'_>> = resources
        .iter()
        .enumerate()
        .map(|(i, resource)| wgpu::BindGroupEntry { binding: i as u32, resource: resource.clone() })
        .collect();
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vertex_on_a_seam_has_a_place_on_either_side() {
        let [a, b, c, d] = [Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::ONE];
        let mesh = Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ONE],
            triangles: vec![[0, 1, 2], [2, 1, 3], [1, 0, 3]],
            flat: vec![[a, b, c], [c, b, d], [d, a, c]],
            ..Mesh::default()
        };
        let (vertices, triangles) = flat_vertices(&mesh, vertices(&mesh), mesh.triangles.clone());
        assert_eq!(triangles, [[0, 1, 2], [2, 1, 3], [4, 0, 5]]);
        let flat: Vec<Vec2> = triangles.iter().flatten().map(|&v| vertices[v as usize].flat).collect();
        assert_eq!(flat, mesh.flat.concat());
        assert!(vertices[4].position == Vec3::X && vertices[5].position == Vec3::ONE);
    }

    #[test]
    fn a_fold_line_within_a_piece_parts_normals_as_a_seam_does() {
        for (angle, is_parted) in [(60.0, false), (150.0, true)] {
            let seam = hinged(angle);
            let [a, b, c] = seam.flat[0];
            let fold = Mesh {
                flat: vec![[a, b, c], [b, a, c]],
                wedges: vec![[0, 1, 2], [5, 4, 3]],
                ..hinged(angle)
            };
            let smooth = Mesh { wedges: Vec::new(), ..fold.clone() };
            let made = |mesh: &Mesh| flat_vertices(mesh, vertices(mesh), mesh.triangles.clone());
            let normals = |mesh: &Mesh| -> Vec<Vec3> {
                let (vertices, triangles) = made(mesh);
                triangles.iter().flatten().map(|&v| vertices[v as usize].normal).collect()
            };
            assert_eq!(normals(&fold), normals(&seam), "{angle}");
            assert_eq!(normals(&fold) != normals(&smooth), is_parted, "{angle}");
            assert_eq!([made(&fold).0.len(), made(&smooth).0.len()], [6, 4]);
        }
    }

    /// Two triangles that share an edge; the second is turned by `angle` degrees out of the plane of the first.
    fn hinged(angle: f32) -> Mesh {
        let (sin, cos) = angle.to_radians().sin_cos();
        let [a, b, c] = [Vec2::ZERO, Vec2::X, Vec2::Y];
        Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::new(0.5, 1.0, 0.0), Vec3::new(0.5, -cos, sin)],
            triangles: vec![[0, 1, 2], [1, 0, 3]],
            flat: vec![[a, b, c], [b + Vec2::X, a + Vec2::X, c]],
            ..Mesh::default()
        }
    }

    #[test]
    fn each_side_of_a_sharp_fold_at_a_seam_has_its_own_normals() {
        for (angle, is_parted) in [(30.0, false), (170.0, true)] {
            let mesh = hinged(angle);
            let (vertices, triangles) = flat_vertices(&mesh, vertices(&mesh), mesh.triangles.clone());
            for t in &triangles {
                let [a, b, c] = t.map(|v| vertices[v as usize].position);
                let own = (b - a).cross(c - a).normalize();
                for &v in &t[..2] {
                    let close = vertices[v as usize].normal.dot(own) > 0.999;
                    assert_eq!(close, is_parted, "{angle} degrees");
                }
            }
        }
    }

    #[test]
    fn every_edge_is_drawn_once() {
        let two = [[0, 1, 2], [2, 1, 3], [0, 1, 9]];
        assert_eq!(edges(&two, 4), [[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]]);
    }
}
