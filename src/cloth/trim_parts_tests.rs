use glam::DVec2;

use super::*;
use crate::cloth::build;
use crate::geometry::mesh::vertex_normals;
use crate::pattern::{EdgeRef, Hem, Pattern, Piece, PiecePoint, Piping, Seam, Topstitch, Zip};

const SQUARE: [(f64, f64); 4] = [(0.0, 0.0), (0.2, 0.0), (0.2, 0.1), (0.0, 0.1)];

/// A piece of 0.2 x 0.1 m with `change`.
fn pattern(change: impl FnOnce(&mut Piece)) -> Pattern {
    let mut piece = Piece::polygon("front", &SQUARE.map(DVec2::from));
    change(&mut piece);
    let mut pattern = Pattern::default();
    pattern.add_piece(piece);
    pattern
}

/// The garment of `pattern`, flat at z = 0 but for `bend`.
fn hung(pattern: &Pattern, bend: impl Fn(DVec3) -> DVec3) -> (Garment, ClothState) {
    let garment = build(pattern, 0.02).0;
    let mut state = ClothState {
        positions: vec![DVec3::ZERO; garment.vertex_count],
        mapped: vec![true; garment.vertex_count],
    };
    for c in &garment.corners {
        state.positions[c.vertex as usize] = bend(c.uv.extend(0.0));
    }
    (garment, state)
}

fn parts(pattern: &Pattern, (garment, state): &(Garment, ClothState), most: usize) -> TrimParts {
    TrimParts::new(&TrimShapes::new(garment, pattern), garment, state, most)
}

fn solid(part: &TrimPart, (garment, state): &(Garment, ClothState)) -> Solid {
    let normals = vertex_normals(&state.positions, &garment.triangles);
    let solid = part.solid(garment, state, &normals);
    assert_eq!(solid.normals.len(), solid.positions.len());
    assert!(solid.normals.iter().all(|normal| normal.is_normalized()), "{:?}", part.kind);
    assert!(solid.triangles.iter().flatten().all(|v| (*v as usize) < solid.positions.len()));
    solid
}

fn bounds(solid: &Solid) -> (Vec3, Vec3) {
    let all = solid.positions.iter();
    all.fold((Vec3::MAX, Vec3::MIN), |(low, high), &p| (low.min(p), high.max(p)))
}

fn stitched() -> Pattern {
    let topstitch = Topstitch { distance: 0.01, rows: 2, spacing: 0.01, ..Topstitch::default() };
    pattern(|piece| piece.outline[0].trims.topstitch = Some(topstitch))
}

#[test]
fn every_stitch_is_a_rod_on_its_row() {
    let pattern = stitched();
    let hung = hung(&pattern, |p| p);
    let all = parts(&pattern, &hung, usize::MAX);
    let [stitches] = &all.parts[..] else { panic!("{} parts", all.parts.len()) };
    assert_eq!((stitches.kind, all.left_out), (TrimKind::Stitches, 0));
    let solid = solid(stitches, &hung);
    let tips = solid.normals.iter().filter(|normal| normal.x.abs() > 0.999).count();
    assert_eq!(tips, 2 * 2 * 67, "two ends of a stitch each 3 mm, in two rows of 20 cm");
    let radius = THREAD_THICKNESS * STITCH_SHARES[0] / 2.0;
    for p in &solid.positions {
        let off = [0.01, 0.02].map(|y| (p.y - y).abs()).into_iter().fold(f32::MAX, f32::min);
        assert!(off < radius + 1e-6 && p.z.abs() < radius + 1e-6, "{p}");
    }
}

#[test]
fn too_many_stitches_have_fewer_sides_and_then_rows_are_left_out() {
    let pattern = stitched();
    let hung = hung(&pattern, |p| p);
    let vertices = |most: usize| {
        let all = parts(&pattern, &hung, most);
        (all.vertices(), all.left_out)
    };
    let (round, _) = vertices(usize::MAX);
    assert_eq!(vertices(round), (round, 0));
    let (thin, left_out) = vertices(round - 1);
    assert!(thin < round * 2 / 3 && thin > round / 3 && left_out == 0, "{thin} of {round}");
    let (one, left_out) = vertices(thin - 1);
    assert!(one <= thin * 2 / 3 && one >= thin / 3 && left_out == 1, "{one} of {thin}");
    assert_eq!(vertices(0), (0, 2));
    assert!(parts(&pattern, &hung, 0).parts.is_empty());
}

#[test]
fn a_zip_has_tapes_and_teeth_on_both_sides() {
    let mut pattern = pattern(|_| ());
    let first = *pattern.pieces.keys().next().expect("a piece");
    let second = pattern.add_piece(Piece::polygon("back", &SQUARE.map(DVec2::from)));
    let sides = [EdgeRef { piece: first, edge: 1 }, EdgeRef { piece: second, edge: 3 }];
    let seam = pattern.add_seam(Seam::of_edges(sides, false));
    let zip = Zip { colour: [200, 180, 100], ..Zip::CLOSED };
    pattern.seams.get_mut(&seam).expect("the seam").zip = Some(zip);
    // The second piece lies beside the first.
    let garment = build(&pattern, 0.02).0;
    let mut state = ClothState {
        positions: vec![DVec3::ZERO; garment.vertex_count],
        mapped: vec![true; garment.vertex_count],
    };
    for c in &garment.corners {
        let beside = if c.piece == second { DVec3::X * 0.2 } else { DVec3::ZERO };
        state.positions[c.vertex as usize] = c.uv.extend(0.0) + beside;
    }
    let hung = (garment, state);
    let all = parts(&pattern, &hung, usize::MAX);
    let kinds: Vec<TrimKind> = all.parts.iter().map(|part| part.kind).collect();
    assert_eq!(kinds, [TrimKind::ZipTape, TrimKind::ZipTeeth]);
    assert_eq!(all.parts[1].paint, Paint::Colour([200, 180, 100]));
    let [tape, teeth] = [0, 1].map(|i| bounds(&solid(&all.parts[i], &hung)));
    // Both rows are 2 mm from the seam at x = 0.2; a tooth is 3.5 mm wide, a tape twice that.
    assert!((tape.0.x - (0.2 - 0.0055)).abs() < 1e-5 && (tape.1.x - (0.2 + 0.0055)).abs() < 1e-5, "{tape:?}");
    assert!(
        (teeth.0.x - (0.2 - 0.00375)).abs() < 1e-5 && (teeth.1.x - (0.2 + 0.00375)).abs() < 1e-5,
        "{teeth:?}"
    );
    assert!(tape.0.y < 0.001 && tape.1.y > 0.099 && teeth.1.z < 0.001, "{tape:?} {teeth:?}");
}

#[test]
fn the_layer_of_a_hem_lies_on_the_inner_side() {
    let pattern = pattern(|piece| piece.outline[0].trims.hem = Some(Hem { width: 0.03, colour: None }));
    let hung = hung(&pattern, |p| p);
    let all = parts(&pattern, &hung, usize::MAX);
    let hem = all.parts.iter().find(|part| part.kind == TrimKind::Hem).expect("a hem");
    assert!(matches!(hem.paint, Paint::Inside(_)));
    let (low, high) = bounds(&solid(hem, &hung));
    assert!(
        (low - Vec3::new(0.0, 0.0, -crate::cloth::trim_shapes::HEM_LAYER)).abs().max_element() < 1e-6,
        "{low}"
    );
    assert!((high - Vec3::new(0.2, 0.03, 0.0)).abs().max_element() < 1e-6, "{high}");
}

#[test]
fn a_part_has_the_same_triangles_wherever_the_cloth_goes() {
    let mut pattern = pattern(|piece| {
        piece.outline[0].trims.topstitch = Some(Topstitch::default());
        piece.outline[1].trims.piping = Some(Piping::USUAL);
        piece.outline[2].trims.hem = Some(Hem::USUAL);
    });
    let piece = *pattern.pieces.keys().next().expect("a piece");
    let at = |x: f64| PiecePoint { piece, at: DVec2::new(x, 0.05) };
    let (diameter, colour) = (Button::SHIRT, Button::PEARL);
    pattern.add_button(Button {
        button: at(0.05),
        hole: at(0.15),
        diameter,
        colour,
        open: true,
        tack: false,
    });
    let flat = hung(&pattern, |p| p);
    let rolled =
        hung(&pattern, |p| DVec3::new(0.05 * (p.x / 0.05).sin(), p.y * 1.1, 0.05 * (p.x / 0.05).cos()));
    let all = parts(&pattern, &flat, usize::MAX);
    assert_eq!(all.parts.len(), 6);
    for part in &all.parts {
        let [one, other] = [&flat, &rolled].map(|hung| solid(part, hung));
        assert_eq!(one.triangles, other.triangles, "{:?}", part.kind);
        assert_eq!(one.positions.len(), other.positions.len(), "{:?}", part.kind);
        // All of it stays within 5 mm of the roll.
        for p in &other.positions {
            assert!((Vec3::new(p.x, 0.0, p.z).length() - 0.05).abs() < 0.005, "{:?}: {p}", part.kind);
        }
    }
    let button = all.parts.iter().find(|part| part.kind == TrimKind::Button).expect("a button");
    let (low, high) = bounds(&solid(button, &flat));
    assert!((low.midpoint(high).x - 0.05).abs() < 1e-4, "unfastened it is where it is sewn on");
}

#[test]
fn what_is_not_on_the_body_has_no_trims() {
    let pattern = pattern(|piece| {
        piece.outline[0].trims.topstitch = Some(Topstitch::default());
        piece.outline[1].trims.piping = Some(Piping::USUAL);
    });
    let mut hung = hung(&pattern, |p| p);
    hung.1.mapped.fill(false);
    hung.1.positions.fill(DVec3::NAN);
    let all = parts(&pattern, &hung, usize::MAX);
    assert!(all.parts.is_empty() && all.left_out == 0);
}
