//! Edits of trims: what is worked along edges and internal lines.

use serde::{Deserialize, Serialize};

use crate::geometry::ids::PieceId;
use crate::geometry::words::{Words, words};
use crate::pattern::edit::pieces::change as change_piece;
use crate::pattern::edit::{Change, find, symmetric_image};
use crate::pattern::{EdgeRef, Pattern, Piece, Trims, Wrinkle};

/// A line of a piece that can have trims.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TrimLine {
    /// An edge of a closed line.
    Edge(EdgeRef),
    /// An internal line, by its number from 0.
    Line {
        /// The piece.
        piece: PieceId,
        /// Number of the line.
        line: usize,
    },
}

impl TrimLine {
    /// The piece that the line is on.
    pub fn piece(&self) -> PieceId {
        match *self {
            Self::Edge(edge) => edge.piece,
            Self::Line { piece, .. } => piece,
        }
    }

    /// The trims of the line; None where it is not on `piece`. An internal line has those of its first edge.
    pub fn of(&self, piece: &Piece) -> Option<Trims> {
        match *self {
            Self::Edge(edge) => (edge.edge < piece.edge_count()).then(|| piece.edge(edge.edge).trims),
            Self::Line { line, .. } => Some(piece.lines.get(line)?.edges.first()?.trims),
        }
    }
}

/// Changes the trims of all edges of `lines`. On symmetric pieces the mirror image of an edge changes too.
pub(super) fn set(
    pattern: &mut Pattern,
    lines: &[TrimLine],
    label: Words,
    change: impl Fn(&mut Trims),
) -> Result<Change, Words> {
    if lines.is_empty() {
        return Err(words!("choose an edge or a line first to {label}", label));
    }
    for &line in lines {
        let piece = find(pattern, line.piece())?;
        if line.of(piece).is_none() {
            return Err(match line {
                TrimLine::Edge(edge) => {
                    words!("{name} has no edge {n}", name = piece.name, n = edge.edge.saturating_add(1))
                }
                TrimLine::Line { line, .. } => {
                    words!("{name} has no line {n}", name = piece.name, n = line.saturating_add(1))
                }
            });
        }
        change_piece(pattern, line.piece(), |piece| match line {
            TrimLine::Line { line, .. } => {
                piece.lines[line].edges.iter_mut().for_each(|edge| change(&mut edge.trims));
            }
            TrimLine::Edge(EdgeRef { edge, .. }) => {
                for edge in std::iter::once(edge).chain(symmetric_image(piece, edge)) {
                    let (k, first) = piece.loop_of(edge);
                    change(&mut piece.loop_edges_mut(k)[edge - first].trims);
                }
            }
        });
    }
    Ok(Change::new(label))
}

/// Gives internal lines a wrinkle, or takes it away. Edges cannot have one: half of it would be on other pieces.
pub(super) fn set_wrinkle(
    pattern: &mut Pattern,
    lines: &[TrimLine],
    wrinkle: Option<Wrinkle>,
) -> Result<Change, Words> {
    if lines.iter().any(|line| matches!(line, TrimLine::Edge(_))) {
        return Err(words!("a wrinkle goes along a line inside a piece, not along an edge"));
    }
    let what = if wrinkle.is_some() { words!("set a wrinkle") } else { words!("smooth a wrinkle out") };
    set(pattern, lines, what, |trims| trims.wrinkle = wrinkle)
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::pattern::edit::{LinePoint, PatternEdit, apply};
    use crate::pattern::{Edge, InternalLine, Piping};

    fn kite(symmetric: bool) -> Pattern {
        // Its points 0 and 2 lie on the line of symmetry.
        let corners = [(0.0, 0.0), (0.2, 0.2), (0.0, 0.4), (-0.2, 0.2)].map(DVec2::from);
        let mut pattern = Pattern::default();
        pattern.add_piece(Piece { symmetric, ..Piece::polygon("kite", &corners) });
        pattern
    }

    fn done(pattern: &Pattern, edit: &PatternEdit) -> Pattern {
        apply(pattern, edit).expect("accepted").pattern
    }

    fn piped(piece: &Piece) -> Vec<usize> {
        (0..piece.edge_count()).filter(|&i| piece.edge(i).trims.piping == Some(Piping::USUAL)).collect()
    }

    #[test]
    fn piping_follows_on_twins_other_halves_and_both_parts_of_a_split_edge() {
        let piece = PieceId(1);
        let edge = EdgeRef { piece, edge: 0 };
        let set = |piping| PatternEdit::SetPiping { lines: vec![TrimLine::Edge(edge)], piping };
        let pipe = set(Some(Piping::USUAL));
        let symmetric = done(&kite(true), &pipe);
        assert_eq!(piped(&symmetric.pieces[&piece]), [0, 3]);
        assert_eq!(done(&symmetric, &set(None)), kite(true));
        let twins = done(&kite(false), &PatternEdit::AddTwin { piece, offset: DVec2::X });
        let twin = twins.pieces[&piece].twin.expect("a twin");
        let twins = done(&twins, &pipe);
        assert_eq!([piece, twin].map(|id| piped(&twins.pieces[&id])), [vec![0], vec![3]]);
        let more = done(&twins, &PatternEdit::InsertPoint { edge, at: 0.5 });
        assert_eq!([piece, twin].map(|id| piped(&more.pieces[&id])), [vec![0, 1], vec![3, 4]]);
    }

    #[test]
    fn piping_needs_a_line_that_is_there() {
        let refused = |lines: Vec<TrimLine>| {
            let edit = PatternEdit::SetPiping { lines, piping: Some(Piping::USUAL) };
            apply(&kite(false), &edit).expect_err("refused")
        };
        assert_eq!(refused(Vec::new()), "choose an edge or a line first to sew piping in");
        let beyond = EdgeRef { piece: PieceId(1), edge: 4 };
        assert_eq!(refused(vec![TrimLine::Edge(beyond)]), "kite has no edge 5");
        assert_eq!(refused(vec![TrimLine::Line { piece: PieceId(1), line: 0 }]), "kite has no line 1");
    }

    #[test]
    fn a_wrinkle_is_mirrored_to_the_twin_and_is_on_both_parts_of_a_split_line() {
        let piece = PieceId(1);
        let edges = vec![Edge { start: DVec2::new(-0.05, 0.1), ..Edge::default() }];
        let line = InternalLine { edges, end: DVec2::new(0.05, 0.3), ..InternalLine::default() };
        let lined = done(&kite(false), &PatternEdit::AddLine { piece, line });
        let twins = done(&lined, &PatternEdit::AddTwin { piece, offset: DVec2::X });
        let twin = twins.pieces[&piece].twin.expect("a twin");
        let lines = vec![TrimLine::Line { piece, line: 0 }];
        let set = |wrinkle| PatternEdit::SetWrinkle { lines: lines.clone(), wrinkle };
        let with = done(&twins, &set(Some(Wrinkle::USUAL)));
        let wrinkles = |pattern: &Pattern, id: PieceId| -> Vec<Option<Wrinkle>> {
            pattern.pieces[&id].lines[0].edges.iter().map(|edge| edge.trims.wrinkle).collect()
        };
        for id in [piece, twin] {
            assert_eq!(wrinkles(&with, id), [Some(Wrinkle::USUAL)]);
        }
        let edge = LinePoint { piece, line: 0, point: 0 };
        let more = done(&with, &PatternEdit::InsertLinePoint { edge, at: 0.4 });
        for id in [piece, twin] {
            assert_eq!(wrinkles(&more, id), [Some(Wrinkle::USUAL); 2]);
        }
        assert_eq!(done(&with, &set(None)), twins);
    }

    #[test]
    fn a_wrinkle_needs_a_line_inside_a_piece() {
        let refused = |lines: Vec<TrimLine>| {
            let edit = PatternEdit::SetWrinkle { lines, wrinkle: Some(Wrinkle::USUAL) };
            apply(&kite(false), &edit).expect_err("refused")
        };
        assert_eq!(refused(Vec::new()), "choose an edge or a line first to set a wrinkle");
        let edge = TrimLine::Edge(EdgeRef { piece: PieceId(1), edge: 0 });
        assert_eq!(refused(vec![edge]), "a wrinkle goes along a line inside a piece, not along an edge");
        assert_eq!(refused(vec![TrimLine::Line { piece: PieceId(1), line: 0 }]), "kite has no line 1");
    }
}
