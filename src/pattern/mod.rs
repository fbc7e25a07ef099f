//! The flat pattern of a garment: pieces and seams.

pub mod activity;
pub mod bow;
mod chains;
pub mod corner;
pub mod curve;
pub mod cut;
pub mod edge;
pub mod edit;
pub mod fastenings;
pub mod fineness;
pub mod grading;
pub mod layers;
pub mod naming;
pub mod piece;
pub mod sampling;
pub mod seam;
pub mod space;
pub mod stitches;
pub mod triangulate;
pub mod trims;
pub mod wrinkles;

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::geometry::ids::{ButtonId, PieceId, SeamId};
pub use crate::geometry::problem::{self, Problem, ProblemKind};
pub use bow::Bow;
pub use corner::{AllowanceCorner, Side};
pub use cut::CutPattern;
pub use edge::{Edge, EdgeShape};
pub use fastenings::{Button, PiecePoint, Zip};
pub use grading::{GradeRule, RulePoint, SizeRun};
pub use piece::{InternalLine, Notch, Piece, PlanePose};
pub use seam::{EdgeRef, EdgeSeam, Seam, Stretch};
pub use space::{Roll, SpacePose};
pub use triangulate::PieceMesh;
pub use trims::{Elastic, Fold, Hem, Piping, Topstitch, Trims, Wrinkle};

/// A pattern: pieces and the seams between them. Ids come from `next_id` and are never used twice.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Pattern {
    /// The pieces, in the order of their ids, which is also the order in which they were made.
    pub pieces: BTreeMap<PieceId, Arc<Piece>>,
    /// The seams, in the order of their ids.
    pub seams: BTreeMap<SeamId, Seam>,
    /// The buttons, in the order of their ids.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub buttons: BTreeMap<ButtonId, Button>,
    /// The next free number for any id.
    pub next_id: u32,
    /// The sizes that the pattern can be graded to; each rule of its points has a displacement for each.
    #[serde(default, skip_serializing_if = "SizeRun::is_empty")]
    pub sizes: SizeRun,
}

impl Pattern {
    /// Adds a piece under a new id.
    pub fn add_piece(&mut self, piece: Piece) -> PieceId {
        let id = PieceId(self.fresh_id());
        self.pieces.insert(id, Arc::new(piece));
        id
    }

    /// Adds a seam under a new id.
    pub fn add_seam(&mut self, seam: Seam) -> SeamId {
        let id = SeamId(self.fresh_id());
        self.seams.insert(id, seam);
        id
    }

    /// Adds a button under a new id.
    pub fn add_button(&mut self, button: Button) -> ButtonId {
        let id = ButtonId(self.fresh_id());
        self.buttons.insert(id, button);
        id
    }

    /// Whether a part is only tacked on, as a bow is.
    pub fn has_tacks(&self) -> bool {
        self.buttons.values().any(|button| button.tack && !button.open)
    }

    /// Whether a seam is folded so that what is sewn together there turns over ([`Fold::turns_over`]).
    pub fn turns_over_at_a_seam(&self) -> bool {
        let folds = |side: &Stretch| {
            let Some(piece) = self.pieces.get(&side.piece) else { return false };
            let parts = side.parts(piece).unwrap_or_default();
            parts.iter().any(|&(i, ..)| piece.edge(i).trims.fold.is_some_and(|fold| fold.turns_over()))
        };
        self.seams.values().any(|seam| seam.sides.iter().any(folds))
    }

    /// The piece called `name`; the first, when several have that name.
    pub fn piece_named(&self, name: &str) -> Option<PieceId> {
        self.pieces.iter().find(|(_, p)| p.name == name).map(|(&id, _)| id)
    }

    /// Stores the present length ratio of every seam whose ratio is within [`edit::RATIOS`]; editing keeps it from
    /// now on. Sides of different length become gathers.
    pub fn keep_ratios(&mut self) {
        let Self { pieces, seams, .. } = self;
        for seam in seams.values_mut() {
            let length = |k: usize| seam.sides[k].length(pieces.get(&seam.sides[k].piece)?);
            if let (Some(one), Some(other)) = (length(0), length(1))
                && edit::RATIOS.contains(&(one / other))
            {
                seam.ratio = Some(one / other);
            }
        }
    }

    fn fresh_id(&mut self) -> u32 {
        self.next_id += 1;
        self.next_id
    }
}
