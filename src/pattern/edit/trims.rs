//! Edits of trims: fold lines and elastic.

use serde::{Deserialize, Serialize};

use crate::geometry::ids::PieceId;
use crate::pattern::edit::pieces::change as change_piece;
use crate::pattern::edit::{Change, find, symmetric_image};
use crate::pattern::{EdgeRef, Pattern, Piece, Trims};

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
    label: &str,
    change: impl Fn(&mut Trims),
) -> Result<Change, String> {
    if lines.is_empty() {
        return Err(format!("choose an edge or a line first to {label}"));
    }
    for &line in lines {
        let piece = find(pattern, line.piece())?;
        if line.of(piece).is_none() {
            return Err(match line {
                TrimLine::Edge(edge) => format!("{} has no edge {}", piece.name, edge.edge.saturating_add(1)),
                TrimLine::Line { line, .. } => {
                    format!("{} has no line {}", piece.name, line.saturating_add(1))
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
