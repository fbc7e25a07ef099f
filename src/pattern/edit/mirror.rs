//! Mirror images of twins and symmetric pieces: which points are images of which, and restoring the symmetry.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};

use crate::geometry::ids::PieceId;
use crate::pattern::curve::{self, mirror};
use crate::pattern::{
    AllowanceCorner, EdgeRef, GradeRule, InternalLine, Notch, Pattern, Piece, Roll, Seam, SpacePose, Stretch,
};

/// The degrees of freedom of a pattern: the points that move freely, and how the others follow from them by mirroring.
pub(super) struct Dofs {
    /// For each point of a piece the index of its degree of freedom, and whether the point is its mirror image.
    of: BTreeMap<PieceId, Vec<(usize, bool)>>,
    on_axis: Vec<bool>,
}

impl Dofs {
    pub fn new(pattern: &Pattern) -> Self {
        let mut dofs = Self { of: BTreeMap::new(), on_axis: Vec::new() };
        for (&id, piece) in &pattern.pieces {
            let count = piece.edge_count();
            let of_twin = piece.twin.filter(|&twin| twin < id).and_then(|twin| dofs.of.get(&twin).cloned());
            let own = match of_twin {
                Some(of_twin) if of_twin.len() == count => (0..count)
                    .map(|i| {
                        let (dof, image) = of_twin[image_point(piece, i)];
                        (dof, !image)
                    })
                    .collect(),
                _ => dofs.fresh(piece),
            };
            dofs.of.insert(id, own);
        }
        dofs
    }

    fn fresh(&mut self, piece: &Piece) -> Vec<(usize, bool)> {
        let n = piece.outline.len();
        let mut own: Vec<(usize, bool)> = Vec::with_capacity(piece.edge_count());
        for i in 0..piece.edge_count() {
            if piece.symmetric && i > n / 2 && i < n {
                own.push((own[n - i].0, true));
            } else {
                own.push((self.on_axis.len(), false));
                self.on_axis.push(piece.symmetric && (i == 0 || i == n / 2));
            }
        }
        own
    }

    /// Current positions of the degrees of freedom.
    pub fn start(&self, pattern: &Pattern) -> Vec<DVec2> {
        let mut x = vec![DVec2::ZERO; self.on_axis.len()];
        for (id, own) in self.of.iter().rev() {
            for (i, &(dof, image)) in own.iter().enumerate().rev() {
                let p = pattern.pieces[id].edge(i).start;
                x[dof] = if image { mirror(p) } else { p };
            }
        }
        x
    }

    /// Position of a point when the degrees of freedom are at `x`.
    pub fn place(&self, x: &[DVec2], point: EdgeRef) -> DVec2 {
        let (dof, image) = self.of[&point.piece][point.edge];
        let p = if self.on_axis[dof] { DVec2::new(0.0, x[dof].y) } else { x[dof] };
        if image { mirror(p) } else { p }
    }

    /// A gradient at a point as a gradient of its degree of freedom, which is returned with its index.
    pub fn pulled(&self, point: EdgeRef, pull: DVec2) -> (usize, DVec2) {
        let (dof, image) = self.of[&point.piece][point.edge];
        let pull = if image { mirror(pull) } else { pull };
        (dof, if self.on_axis[dof] { DVec2::new(0.0, pull.y) } else { pull })
    }

    /// For each degree of freedom the least weight of its points.
    pub fn weights(&self, of_point: impl Fn(EdgeRef) -> f64) -> Vec<f64> {
        let mut weights = vec![f64::INFINITY; self.on_axis.len()];
        for (&piece, own) in &self.of {
            for (edge, &(dof, _)) in own.iter().enumerate() {
                weights[dof] = weights[dof].min(of_point(EdgeRef { piece, edge }));
            }
        }
        weights
    }
}

/// The point of the twin of which point `i` is the image; the two pieces have the same closed lines.
pub(super) fn image_point(piece: &Piece, i: usize) -> usize {
    let (k, first) = piece.loop_of(i);
    let n = piece.loop_edges(k).len();
    first + (n - (i - first)) % n
}

/// The edge of the twin of which edge `i` is the image.
pub(super) fn image_edge(piece: &Piece, i: usize) -> usize {
    let (k, first) = piece.loop_of(i);
    let n = piece.loop_edges(k).len();
    first + n - 1 - (i - first)
}

/// The mirror image of a seam: on the twins of its pieces, or on the other half of symmetric pieces. None where a
/// side has no image, or where the seam is its own image.
pub(super) fn image_seam(pattern: &Pattern, seam: &Seam) -> Option<Seam> {
    let [one, other] = seam.sides;
    let sides = [image_stretch(pattern, &one)?, image_stretch(pattern, &other)?];
    let is_own = sides == seam.sides || sides == [other, one];
    // Both sides run in the opposite direction, so that `same_direction` stays.
    (!is_own).then_some(Seam { sides, ..*seam })
}

fn image_stretch(pattern: &Pattern, side: &Stretch) -> Option<Stretch> {
    let piece = pattern.pieces.get(&side.piece)?;
    let on = piece.twin.or_else(|| piece.symmetric.then_some(side.piece))?;
    let parts = side.parts(piece)?;
    let (&(first, from, _), &(last, _, to)) = (parts.first()?, parts.last()?);
    if piece.twin.is_none() && piece.loop_of(first).0 != 0 {
        return None;
    }
    Some(Stretch {
        piece: on,
        edge: image_edge(piece, last),
        from: 1.0 - to,
        further: parts.len() - 1,
        to: 1.0 - from,
    })
}

/// Makes the shape of `piece` the mirror image of `twin`: outline, holes, lines, notches, grainline, allowance and
/// cutting line.
pub(super) fn take_image(piece: &mut Piece, twin: &Piece) {
    piece.outline = curve::mirrored(&twin.outline);
    piece.holes = twin.holes.iter().map(|hole| curve::mirrored(hole)).collect();
    piece.lines = twin.lines.iter().map(image_line).collect();
    let image = |n: &Notch| Notch { edge: image_edge(twin, n.edge), at: 1.0 - n.at };
    piece.notches = twin.notches.iter().map(image).collect();
    piece.grainline = twin.grainline.map(|ends| ends.map(mirror));
    piece.allowance = twin.allowance;
    piece.cut_line = curve::mirrored(&twin.cut_line);
    piece.symmetric = twin.symmetric;
}

pub(super) fn image_line(line: &InternalLine) -> InternalLine {
    let mut new = line.clone();
    new.end = mirror(line.end);
    new.end_rule = line.end_rule.as_ref().map(GradeRule::mirrored);
    for edge in &mut new.edges {
        edge.start = mirror(edge.start);
        edge.shape = edge.shape.mapped(true, mirror);
        edge.rule = edge.rule.as_ref().map(GradeRule::mirrored);
    }
    new
}

/// The mirror image in x = 0 of a placement in space, for a piece that is mirrored in its own plane.
pub(super) fn image_placement(pose: SpacePose) -> SpacePose {
    let (t, q) = (pose.translation, pose.rotation);
    let roll = pose.roll.map(|roll| Roll {
        centre: curve::mirror(roll.centre),
        along: curve::mirror(roll.along),
        radius: roll.radius,
    });
    let rotation = DQuat::from_xyzw(q.x, -q.y, -q.z, q.w);
    SpacePose { translation: DVec3::new(-t.x, t.y, t.z), rotation, roll }
}

/// Makes the right half of a symmetric outline exactly the mirror image of its left half.
pub(super) fn mend_symmetry(piece: &mut Piece) {
    let n = piece.outline.len();
    piece.outline[0].start.x = 0.0;
    piece.outline[n / 2].start.x = 0.0;
    for i in [0, n / 2] {
        let rule = &mut piece.outline[i].rule;
        *rule = rule.as_ref().map(|rule| rule.mapped(|by| DVec2::new(0.0, by.y)));
    }
    let image = curve::mirrored(&piece.outline);
    let labels: Vec<_> = piece.outline.iter().map(|edge| edge.label.clone()).collect();
    for i in n / 2..n {
        piece.outline[i] = image[i].clone();
        piece.outline[i].label = labels[i].clone();
    }
    // The points on the axis belong to both halves.
    piece.outline[n / 2].start.x = 0.0;
    for i in [0, n / 2] {
        piece.outline[i].corner = AllowanceCorner::default();
    }
}

/// Restores all symmetry. Of two twins the one in `from` leads, else the one with the lower id; symmetric pieces
/// follow their left half.
pub(super) fn mend_all(pattern: &mut Pattern, from: &[PieceId]) {
    let ids: Vec<PieceId> = pattern.pieces.keys().copied().collect();
    for &id in &ids {
        if pattern.pieces[&id].symmetric {
            let piece = &pattern.pieces[&id];
            let mut mended = Piece::clone(piece);
            mend_symmetry(&mut mended);
            if mended != **piece {
                pattern.pieces.insert(id, Arc::new(mended));
            }
        }
    }
    for &id in &ids {
        let Some(twin) = pattern.pieces[&id].twin else { continue };
        let leads = match (from.contains(&id), from.contains(&twin)) {
            (true, false) => true,
            (false, true) => false,
            _ => id < twin,
        };
        let Some(other) = pattern.pieces.get(&twin).filter(|_| leads) else { continue };
        let mut mended = Piece::clone(other);
        take_image(&mut mended, &pattern.pieces[&id]);
        if mended != **other {
            pattern.pieces.insert(twin, Arc::new(mended));
        }
    }
}
