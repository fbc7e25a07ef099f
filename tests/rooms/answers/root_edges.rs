//! Root edges on surfaces that unfold: B15.

use std::f64::consts::PI;

use glam::{DQuat, DVec2, DVec3};
use toile::body::Surface;
use toile::cloth::build;
use toile::geometry::ids::MarkId;
use toile::geometry::mesh::TriMesh;
use toile::pattern::{Pattern, Piece};
use toile::wrap::roots::roots;
use toile::wrap::{BodyMark, ClothMark, ClothSide, Marks};

use super::shapes::{OFFSET, cone};
use crate::common::exact::cylinder;

/// The side of a regular frustum, unfolded: x level from the middle of a facet, y up along that.
struct Frustum {
    facets: u32,
    /// Between the middles of its bottom and top rims and the axis, metres.
    feet: [f64; 2],
    height: f64,
}

impl Frustum {
    fn half(&self) -> f64 {
        PI / f64::from(self.facets)
    }

    /// Where an unfolded point is. The middle facet's middle is at azimuth half a facet.
    fn place(&self, p: DVec2) -> DVec3 {
        let [foot, head] = self.feet;
        let half = self.half();
        let slant = (foot - head).hypot(self.height);
        let (whole, in_facet) = if (foot - head).abs() < 1e-12 {
            let width = 2.0 * foot * half.tan();
            let whole = (p.x / width).round();
            (whole, DVec2::new(p.x - whole * width, p.y))
        } else {
            // Polar about the apex of the pyramid.
            let far = slant * foot / (foot - head);
            let opening = 2.0 * (foot * half.tan() / far).atan();
            let from_apex = p - DVec2::new(0.0, far);
            let turn = from_apex.x.atan2(-from_apex.y);
            let whole = (turn / opening).round();
            (whole, DVec2::new(0.0, far) + DVec2::from_angle(-whole * opening).rotate(from_apex))
        };
        let up = DVec3::new(0.0, self.height, head - foot) / slant;
        let flat = DVec3::Z * foot + DVec3::X * in_facet.x + up * in_facet.y;
        DQuat::from_rotation_y(half + whole * 2.0 * half) * flat
    }
}

/// The farthest root edge from its place, in edge lengths, for a patch with a stroke up and slightly aslant.
fn farthest(mesh: TriMesh, frustum: &Frustum, low: f64, edge: f64) -> f64 {
    let body = Surface::new(mesh).expect("a body");
    let corners = [(-0.1, 0.0), (0.1, 0.0), (0.1, 0.3), (-0.1, 0.3)].map(DVec2::from);
    let mut pattern = Pattern::default();
    let piece = pattern.add_piece(Piece::polygon("patch", &corners));
    let (garment, _) = build(&pattern, edge);
    // Within the middle facet, so that its length is the same at any height above the skin.
    let spine: Vec<DVec2> = [0.02, 0.28].map(|y| DVec2::new(1e-4 * frustum.feet[1] * y, y)).to_vec();
    let solid = spine.iter().map(|p| frustum.place(*p + DVec2::Y * low)).collect();
    let marks = Marks {
        cloth: vec![ClothMark { id: MarkId(1), piece, side: ClothSide::Front, points: spine }],
        body: vec![BodyMark { id: MarkId(2), points: solid }],
        ..Marks::default()
    };
    let (roots, stretches, problems) = roots(&garment, &body, &marks, OFFSET);
    assert!(problems.is_empty(), "{problems:?}");
    assert!(roots.len() > 10 && stretches[0].stretch().abs() < 1e-9, "{} {stretches:?}", roots.len());
    let error = |root: &toile::wrap::roots::Root| {
        let corner = garment.corners.iter().find(|c| c.vertex == root.vertex).expect("a corner");
        let exact = frustum.place(corner.uv + DVec2::Y * low);
        let skin = body.nearest(root.position);
        assert!((skin.distance - OFFSET).abs() < 1e-9, "{}", skin.distance);
        skin.point.distance(exact)
    };
    let worst = roots.iter().map(error).fold(0.0, f64::max) / edge;
    println!("{} facets, edges {edge}: {worst:.2e} l over {} roots", frustum.facets, roots.len());
    worst
}

#[test]
fn root_edges_are_exact_on_a_prism() {
    let half = PI / 6.0;
    let frustum = Frustum { facets: 6, feet: [0.15 * half.cos(); 2], height: 1.0 };
    for edge in [0.04, 0.02, 0.01] {
        assert!(farthest(cylinder(0.15, 1.0, 6, 7), &frustum, 0.3, edge) < 1e-5);
    }
}

#[test]
fn root_edges_are_exact_on_a_cylinder() {
    let facets = 720;
    let half = PI / f64::from(facets);
    let frustum = Frustum { facets, feet: [0.15 * half.cos(); 2], height: 1.0 };
    for edge in [0.04, 0.02, 0.01] {
        assert!(farthest(cylinder(0.15, 1.0, facets, 30), &frustum, 0.3, edge) < 1e-5);
    }
}

#[test]
fn root_edges_are_exact_on_a_cone() {
    let (facets, slope) = (360, 0.4f64);
    let half = PI / f64::from(facets);
    let frustum = Frustum { facets, feet: [slope.tan() * half.cos(), 0.0], height: 1.0 };
    for edge in [0.04, 0.02, 0.01] {
        assert!(farthest(cone(slope, 40, facets), &frustum, 0.3, edge) < 1e-5);
    }
}
