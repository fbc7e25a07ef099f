use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::*;
use crate::cloth::build;
use crate::geometry::mesh::TriMesh;
use crate::pattern::{EdgeRef, Pattern, Piece, Seam};

/// Two sheets side by side, sewn along the edge between them, laid by `place` from where they lie together.
pub struct Sheets {
    pub pattern: Pattern,
    pub garment: Garment,
    pub state: ClothState,
    pub surface: Surface,
}

pub const SIDE: f64 = 0.3;
/// Wrapped cloth is kept so far off the skin.
const OFFSET: f64 = 0.004;

/// Unlike in its directions, so that they cannot be taken for one another.
fn fabric() -> Fabric {
    let mut fabric = Fabric::isotropic(1000.0, 0.2, 1e-5, 0.25);
    fabric.stretch.weft = 700.0;
    fabric
}

pub fn sheets(edge: f64, place: impl Fn(DVec2) -> DVec3) -> Sheets {
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
    pub fn map(&self, kind: MapKind) -> Map {
        self.with_worn(|worn| Map::new(kind, worn))
    }

    pub fn with_worn<T>(&self, read: impl FnOnce(Worn<'_>) -> T) -> T {
        let Self { pattern, garment, state, surface } = self;
        let fabrics = pattern.pieces.keys().map(|&id| (id, fabric())).collect();
        read(Worn { pattern, garment, state, surface, fabrics: &fabrics, offset: OFFSET })
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

/// Cloth wound round a prism of `n` sides inscribed in a cylinder of `radius`, stretched by `hoop` round it and by `along` its
/// axis; the body is a prism with the same sides `OFFSET` below.
pub fn tube(n: u32, radius: f64, hoop: f64, along: f64) -> Sheets {
    let side = 2.0 * radius * (std::f64::consts::PI / f64::from(n)).sin();
    let rows = 6;
    let round = |radius: f64, k: u32, y: f64| {
        let a = f64::from(k) / f64::from(n) * std::f64::consts::TAU;
        DVec3::new(radius * a.sin(), y, radius * a.cos())
    };
    let mut pattern = Pattern::default();
    let piece = pattern.add_piece(Piece::polygon("tube", &[DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y]));
    let mut garment = Garment { vertex_count: (n * rows) as usize, ..Garment::default() };
    garment.pieces.push((piece, "tube".to_owned()));
    for row in 0..rows {
        for k in 0..=n {
            let uv = DVec2::new(f64::from(k) * side / hoop, f64::from(row) * side / along);
            garment.corners.push(crate::cloth::Corner { piece, uv, vertex: row * n + k % n });
        }
    }
    for (row, k) in (0..rows - 1).flat_map(|row| (0..n).map(move |k| (row, k))) {
        let c = row * (n + 1) + k;
        for corners in [[c, c + 1, c + n + 2], [c, c + n + 2, c + n + 1]] {
            garment.triangle_corners.push(corners);
            garment.triangles.push(corners.map(|c| garment.corners[c as usize].vertex));
            garment.rest.push(corners.map(|c| garment.corners[c as usize].uv));
            garment.triangle_pieces.push(piece);
        }
    }
    garment.adjacency = crate::geometry::adjacency::Adjacency::new(garment.vertex_count, &garment.triangles);
    let place = |v: u32| round(radius, v % n, f64::from(v / n) * side);
    let positions = (0..n * rows).map(place).collect();
    let state = ClothState { positions, mapped: vec![true; garment.vertex_count] };
    let body = radius - OFFSET;
    let mut skin = TriMesh::default();
    for y in [-1.0, 1.0] {
        skin.positions.extend((0..n).map(|k| round(body, k, y)));
    }
    for k in 0..n {
        let b = (k + 1) % n;
        skin.triangles.extend([[k, b, b + n], [k, b + n, k + n]]);
    }
    Sheets { pattern, garment, state, surface: Surface::new(skin).expect("a body") }
}

/// What the fabric pulls with along its weft, held so long along the warp, N/m of its width now.
fn hoop_tension(hoop: f64, along: f64) -> f64 {
    let strain = |stretch: f64| (stretch * stretch - 1.0) / 2.0;
    let [_, weft, cross, _] = fabric().stretch.tangent();
    // Cauchy's: F S Fᵀ over the change of area.
    (weft * strain(hoop) + cross * strain(along)) * hoop / along
}

#[test]
fn a_stretched_tube_presses_with_its_tension_over_the_radius() {
    for (n, hoop, along) in [(24, 1.05, 1.0), (24, 1.2, 1.1), (96, 1.05, 1.0)] {
        let radius = 0.08;
        let exact = hoop_tension(hoop, along) / radius;
        assert!(exact > 100.0, "{exact} Pa");
        tube(n, radius, hoop, along).check(MapKind::Pressure, exact, 1e-9 * exact);
    }
}

#[test]
fn a_tube_that_is_too_wide_or_hangs_off_the_skin_does_not_press() {
    tube(24, 0.08, 0.97, 1.0).check(MapKind::Pressure, 0.0, 1e-12);
    let mut away = tube(24, 0.08, 1.05, 1.0);
    away.state.positions.iter_mut().for_each(|p| *p += DVec3::new(p.x, 0.0, p.z).normalize() * 2.0 * OFFSET);
    assert_eq!(away.map(MapKind::Pressure).stats().count, 0);
}

#[test]
fn cloth_on_a_table_presses_with_its_weight() {
    let mut laid = sheets(0.03, |p| DVec3::new(p.x, OFFSET - 0.02, -p.y));
    laid.surface.mesh.positions.iter_mut().for_each(|p| *p = DVec3::new(p.x, p.z, -p.y));
    laid.surface = Surface::new(laid.surface.mesh.clone()).expect("a body");
    laid.check(MapKind::Pressure, 0.25 * 9.81, 1e-9);
}

#[test]
fn an_uneven_mesh_round_a_cylinder_presses_alike_in_the_mean() {
    let (radius, hoop) = (0.2, 1.05);
    let mut wound = sheets(0.01, |p| {
        let a = p.x * hoop / radius;
        DVec3::new(radius * a.sin(), p.y, radius * a.cos())
    });
    wound.surface = tube(400, radius, 1.0, 1.0).surface;
    let stats = wound.map(MapKind::Pressure).stats();
    let exact = hoop_tension(hoop, 1.0) / radius;
    assert!((stats.median / exact - 1.0).abs() < 0.01, "{stats:?}, exactly {exact}");
}
