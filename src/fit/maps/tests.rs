use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::*;
use crate::cloth::build;
use crate::geometry::mesh::TriMesh;
use crate::pattern::{EdgeRef, Pattern, Piece, Seam};

/// Two sheets side by side, sewn along the edge between them, laid by `place` from where they lie together.
struct Sheets {
    pattern: Pattern,
    garment: Garment,
    state: ClothState,
    surface: Surface,
}

const SIDE: f64 = 0.3;

fn sheets(edge: f64, place: impl Fn(DVec2) -> DVec3) -> Sheets {
    let sheet = [DVec2::ZERO, DVec2::X * SIDE, DVec2::splat(SIDE), DVec2::Y * SIDE];
    let mut pattern = Pattern::default();
    let [left, right] = ["left", "right"].map(|name| pattern.add_piece(Piece::polygon(name, &sheet)));
    let sides = [EdgeRef { piece: left, edge: 1 }, EdgeRef { piece: right, edge: 3 }];
    pattern.add_seam(Seam::of_edges(sides, false));
    let (garment, _) = build(&pattern, edge);
    let mut positions = vec![DVec3::ZERO; garment.vertex_count];
    for c in &garment.corners {
        let beside = if c.piece == right { SIDE } else { 0.0 };
        positions[c.vertex as usize] = place(c.uv + DVec2::X * beside);
    }
    let mapped = vec![true; garment.vertex_count];
    let state = ClothState { positions, mapped };
    Sheets { pattern, garment, state, surface: Surface::new(tetrahedron()).expect("a body") }
}

/// Large, its lowest side in the plane z = -0.02, below the sheets.
fn tetrahedron() -> TriMesh {
    let positions = [(-9.0, -9.0, -0.02), (9.0, -9.0, -0.02), (0.0, 9.0, -0.02), (0.0, 0.0, -9.0)];
    let positions = positions.map(|(x, y, z)| DVec3::new(x, y, z)).to_vec();
    TriMesh { positions, triangles: vec![[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]] }
}

impl Sheets {
    fn map(&self, kind: MapKind) -> Map {
        let Self { pattern, garment, state, surface } = self;
        Map::new(kind, Worn { pattern, garment, state, surface })
    }

    /// Every value of the map that is there is `exact`.
    fn check(&self, kind: MapKind, exact: f64, within: f64) {
        let map = self.map(kind);
        let values: Vec<f64> = map.vertices.iter().copied().filter(|v| v.is_finite()).collect();
        assert!(!values.is_empty());
        assert!(
            values.iter().all(|v| (v - exact).abs() <= within),
            "{kind:?}: {:?}, exactly {exact}",
            map.stats()
        );
    }
}

#[test]
fn a_uniform_stretch_is_told_apart_by_direction() {
    let stretched = sheets(0.03, |p| DVec3::new(p.x * 1.04, p.y * 0.97, 0.3));
    stretched.check(MapKind::Weft, 0.04, 1e-12);
    stretched.check(MapKind::Warp, -0.03, 1e-12);
    stretched.check(MapKind::Shear, 0.0, 1e-12);
    stretched.check(MapKind::Area, 1.04 * 0.97 - 1.0, 1e-12);
    // The seam runs along the grain.
    stretched.check(MapKind::Seams, -0.03, 1e-12);
    assert!(stretched.map(MapKind::Seams).stats().count < 20);
}

#[test]
fn a_grainline_turns_warp_and_weft() {
    let mut sheets = sheets(0.05, |p| DVec3::new(p.x * 1.04, p.y * 0.97, 0.3));
    for piece in sheets.pattern.pieces.values_mut() {
        Arc::make_mut(piece).grainline = Some([DVec2::ZERO, DVec2::X]);
    }
    sheets.check(MapKind::Warp, 0.04, 1e-12);
    sheets.check(MapKind::Weft, -0.03, 1e-12);
}

#[test]
fn a_simple_shear_is_its_angle() {
    let angle = 0.2f64;
    let sheared = sheets(0.04, |p| DVec3::new(p.x + p.y * angle.tan(), p.y, 0.0));
    let map = sheared.map(MapKind::Shear);
    assert!(map.triangles.iter().all(|v| (v.abs() - angle).abs() < 1e-12), "{:?}", map.stats());
    sheared.check(MapKind::Area, 0.0, 1e-12);
}

#[test]
fn ease_is_the_gap_to_the_body() {
    sheets(0.05, |p| p.extend(0.0)).check(MapKind::Ease, 0.02, 1e-12);
    sheets(0.05, |p| p.extend(-0.03)).check(MapKind::Ease, -0.01, 1e-12);
}

#[test]
fn a_cylinder_has_half_its_inverse_radius_as_mean_curvature() {
    let radius = 0.2;
    let round = |edge| {
        sheets(edge, |p| DVec3::new(radius * (p.x / radius).sin(), p.y, radius * (p.x / radius).cos()))
    };
    let error = |edge| {
        let stats = round(edge).map(MapKind::MeanCurvature).stats();
        (stats.median * 2.0 * radius - 1.0).abs()
    };
    assert!(error(0.01) < 0.01, "{}", error(0.01));
    // Flat cloth has none; and the other way round it is negative.
    sheets(0.03, |p| p.extend(0.0)).check(MapKind::MeanCurvature, 0.0, 1e-9);
    let hollow =
        sheets(0.02, |p| DVec3::new(radius * (p.x / radius).sin(), p.y, -radius * (p.x / radius).cos()));
    assert!(hollow.map(MapKind::MeanCurvature).stats().median < 0.0);
}

#[test]
fn the_largest_angle_is_that_of_a_fold() {
    let fold = 0.7f64;
    let folded = sheets(0.05, |p| {
        let beyond = (p.x - SIDE).max(0.0);
        DVec3::new(p.x.min(SIDE) + beyond * fold.cos(), p.y, -beyond * fold.sin())
    });
    let map = folded.map(MapKind::Curvature);
    let on_seam = folded.map(MapKind::Seams);
    // A corner in one triangle has no angle.
    assert!(map.vertices.iter().filter(|angle| angle.is_nan()).count() <= 4);
    for (angle, seam) in map.vertices.iter().zip(&on_seam.vertices).filter(|(angle, _)| !angle.is_nan()) {
        let exact = if seam.is_finite() { fold } else { 0.0 };
        assert!((angle - exact).abs() < 1e-9, "{angle} for {exact}");
    }
}

#[test]
fn figures_add_up_piece_by_piece() {
    let sheets = sheets(0.05, |p| DVec3::new(p.x * (1.0 + p.x), p.y, 0.0));
    let map = sheets.map(MapKind::Weft);
    let all = map.stats();
    let pieces = map.pieces(&sheets.garment);
    assert_eq!(pieces.len(), 2);
    assert!(pieces[0].stats.mean < all.mean && all.mean < pieces[1].stats.mean);
    let range = map.range();
    assert_eq!(range[0], -range[1]);
    let histogram = map.histogram(range);
    assert_eq!(histogram.counts.iter().sum::<usize>(), all.count);
    assert_eq!(histogram.borders.len(), histogram.counts.len() + 1);
}

#[test]
fn cloth_that_is_not_laid_has_no_values() {
    let mut sheets = sheets(0.05, |p| p.extend(0.0));
    sheets.state.mapped.fill(false);
    for kind in MapKind::ALL {
        assert_eq!(sheets.map(kind).stats().count, 0, "{kind:?}");
        assert_eq!(kind.name().parse::<MapKind>(), Ok(kind));
    }
}
