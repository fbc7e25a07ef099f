//! Making twins and symmetric pieces, unfolding, folding and unlinking them.

use glam::{DAffine2, DMat2, DVec2};
use kurbo::{Line, ParamCurveArclen, Point};

use crate::geometry::ids::PieceId;
use crate::geometry::words::{Words, words};
use crate::pattern::edit::lines::{self, LineMap, Part};
use crate::pattern::edit::mirror::{self, image_line, image_placement, take_image};
use crate::pattern::edit::pieces::{change, fresh_name, map_piece};
use crate::pattern::edit::{Carried, Change, find, sewing};
use crate::pattern::{
    AllowanceCorner, Edge, EdgeRef, EdgeShape, Notch, Pattern, Piece, PlanePose, Roll, Seam, SpacePose, curve,
};

/// Distance within which a point is snapped to the axis of symmetry, metres.
const ON_AXIS: f64 = 1e-6;

pub(super) fn add_twin(pattern: &mut Pattern, id: PieceId, offset: DVec2) -> Result<Change, Words> {
    let piece = find(pattern, id)?.clone();
    if piece.twin.is_some() {
        return Err(words!("{name} has a twin: unlink it first", name = piece.name));
    }
    let mut twin = Piece { twin: Some(id), ..Piece::clone(&piece) };
    take_image(&mut twin, &piece);
    twin.name = other_side(&piece.name).unwrap_or_else(|| fresh_name(pattern, &piece.name));
    twin.label = piece.label.clone();
    twin.placement = piece.placement.map(image_placement);
    twin.pose = PlanePose {
        offset: piece.pose.offset + offset,
        rotation: -piece.pose.rotation,
        flipped: piece.pose.flipped,
    };
    let twin = pattern.add_piece(twin);
    change(pattern, id, |p| p.twin = Some(twin));
    let seams: Vec<Seam> = pattern.seams.values().copied().collect();
    for seam in seams.iter().filter(|seam| seam.sides.iter().any(|side| side.piece == id)) {
        if let Some(image) = mirror::image_seam(pattern, seam)
            && sewing::fits(pattern, &image).is_ok()
        {
            pattern.add_seam(image);
        }
    }
    Ok(Change::new(words!("mirror {name}", name = piece.name)))
}

/// The name of the piece on the other side: "left sleeve" for "right sleeve".
fn other_side(name: &str) -> Option<String> {
    let pairs = [("left", "right"), ("Left", "Right"), ("LEFT", "RIGHT")];
    pairs.iter().find_map(|(l, r)| match (name.contains(l), name.contains(r)) {
        (true, false) => Some(name.replace(l, r)),
        (false, true) => Some(name.replace(r, l)),
        _ => None,
    })
}

pub(super) fn unlink(pattern: &mut Pattern, id: PieceId) -> Result<Change, Words> {
    let piece = find(pattern, id)?.clone();
    if piece.twin.is_none() && !piece.symmetric {
        return Err(words!("{name} is linked to nothing", name = piece.name));
    }
    loosen(pattern, id);
    Ok(Change::new(words!("unlink {name}", name = piece.name)))
}

/// Removes the twin of a piece and its own symmetry.
pub(super) fn loosen(pattern: &mut Pattern, id: PieceId) {
    if let Some(twin) = pattern.pieces.get(&id).and_then(|p| p.twin) {
        change(pattern, twin, |p| p.twin = None);
    }
    change(pattern, id, |p| {
        p.twin = None;
        p.symmetric = false;
    });
}

pub(super) fn make_symmetric(pattern: &mut Pattern, id: PieceId, axis: [DVec2; 2]) -> Result<Change, Words> {
    let name = find(pattern, id)?.name.clone();
    let along =
        (axis[1] - axis[0]).try_normalize().ok_or_else(|| words!("the middle line needs two points"))?;
    loosen(pattern, id);
    // The part left of the line is mapped to x < 0.
    let map = turn(pattern, id, axis[0], along);
    cross(pattern, id);
    let piece = find(pattern, id)?.clone();
    let n = piece.outline.len();
    let is_left = |i: usize| piece.edge_points(i, &[0.5])[0].x < 0.0;
    let left: Vec<bool> = (0..n).map(is_left).collect();
    let starts: Vec<usize> = (0..n).filter(|&i| left[i] && !left[(i + n - 1) % n]).collect();
    let [start] = starts[..] else {
        return Err(words!("the line must cut {name} into one left and one right part", name));
    };
    let half = (0..n).take_while(|k| left[(start + k) % n]).count();
    if half == n {
        return Err(words!("the line does not cut {name}", name));
    }
    let mut map_old: LineMap = vec![Vec::new(); n];
    // Where the right half is drawn like the left one, its seams stay.
    let alike = n - half == half;
    for k in 0..n {
        if k < half || alike {
            map_old[(start + k) % n] = vec![Part::whole(k)];
        }
    }
    let mut edges: Vec<Edge> = (0..half).map(|k| piece.outline[(start + k) % n].clone()).collect();
    edges.push(Edge { start: piece.outline[(start + half) % n].start, ..Edge::default() });
    let labels: Vec<Option<String>> = (0..half)
        .map(|k| if alike { piece.outline[(start + half + k) % n].label.clone() } else { None })
        .collect();
    let outline = doubled(&edges, labels);
    lines::replace(pattern, id, 0, outline, &map_old);
    change(pattern, id, |p| {
        p.symmetric = true;
        mirror::mend_symmetry(p);
    });
    Ok(Change {
        carried: vec![Carried { from: id, to: id, map, inside: None }],
        ..Change::new(words!("make {name} symmetric", name))
    })
}

pub(super) fn unfold(pattern: &mut Pattern, edge: EdgeRef) -> Result<Change, Words> {
    let id = edge.piece;
    let piece = find(pattern, id)?.clone();
    if edge.edge >= piece.outline.len() || !matches!(piece.outline[edge.edge].shape, EdgeShape::Line) {
        return Err(words!("a piece is opened out along a straight edge of its outline"));
    }
    if piece.outline.len() < 3 {
        return Err(words!("{name} has too few edges to be opened out", name = piece.name));
    }
    loosen(pattern, id);
    let (a, b) = piece.edge_ends(edge.edge);
    let map = turn(pattern, id, a, (b - a).normalize());
    let piece = find(pattern, id)?.clone();
    let n = piece.outline.len();
    // From the end of the fold round to its start.
    let edges: Vec<Edge> = (1..=n).map(|k| piece.outline[(edge.edge + k) % n].clone()).collect();
    let labels = edges[..n - 1].iter().rev().map(|e| e.label.clone()).collect();
    let outline = doubled(&edges, labels);
    let count = outline.len();
    let mut map_old: LineMap = vec![Vec::new(); n];
    for k in 1..n {
        map_old[(edge.edge + k) % n] = vec![Part::whole(k - 1)];
    }
    lines::replace(pattern, id, 0, outline, &map_old);
    change(pattern, id, |p| {
        p.symmetric = true;
        mirror::mend_symmetry(p);
        let images: Vec<Notch> = p
            .notches
            .iter()
            .filter(|notch| notch.edge < count)
            .map(|notch| Notch { edge: count - 1 - notch.edge, at: 1.0 - notch.at })
            .collect();
        p.notches.extend(images);
        let holes: Vec<Vec<Edge>> = p.holes.iter().map(|hole| curve::mirrored(hole)).collect();
        p.holes.extend(holes);
        let lines: Vec<_> = p.lines.iter().map(image_line).collect();
        p.lines.extend(lines);
    });
    Ok(Change {
        carried: vec![Carried { from: id, to: id, map, inside: None }],
        ..Change::new(words!("open {name} out", name = piece.name))
    })
}

pub(super) fn fold(pattern: &mut Pattern, id: PieceId) -> Result<Change, Words> {
    let piece = find(pattern, id)?.clone();
    if !piece.symmetric {
        return Err(words!("{name} is not symmetric", name = piece.name));
    }
    loosen(pattern, id);
    let n = piece.outline.len();
    let mut edges: Vec<Edge> = piece.outline[..n / 2].to_vec();
    edges.push(Edge { start: piece.outline[n / 2].start, ..Edge::default() });
    let map = (0..n).map(|i| if i < n / 2 { vec![Part::whole(i)] } else { Vec::new() }).collect();
    let side = piece.edge_points(0, &[0.5])[0].x.signum();
    let kept = |p: DVec2| p.x * side >= -ON_AXIS;
    lines::replace(pattern, id, 0, edges, &map);
    // Holes beyond the fold are removed with their seams; the last first, so that numbers stay valid.
    for hole in (0..piece.holes.len()).rev() {
        if !piece.holes[hole].iter().all(|e| kept(e.start)) {
            super::holes::drop_hole(pattern, id, hole);
        }
    }
    change(pattern, id, |p| {
        p.lines.retain(|line| line.edges.iter().all(|e| kept(e.start)) && kept(line.end));
        p.grainline = p.grainline.filter(|ends| ends.iter().all(|&p| kept(p)));
    });
    Ok(Change::new(words!("fold {name}", name = piece.name)))
}

/// A closed outline from an open half that runs from axis to axis (its end is the last edge's start) and the mirror
/// image of that half.
fn doubled(half: &[Edge], image_labels: Vec<Option<String>>) -> Vec<Edge> {
    let m = half.len() - 1;
    let mut edges = half[..m].to_vec();
    let image = curve::mirrored(half);
    // Edge 0 of the image is that of the fold itself.
    edges.extend(image[1..].iter().cloned().zip(image_labels).map(|(edge, label)| Edge { label, ..edge }));
    for i in [0, m] {
        edges[i].start.x = 0.0;
        edges[i].smooth = false;
        edges[i].corner = AllowanceCorner::default();
        edges[i].rule = edges[i].rule.as_ref().map(|rule| rule.mapped(|by| DVec2::new(0.0, by.y)));
    }
    edges
}

/// Changes the plane of a piece so that `origin` becomes zero and `along` the y axis; the piece stays in place on the
/// table and in space. Returns the map from the old plane to the new one.
fn turn(pattern: &mut Pattern, id: PieceId, origin: DVec2, along: DVec2) -> DAffine2 {
    let matrix = DMat2::from_cols(DVec2::new(along.y, along.x), DVec2::new(-along.x, along.y));
    let map = DAffine2::from_mat2_translation(matrix, -(matrix * origin));
    change(pattern, id, |p| {
        map_piece(p, map);
        let back = map.inverse();
        let pose = p.pose;
        let origin = pose.plane_from_piece(back.transform_point2(DVec2::ZERO));
        let x = pose.plane_from_piece(back.transform_point2(DVec2::X)) - origin;
        let x = if pose.flipped { -x } else { x };
        p.pose = PlanePose { offset: origin, rotation: x.to_angle(), flipped: pose.flipped };
        p.placement = p.placement.map(|space| {
            let turned = DVec2::new(back.matrix2.x_axis.x, back.matrix2.x_axis.y).to_angle();
            SpacePose {
                translation: space.rotation * back.translation.extend(0.0) + space.translation,
                rotation: space.rotation * glam::DQuat::from_rotation_z(turned),
                roll: space.roll.map(|roll| Roll {
                    centre: map.transform_point2(roll.centre),
                    along: map.transform_vector2(roll.along),
                    ..roll
                }),
            }
        });
    });
    map
}

/// Inserts points where the outline crosses the line x = 0, exactly on it.
fn cross(pattern: &mut Pattern, id: PieceId) {
    let Some(piece) = pattern.pieces.get(&id).cloned() else { return };
    for i in (0..piece.outline.len()).rev() {
        let mut fractions = Vec::new();
        let segments = piece.edge_segments(i);
        let lengths: Vec<f64> = segments.iter().map(|s| s.arclen(1e-12)).collect();
        let total: f64 = lengths.iter().sum();
        let mut before = 0.0;
        for (segment, length) in segments.iter().zip(&lengths) {
            let far = 1e4;
            for hit in segment.intersect_line(Line::new(Point::new(0.0, -far), Point::new(0.0, far))) {
                let part = kurbo::ParamCurve::subsegment(segment, 0.0..hit.segment_t);
                fractions.push((before + part.arclen(1e-12)) / total);
            }
            before += length;
        }
        let inner = |f: &f64| *f * total > ON_AXIS && (1.0 - *f) * total > ON_AXIS;
        fractions.retain(inner);
        fractions.sort_by(f64::total_cmp);
        fractions.dedup_by(|b, a| (*b - *a) * total < ON_AXIS);
        if !fractions.is_empty() {
            lines::insert_points(pattern, EdgeRef { piece: id, edge: i }, &fractions);
        }
    }
    change(pattern, id, |p| {
        for edge in &mut p.outline {
            if edge.start.x.abs() < ON_AXIS {
                edge.start.x = 0.0;
            }
        }
    });
}
