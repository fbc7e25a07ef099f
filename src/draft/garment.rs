//! A garment under construction: pieces are placed round the body, and runs of their edges are sewn.

use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};

use crate::draft::path::to_the_right;
use crate::geometry::ids::PieceId;
use crate::pattern::{Edge, EdgeRef, Pattern, Piece, Seam, SpacePose, Stretch, curve};

/// Ends of edges along a seam that are closer than this share of its length count as one.
const ONE_CUT: f64 = 1e-7;

/// Axis along which seams that run up and down are ordered.
pub const UPWARDS: DVec3 = DVec3::Y;

/// Direction of the outer side of a piece, before it is rotated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Facing {
    /// To the front: the piece is placed in front of the body.
    Front,
    /// To the back: the piece is placed behind the body, and drawn as seen from the front, through the body.
    Back,
}

/// Part of the body that a piece is for, as named in GarmentCode files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    Body,
    Arm,
    Leg,
}

impl Part {
    fn label(self) -> &'static str {
        match self {
            Self::Body => "body",
            Self::Arm => "arm",
            Self::Leg => "leg",
        }
    }
}

/// Run: consecutive edges along a seam, each with whether the outline has the direction of the run.
#[derive(Clone, Debug, Default)]
pub struct Run(Vec<(EdgeRef, bool)>);

/// Pieces and seams added so far.
#[derive(Clone, Debug, Default)]
pub struct Garment {
    /// The pattern.
    pub pattern: Pattern,
}

impl Garment {
    /// Adds `piece`, drawn as seen from the front in an upright plane, with its origin placed at `at`, metres.
    pub fn stand(&mut self, piece: Piece, part: Part, facing: Facing, at: DVec3) -> PieceId {
        self.stand_turned(piece, part, facing, at, DQuat::IDENTITY)
    }

    /// Adds a piece like [`Self::stand`], rotated about its origin by `turn`.
    pub fn stand_turned(
        &mut self,
        mut piece: Piece,
        part: Part,
        facing: Facing,
        at: DVec3,
        turn: DQuat,
    ) -> PieceId {
        if facing == Facing::Back {
            piece.outline = curve::reversed(&piece.outline);
        }
        piece.placement = Some(SpacePose::flat(at, turn));
        piece.label = Some(part.label().to_owned());
        self.pattern.add_piece(piece)
    }

    /// Adds a piece of the left side, rotated by `angle` radians counter-clockwise as seen from the front, and its mirror image
    /// on the right.
    pub fn stand_pair(
        &mut self,
        left: Piece,
        part: Part,
        facing: Facing,
        at: DVec3,
        angle: f64,
    ) -> [PieceId; 2] {
        let right = to_the_right(&left);
        let mirrored = DVec3::new(-at.x, at.y, at.z);
        [(left, at, angle), (right, mirrored, -angle)].map(|(piece, at, angle)| {
            self.stand_turned(piece, part, facing, at, DQuat::from_rotation_z(angle))
        })
    }

    /// The edges of `pieces` called `label` (alone or followed by further words), ordered and directed along `axis` in space.
    pub fn run(&self, pieces: &[PieceId], label: &str, axis: DVec3) -> Run {
        let is_called = |edge: &Edge| {
            let rest = edge.label.as_deref().and_then(|own| own.strip_prefix(label));
            rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(' '))
        };
        let mut found: Vec<(f64, EdgeRef, bool)> = Vec::new();
        for &id in pieces {
            let Some(piece) = self.pattern.pieces.get(&id) else { continue };
            let along = |p: DVec2| piece.placement.map_or(0.0, |pose| pose.at(p).dot(axis));
            for (i, _) in piece.outline.iter().enumerate().filter(|(_, edge)| is_called(edge)) {
                let (a, b) = piece.edge_ends(i);
                let ends = [along(a), along(b)];
                found.push((ends[0] + ends[1], EdgeRef { piece: id, edge: i }, ends[0] < ends[1]));
            }
        }
        found.sort_by(|a, b| a.0.total_cmp(&b.0));
        Run(found.into_iter().map(|(_, edge, forward)| (edge, forward)).collect())
    }

    /// Length of a run, metres.
    pub fn length(&self, run: &Run) -> f64 {
        run.0.iter().map(|(edge, _)| self.edge_length(*edge)).sum()
    }

    fn edge_length(&self, edge: EdgeRef) -> f64 {
        self.pattern.pieces.get(&edge.piece).map_or(0.0, |piece| piece.exact_edge_length(edge.edge))
    }

    /// Sews two runs, start to start and end to end. The longer one is gathered evenly.
    pub fn sew(&mut self, one: &Run, other: &Run) {
        let runs = [one, other].map(|run| self.ends(run));
        let mut cuts: Vec<f64> = runs.iter().flatten().copied().collect();
        cuts.sort_by(f64::total_cmp);
        cuts.dedup_by(|a, b| (*a - *b).abs() < ONE_CUT);
        let mut from = 0.0;
        for to in cuts {
            let sides = [(one, &runs[0]), (other, &runs[1])].map(|(run, ends)| part(run, ends, from, to));
            if let [Some((a, forth)), Some((b, back))] = sides {
                self.pattern.add_seam(Seam {
                    sides: [a, b],
                    same_direction: forth == back,
                    ratio: None,
                    zip: None,
                });
            }
            from = to;
        }
    }

    /// Sews the edges of `front` with each of `labels` to those of `back`, as runs along `axis`.
    pub fn sew_alike(&mut self, front: &[PieceId], back: &[PieceId], labels: &[&str], axis: DVec3) {
        for label in labels {
            let runs = [front, back].map(|pieces| self.run(pieces, label, axis));
            self.sew(&runs[0], &runs[1]);
        }
    }

    /// Closes the darts of `pieces`: pairs of neighbouring edges whose labels begin with "dart".
    pub fn sew_darts(&mut self, pieces: &[PieceId]) {
        for &id in pieces {
            let Some(piece) = self.pattern.pieces.get(&id).map(Arc::clone) else { continue };
            let is_dart =
                |i: usize| piece.outline[i].label.as_deref().is_some_and(|label| label.starts_with("dart"));
            let mut i = 0;
            while i + 1 < piece.outline.len() {
                if is_dart(i) && is_dart(i + 1) {
                    let sides = [i, i + 1].map(|edge| EdgeRef { piece: id, edge });
                    self.pattern.add_seam(Seam::of_edges(sides, false));
                    i += 1;
                }
                i += 1;
            }
        }
    }

    /// Ends of the edges of a run as shares of its length; the last is 1.
    fn ends(&self, run: &Run) -> Vec<f64> {
        let total = self.length(run);
        let mut so_far = 0.0;
        let mut ends: Vec<f64> = run
            .0
            .iter()
            .map(|(edge, _)| {
                so_far += self.edge_length(*edge);
                so_far / total
            })
            .collect();
        if let Some(last) = ends.last_mut() {
            *last = 1.0;
        }
        ends
    }
}

/// The part of a run between two shares of its length, which must be on one edge, and whether the outline has its direction.
fn part(run: &Run, ends: &[f64], from: f64, to: f64) -> Option<(Stretch, bool)> {
    let middle = (from + to) / 2.0;
    let k = ends.iter().position(|&end| middle < end)?;
    let (edge, forward) = *run.0.get(k)?;
    let start = if k == 0 { 0.0 } else { ends[k - 1] };
    let snapped = |share: f64| {
        let own = (share - start) / (ends[k] - start);
        if own < 1e-6 { 0.0 } else { if own > 1.0 - 1e-6 { 1.0 } else { own } }
    };
    let (a, b) = (snapped(from), snapped(to));
    let (from, to) = if forward { (a, b) } else { (1.0 - b, 1.0 - a) };
    Some((Stretch { from, to, ..Stretch::from(edge) }, forward))
}
