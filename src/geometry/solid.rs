//! Small solid shapes that are only looked at: rods along lines, and what others add to the same arrays. Single precision is enough
//! for them.

use glam::Vec3;

/// By how much the end of a rod is domed, in half heights.
pub(crate) const DOME: f32 = 0.4;
/// Distance of two points of an axis, in half thicknesses of its rod, from which on they give a direction: at the rounding of
/// single precision, nearer ones give any.
const APART: f32 = 0.1;

/// Triangles with what is needed to draw them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Solid {
    /// Positions of the vertices, metres.
    pub positions: Vec<Vec3>,
    /// Unit normals, one per position; empty where whoever draws computes them.
    pub normals: Vec<Vec3>,
    /// Indices into `positions`, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// sRGB colours, one per position; empty where all has one colour.
    pub colours: Vec<[u8; 3]>,
}

/// The cross section of a rod: an ellipse.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// Half its width, along the surface that the rod lies on, metres.
    pub half_width: f32,
    /// Half its height, out of that surface, metres.
    pub half_height: f32,
    /// Number of its corners, at least 3.
    pub sides: u32,
}

impl Section {
    /// The number of vertices of a rod along a line of `points`.
    pub fn vertices(&self, points: usize) -> usize {
        self.sides as usize * points + 2
    }
}

/// Rings of vertices that follow each other in a solid.
#[derive(Clone, Copy, Debug)]
pub struct Rings {
    /// The first vertex.
    pub first: u32,
    /// Vertices of a ring.
    pub sides: u32,
    /// Number of rings, at least 1.
    pub count: u32,
}

impl Rings {
    fn corner(self, ring: u32, side: u32) -> u32 {
        self.first + ring % self.count * self.sides + side % self.sides
    }
}

impl Solid {
    /// Adds a rod, with normals, about the polyline `axis` of two points or more; `up` is at each of them a direction out of the
    /// surface that it lies on. Its ends are closed by domes. It has [`Section::vertices`] vertices, and none without points.
    pub fn push_rod(&mut self, axis: &[Vec3], up: &[Vec3], section: Section) {
        let (Some(last), n) = (axis.len().checked_sub(1), section.sides) else { return };
        let first = self.positions.len() as u32;
        let Section { half_width, half_height, .. } = section;
        let (mut way, mut out) = (Vec3::X, Vec3::Z);
        let mut ends = [Vec3::X; 2];
        let apart = APART * half_width.min(half_height);
        for (i, (&at, &up)) in axis.iter().zip(up).enumerate() {
            let is_apart = |p: &&Vec3| p.distance(at) > apart;
            let before = axis[..i].iter().rev().find(is_apart).unwrap_or(&axis[0]);
            let after = axis[i + 1..].iter().find(is_apart).unwrap_or(&axis[last]);
            let along = *after - *before;
            way = along.try_normalize().unwrap_or(way);
            if i == 0 {
                ends[0] = way;
            }
            ends[1] = way;
            let own = [up, out].into_iter().find_map(|up| up.reject_from_normalized(way).try_normalize());
            out = own.unwrap_or_else(|| way.any_orthonormal_vector());
            let across = out.cross(way);
            for k in 0..n {
                let (sin, cos) = (std::f32::consts::TAU * k as f32 / n as f32).sin_cos();
                self.positions.push(at + across * (cos * half_width) + out * (sin * half_height));
                let normal = across * (cos * half_height) + out * (sin * half_width);
                self.normals.push(normal.normalize_or(out));
            }
        }
        let rings = Rings { first, sides: n, count: axis.len() as u32 };
        self.join(rings, false);
        self.close(rings, [axis[0], axis[last]], [-ends[0], ends[1]], half_height);
    }

    /// Adds the triangles from ring to ring, and from the last to the first where it `is_closed`.
    pub fn join(&mut self, rings: Rings, is_closed: bool) {
        let spans = if is_closed { rings.count } else { rings.count.saturating_sub(1) };
        for i in 0..spans {
            for k in 0..rings.sides {
                let [a, b, c, d] =
                    [(i, k), (i, k + 1), (i + 1, k + 1), (i + 1, k)].map(|(i, k)| rings.corner(i, k));
                self.triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }

    /// Closes the first and the last ring by domes: about the middles of the rings, `ways` out of them (unit vectors), of rings of
    /// this `radius`.
    pub fn close(&mut self, rings: Rings, middles: [Vec3; 2], ways: [Vec3; 2], radius: f32) {
        for (end, (at, way)) in middles.into_iter().zip(ways).enumerate() {
            let tip = self.positions.len() as u32;
            self.positions.push(at + way * (radius * DOME));
            self.normals.push(way);
            let ring = if end == 0 { 0 } else { rings.count - 1 };
            self.triangles.extend((0..rings.sides).map(|k| {
                let [a, b] = [k, k + 1].map(|k| rings.corner(ring, k));
                if end == 0 { [b, a, tip] } else { [a, b, tip] }
            }));
        }
    }

    /// Gives vertices that have no normals yet, the last ones, those of the triangles from `first_triangle` on that they belong to.
    pub fn complete_normals(&mut self, first_triangle: usize) {
        let first = self.normals.len();
        self.normals.resize(self.positions.len(), Vec3::ZERO);
        for triangle in self.triangles.get(first_triangle..).unwrap_or_default() {
            let [a, b, c] = triangle.map(|v| self.positions[v as usize]);
            let normal = (b - a).cross(c - a);
            for &v in triangle.iter().filter(|v| **v as usize >= first) {
                self.normals[v as usize] += normal;
            }
        }
        for normal in &mut self.normals[first..] {
            *normal = normal.normalize_or(Vec3::Y);
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use std::collections::BTreeMap;

    use super::*;

    const FLAT: Section = Section { half_width: 0.002, half_height: 0.0005, sides: 6 };

    /// Checks that each side of a triangle belongs to one other, the other way. Gives the volume.
    pub(crate) fn volume_of_closed(solid: &Solid) -> f32 {
        let mut sides: BTreeMap<[u32; 2], i32> = BTreeMap::new();
        for &[a, b, c] in &solid.triangles {
            [[a, b], [b, c], [c, a]].into_iter().for_each(|side| *sides.entry(side).or_default() += 1);
        }
        for (&[a, b], &count) in &sides {
            assert_eq!((count, sides.get(&[b, a])), (1, Some(&1)), "side {a} to {b}");
        }
        let p = |v: u32| solid.positions[v as usize];
        solid.triangles.iter().map(|&[a, b, c]| p(a).dot(p(b).cross(p(c))) / 6.0).sum()
    }

    #[test]
    fn a_rod_is_closed_and_lies_flat_on_its_surface() {
        let axis = [Vec3::ZERO, Vec3::X * 0.02, Vec3::X * 0.05];
        let mut solid = Solid::default();
        solid.push_rod(&axis, &[Vec3::Z; 3], FLAT);
        assert_eq!((solid.positions.len(), solid.normals.len()), (FLAT.vertices(3), FLAT.vertices(3)));
        let (low, high) =
            solid.positions.iter().fold((Vec3::MAX, Vec3::MIN), |(low, high), &p| (low.min(p), high.max(p)));
        assert!((high.y - 0.002).abs() < 1e-7 && (low.y + 0.002).abs() < 1e-7, "{low} {high}");
        assert!(high.z <= 0.0005 && low.z >= -0.0005 && high.z > 0.0004, "{low} {high}");
        assert!((high.x - 0.0502).abs() < 1e-6 && (low.x + 0.0002).abs() < 1e-6, "{low} {high}");
        // Six corners of an ellipse have 3/2 sin 60° twice over of its half axes' product, and the domes are low pyramids.
        let section = 6.0 / 2.0 * (std::f32::consts::TAU / 6.0).sin() * 0.002 * 0.0005;
        let wanted = section * (0.05 + 2.0 * DOME * 0.0005 / 3.0);
        assert!((volume_of_closed(&solid) / wanted - 1.0).abs() < 1e-3);
        assert!(solid.normals.iter().all(|normal| normal.is_normalized()));
    }

    #[test]
    fn a_rod_goes_round_corners_and_over_points_that_coincide() {
        let axis = [Vec3::ZERO, Vec3::X * 0.05, Vec3::X * 0.05, Vec3::new(0.05, 0.05, 0.0)];
        let mut solid = Solid::default();
        solid.push_rod(&axis, &[Vec3::Z, Vec3::Z, Vec3::ZERO, Vec3::Z], Section { sides: 3, ..FLAT });
        assert!(volume_of_closed(&solid) > 0.0);
        assert!(solid.positions.iter().chain(&solid.normals).all(|p| p.is_finite()));
        let mut nothing = Solid::default();
        nothing.push_rod(&[], &[], FLAT);
        assert_eq!(nothing, Solid::default());
    }

    #[test]
    fn normals_are_completed_where_there_are_none() {
        let mut solid = Solid::default();
        solid.push_rod(&[Vec3::ZERO, Vec3::X], &[Vec3::Z; 2], FLAT);
        let (before, first) = (solid.clone(), solid.triangles.len());
        let n = solid.positions.len() as u32;
        solid.positions.extend([Vec3::ZERO, Vec3::X, Vec3::Z]);
        solid.triangles.push([n, n + 1, n + 2]);
        solid.complete_normals(first);
        assert_eq!(solid.normals[..n as usize], before.normals[..]);
        assert_eq!(solid.normals[n as usize..], [-Vec3::Y; 3]);
    }
}
