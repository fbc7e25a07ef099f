//! Flat pieces to triangles, and the seams between them.

use glam::DVec2;
use proptest::prelude::*;
use toile::cloth::{Garment, build};
use toile::geometry::ids::PieceId;
use toile::pattern::{Edge, EdgeRef, EdgeShape, Pattern, Piece, ProblemKind, Seam, Stretch};

fn polygon(points: &[[f64; 2]]) -> Piece {
    Piece::polygon("p", &points.iter().map(|&p| DVec2::from(p)).collect::<Vec<_>>())
}

fn alone(piece: Piece) -> Pattern {
    let mut pattern = Pattern::default();
    pattern.add_piece(piece);
    pattern
}

fn rectangle(width: f64, height: f64) -> Piece {
    polygon(&[[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]])
}

fn sew(pattern: &mut Pattern, a: (PieceId, usize), b: (PieceId, usize)) {
    let side = |(piece, edge)| EdgeRef { piece, edge };
    pattern.add_seam(Seam::of_edges([side(a), side(b)], false));
}

fn kinds(pattern: &Pattern) -> Vec<ProblemKind> {
    build(pattern, 0.02).1.into_iter().map(|p| p.kind).collect()
}

fn angles(garment: &Garment) -> Vec<f64> {
    garment
        .rest
        .iter()
        .flat_map(|t| {
            (0..3).map(|k| {
                let (u, v) = (t[(k + 1) % 3] - t[k], t[(k + 2) % 3] - t[k]);
                u.angle_to(v).abs().to_degrees()
            })
        })
        .collect()
}

fn area(garment: &Garment) -> f64 {
    garment.rest.iter().map(|t| (t[1] - t[0]).perp_dot(t[2] - t[0]) / 2.0).sum()
}

#[track_caller]
fn check_triangles(piece: Piece, edge_length: f64, smallest_angle: f64) {
    let exact = piece.signed_area().abs();
    let (garment, problems) = build(&alone(piece), edge_length);
    assert!(problems.is_empty(), "{problems:?}");
    assert!(garment.rest.iter().all(|t| (t[1] - t[0]).perp_dot(t[2] - t[0]) > 0.0), "front up");
    assert!((area(&garment) / exact - 1.0).abs() < 0.01, "{} {exact}", area(&garment));
    let smallest = angles(&garment).into_iter().fold(f64::INFINITY, f64::min);
    assert!(smallest >= smallest_angle, "smallest angle {smallest}");
}

#[test]
fn a_rectangle_has_good_triangles() {
    check_triangles(rectangle(0.5, 0.7), 0.02, 20.0);
}

#[test]
fn a_coarse_rectangle_has_good_triangles() {
    check_triangles(rectangle(0.5, 0.7), 0.1, 20.0);
}

#[test]
fn a_clockwise_piece_faces_away() {
    check_triangles(polygon(&[[0.0, 0.0], [0.0, 0.5], [0.4, 0.5], [0.4, 0.0]]), 0.02, 20.0);
}

#[test]
fn a_concave_piece_has_good_triangles() {
    check_triangles(
        polygon(&[[0.0, 0.0], [0.6, 0.0], [0.6, 0.2], [0.2, 0.2], [0.2, 0.6], [0.0, 0.6]]),
        0.03,
        20.0,
    );
}

#[test]
fn a_disc_has_good_triangles() {
    let arc = EdgeShape::Arc { radius: 0.3, large: false, sweep: true };
    let edge = |x: f64| Edge { start: DVec2::new(x, 0.0), shape: arc, label: None, ..Edge::default() };
    let piece = Piece { outline: vec![edge(0.3), edge(-0.3)], ..polygon(&[]) };
    check_triangles(piece, 0.02, 20.0);
}

#[test]
fn curves_have_good_triangles() {
    let mut piece = rectangle(0.4, 0.5);
    piece.outline[1].shape = EdgeShape::Quadratic { control: DVec2::new(0.3, 0.25) };
    piece.outline[2].shape = EdgeShape::Cubic { controls: [DVec2::new(0.3, 0.42), DVec2::new(0.1, 0.42)] };
    check_triangles(piece, 0.015, 20.0);
}

#[test]
fn a_short_edge_survives() {
    let piece = polygon(&[[0.0, 0.0], [0.3, 0.0], [0.303, 0.004], [0.3, 0.4], [0.0, 0.4]]);
    let (garment, problems) = build(&alone(piece), 0.03);
    assert!(problems.is_empty(), "{problems:?}");
    for corner in [[0.3, 0.0], [0.303, 0.004]] {
        assert!(garment.corners.iter().any(|c| c.uv == DVec2::from(corner)));
    }
}

#[test]
fn triangles_are_as_long_as_asked() {
    let (garment, _) = build(&alone(rectangle(0.6, 0.8)), 0.02);
    let mut lengths: Vec<f64> =
        garment.rest.iter().flat_map(|t| (0..3).map(|k| (t[(k + 1) % 3] - t[k]).length())).collect();
    lengths.sort_by(f64::total_cmp);
    let median = lengths[lengths.len() / 2];
    assert!((median / 0.02 - 1.0).abs() < 0.1, "{median}");
    assert!(lengths[lengths.len() - 1] < 0.04);
}

#[test]
fn a_self_crossing_piece_is_named_and_the_others_stay() {
    let mut pattern = alone(rectangle(0.3, 0.3));
    let crossed = pattern.add_piece(polygon(&[[0.0, 0.0], [0.3, 0.3], [0.3, 0.0], [0.0, 0.3]]));
    let (garment, problems) = build(&pattern, 0.02);
    let problem = problems.iter().find(|p| p.kind == ProblemKind::SelfCrossing).expect("named");
    assert!(problem.place.contains(&crossed.to_string()), "{}", problem.place);
    assert!(problem.place.contains("edge"), "{}", problem.place);
    assert_eq!(garment.pieces.len(), 1);
    assert!(!garment.triangles.is_empty());
}

#[test]
fn a_seam_to_nothing_is_named() {
    let mut pattern = alone(rectangle(0.3, 0.3));
    let piece = PieceId(1);
    sew(&mut pattern, (piece, 0), (PieceId(77), 0));
    sew(&mut pattern, (piece, 1), (piece, 9));
    assert_eq!(kinds(&pattern), [ProblemKind::SeamToNothing; 2]);
}

#[test]
fn an_edge_sewn_twice_is_named() {
    let mut pattern = alone(rectangle(0.3, 0.3));
    let (a, b) = (PieceId(1), pattern.add_piece(rectangle(0.3, 0.3)));
    sew(&mut pattern, (a, 1), (b, 3));
    sew(&mut pattern, (a, 1), (b, 1));
    assert_eq!(kinds(&pattern), [ProblemKind::EdgeSewnTwice]);
}

#[test]
fn an_unsewn_piece_is_named() {
    let mut pattern = alone(rectangle(0.3, 0.3));
    let (a, b) = (PieceId(1), pattern.add_piece(rectangle(0.3, 0.3)));
    pattern.add_piece(rectangle(0.1, 0.1));
    sew(&mut pattern, (a, 1), (b, 3));
    assert_eq!(kinds(&pattern), [ProblemKind::PieceUnsewn]);
}

#[test]
fn pieces_without_area_or_edges_are_named() {
    for points in [vec![], vec![[0.0, 0.0]], vec![[0.0, 0.0], [0.1, 0.0], [0.2, 0.0]]] {
        let found = kinds(&alone(polygon(&points)));
        assert!(found.contains(&ProblemKind::ZeroLength), "{points:?}: {found:?}");
    }
    let doubled = polygon(&[[0.0, 0.0], [0.3, 0.0], [0.3, 0.0], [0.3, 0.3]]);
    assert!(kinds(&alone(doubled)).contains(&ProblemKind::ZeroLength));
}

#[test]
fn a_piece_of_nonsense_numbers_is_named() {
    let found = kinds(&alone(polygon(&[[0.0, 0.0], [f64::NAN, 0.0], [0.3, f64::INFINITY]])));
    assert!(!found.is_empty());
}

#[test]
fn a_twisted_seam_is_named() {
    let mut pattern = alone(rectangle(0.3, 0.3));
    let (a, b) = (PieceId(1), pattern.add_piece(rectangle(0.3, 0.3)));
    pattern.add_seam(Seam::of_edges([EdgeRef { piece: a, edge: 1 }, EdgeRef { piece: b, edge: 3 }], true));
    assert_eq!(kinds(&pattern), [ProblemKind::TwistedSeam]);
}

#[test]
fn a_gather_pairs_points_by_fraction_of_length() {
    let mut pattern = alone(rectangle(0.3, 0.4));
    let mut long = rectangle(0.3, 0.6);
    long.outline[3].shape = EdgeShape::Quadratic { control: DVec2::new(-0.1, 0.3) };
    let (a, b) = (PieceId(1), pattern.add_piece(long));
    sew(&mut pattern, (a, 1), (b, 3));
    let (garment, problems) = build(&pattern, 0.02);
    assert_eq!(problems.iter().map(|p| p.kind).collect::<Vec<_>>(), [ProblemKind::UnequalSeam]);
    pattern.keep_ratios();
    assert_eq!(kinds(&pattern), [ProblemKind::Gather], "a kept ratio is meant");
    let (_, pairs) = &garment.seam_pairs[0];
    let longer = pattern.pieces[&b].edge_length(3);
    assert_eq!(pairs.len(), (longer / 0.02).round() as usize + 1);
    let n = pairs.len() - 1;
    for (i, &[p, q]) in pairs.iter().enumerate() {
        let (p, q) = (garment.corners[p as usize], garment.corners[q as usize]);
        assert_eq!(p.vertex, q.vertex);
        let fraction = i as f64 / n as f64;
        assert!((p.uv - DVec2::new(0.3, 0.4 * fraction)).length() < 1e-9);
        let on_curve = pattern.pieces[&b].edge_points(3, &[1.0 - fraction])[0];
        assert!((q.uv - on_curve).length() < 1e-9);
    }
}

#[test]
fn a_tube_of_one_piece_closes_on_itself() {
    let mut pattern = alone(rectangle(0.6, 0.4));
    sew(&mut pattern, (PieceId(1), 1), (PieceId(1), 3));
    let (garment, problems) = build(&pattern, 0.03);
    assert!(problems.is_empty(), "{problems:?}");
    let v = garment.vertex_count as i64;
    let e = garment.adjacency.edges.len() as i64;
    let f = garment.triangles.len() as i64;
    assert_eq!(v - e + f, 0, "an annulus");
}

#[test]
fn a_hole_is_cut_out_and_can_be_sewn_shut() {
    let mut piece = rectangle(0.4, 0.3);
    let hole = polygon(&[[0.1, 0.15], [0.2, 0.16], [0.3, 0.15], [0.2, 0.14]]);
    piece.holes.push(hole.outline);
    assert_eq!(piece.edge_count(), 8);
    let (garment, problems) = build(&alone(piece.clone()), 0.02);
    assert!(problems.is_empty(), "{problems:?}");
    assert!((area(&garment) - (0.12 - 0.002)).abs() < 1e-9, "{}", area(&garment));
    let euler =
        |g: &Garment| g.vertex_count as i64 - g.adjacency.edges.len() as i64 + g.triangles.len() as i64;
    assert_eq!(euler(&garment), 0, "a ring");
    // A fish-eye dart: each upper edge to the lower one across.
    let mut pattern = alone(piece);
    let id = *pattern.pieces.keys().next().unwrap();
    sew(&mut pattern, (id, 4), (id, 7));
    sew(&mut pattern, (id, 5), (id, 6));
    let (sewn, problems) = build(&pattern, 0.02);
    assert!(problems.is_empty(), "{problems:?}");
    assert_eq!(euler(&sewn), 1, "a disc again");
}

#[test]
fn a_hole_out_of_place_is_named() {
    let mut piece = rectangle(0.4, 0.3);
    piece.holes.push(polygon(&[[0.5, 0.1], [0.6, 0.1], [0.6, 0.2]]).outline);
    assert_eq!(kinds(&alone(piece.clone())), [ProblemKind::NotTriangulated]);
    piece.holes[0] = polygon(&[[0.3, 0.1], [0.6, 0.1], [0.6, 0.2]]).outline;
    assert_eq!(kinds(&alone(piece)), [ProblemKind::SelfCrossing]);
}

/// A band sewn to the tops of two pieces, by stretches of its one lower edge.
fn banded(stretches: bool) -> Pattern {
    let mut pattern = Pattern::default();
    let widths = [0.3, 0.2];
    let pieces = widths.map(|w| pattern.add_piece(rectangle(w, 0.25)));
    let (long, lower) = (0.5, [0.0, 0.3]);
    let mut band = rectangle(long, 0.04);
    if !stretches {
        band.outline.insert(1, Edge { start: DVec2::new(0.3, 0.0), ..Edge::default() });
    }
    let band = pattern.add_piece(band);
    for k in 0..2 {
        let top = EdgeRef { piece: pieces[k], edge: 2 };
        let side = if stretches {
            Stretch { from: lower[k] / long, to: (lower[k] + widths[k]) / long, ..Stretch::edge(band, 0) }
        } else {
            Stretch::edge(band, k)
        };
        pattern.add_seam(Seam { sides: [side, top.into()], same_direction: false, ratio: None, zip: None });
    }
    sew(&mut pattern, (pieces[0], 1), (pieces[1], 3));
    pattern
}

#[test]
fn stretches_of_one_edge_are_sewn_as_if_it_had_been_cut_there() {
    let ((one, problems), (cut, _)) = (build(&banded(true), 0.02), build(&banded(false), 0.02));
    assert!(problems.is_empty(), "{problems:?}");
    assert_eq!(one.triangles, cut.triangles);
    assert_eq!(one.seam_pairs, cut.seam_pairs);
}

#[test]
fn one_edge_is_sewn_along_several() {
    // One seam along both tops of two joined pieces; the corner between them becomes a place of the band.
    let mut pattern = Pattern::default();
    let body = pattern.add_piece(polygon(&[[0.0, 0.0], [0.5, 0.0], [0.5, 0.25], [0.3, 0.25], [0.0, 0.25]]));
    let band = pattern.add_piece(rectangle(0.5, 0.04));
    let tops = Stretch { further: 1, ..Stretch::edge(body, 2) };
    let lower = Stretch::edge(band, 0);
    let seam = pattern.add_seam(Seam { sides: [tops, lower], same_direction: false, ratio: None, zip: None });
    let (garment, problems) = build(&pattern, 0.02);
    assert!(problems.is_empty(), "{problems:?}");
    let (id, pairs) = &garment.seam_pairs[0];
    assert_eq!((garment.seam_pairs.len(), *id), (1, seam));
    let corner = pairs.iter().find(|[a, _]| garment.corners[*a as usize].uv == DVec2::new(0.3, 0.25));
    let [_, on_band] = corner.expect("the corner is sewn");
    assert!((garment.corners[*on_band as usize].uv - DVec2::new(0.3, 0.0)).length() < 1e-9);
    // From the middle of one edge over the start of the outline to the middle of another.
    let over = Stretch { from: 0.5, further: 1, to: 0.25, ..Stretch::edge(body, 4) };
    let length = over.length(&pattern.pieces[&body]).unwrap();
    assert!((length - (0.125 + 0.125)).abs() < 1e-12, "{length}");
}

#[test]
fn a_stretch_that_is_not_there_is_named() {
    let mut pattern = banded(true);
    let seam = pattern.seams.values_mut().next().unwrap();
    seam.sides[0].further = 5;
    assert!(kinds(&pattern).contains(&ProblemKind::SeamToNothing));
}

#[test]
fn a_dart_closes_to_a_cone() {
    let mut pattern = alone(polygon(&[
        [0.0, 0.0],
        [0.25, 0.0],
        [0.3, 0.2],
        [0.35, 0.0],
        [0.6, 0.0],
        [0.6, 0.5],
        [0.0, 0.5],
    ]));
    sew(&mut pattern, (PieceId(1), 1), (PieceId(1), 2));
    let (garment, problems) = build(&pattern, 0.02);
    assert!(problems.is_empty(), "{problems:?}");
    let v = garment.vertex_count as i64;
    let e = garment.adjacency.edges.len() as i64;
    assert_eq!(v - e + garment.triangles.len() as i64, 1, "a disc");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Star-shaped outlines of any kind: nothing panics, area is kept, fronts are up, no needle beyond the outline's own.
    #[test]
    fn any_star_is_triangulated(radii in proptest::collection::vec(0.08..0.4f64, 3..24), edge in 0.01..0.08f64) {
        let n = radii.len();
        let points: Vec<[f64; 2]> = radii
            .iter()
            .enumerate()
            .map(|(i, r)| {
                let a = i as f64 / n as f64 * std::f64::consts::TAU;
                [r * a.cos(), r * a.sin()]
            })
            .collect();
        let piece = polygon(&points);
        let exact = piece.signed_area();
        let (garment, problems) = build(&alone(piece), edge);
        prop_assert!(problems.is_empty(), "{problems:?}");
        prop_assert!((area(&garment) / exact - 1.0).abs() < 1e-9);
        prop_assert!(garment.rest.iter().all(|t| (t[1] - t[0]).perp_dot(t[2] - t[0]) > 0.0));
    }

    /// Any polygon at all: a result or a named problem.
    #[test]
    fn any_polygon_ends_well(points in proptest::collection::vec(proptest::array::uniform2(-0.3..0.3f64), 0..12)) {
        let (garment, problems) = build(&alone(polygon(&points)), 0.03);
        prop_assert!(!problems.is_empty() || !garment.triangles.is_empty());
    }
}
