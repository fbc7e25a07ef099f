//! Piping: its weight.

use std::f64::consts::PI;

use glam::DVec2;
use toile::pattern::{EdgeRef, Pattern, Piece, Piping, Seam};

use super::folds::hanging;

/// Mass, kg, of two squares 0.2 m wide that are sewn along one edge, with piping of these radii on the two sides of the seam.
fn mass(radii: [Option<f64>; 2]) -> f64 {
    let mut pattern = Pattern::default();
    let [a, b] = [1, 3].map(|edge: usize| {
        let left = if edge == 1 { 0.0 } else { 0.2 };
        let corners = [(0.0, 0.0), (0.2, 0.0), (0.2, 0.2), (0.0, 0.2)];
        let corners = corners.map(|(x, y)| DVec2::new(left + x, y));
        let mut piece = Piece::polygon("square", &corners);
        let radius = radii[edge / 2];
        piece.outline[edge].trims.piping = radius.map(|radius| Piping { radius, ..Piping::USUAL });
        pattern.add_piece(piece)
    });
    pattern.add_seam(Seam::of_edges([EdgeRef { piece: a, edge: 1 }, EdgeRef { piece: b, edge: 3 }], false));
    let (garment, _, worn) = hanging(&pattern, |p| p.extend(0.0));
    (0..garment.vertex_count as u32).map(|v| worn.motion(v).expect("it is draped").0).sum()
}

#[test]
fn a_seam_that_both_sides_pipe_has_the_weight_of_one_cord() {
    let cord = 0.2 * 510.0 * PI * 0.0015 * 0.0015;
    let plain = mass([None; 2]);
    for radii in [[Some(0.0015), None], [None, Some(0.0015)], [Some(0.0015); 2]] {
        assert!((mass(radii) - plain - cord).abs() < 1e-12, "{radii:?}");
    }
}
