//! Everything a person can do. Each command is complete in itself: ids and absolute values, in metres and radians.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

use crate::body::mannequin::Measurements;
use crate::drag::{DragMode, Ray};
use crate::geometry::ids::{MarkId, PieceId, PinId, SeamId};
use crate::pattern::edit::PatternEdit;
use crate::pattern::{Edge, Pattern, Piece, PlanePose, Seam};
use crate::session::animations::{Animations, Moment};
use crate::session::body_choice::BodyChoice;
use crate::session::document::Settings;
use crate::sim::StartChoice;
use crate::wrap::{ClothSide, Marks};

/// One thing done. New things get their ids from the document's counters, so that a replay gives them the same.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Command {
    /// Paint a stroke on a piece, in that piece's own plane. Its number is one more than the last on the cloth.
    AddClothMark { piece: PieceId, side: ClothSide, points: Vec<DVec2> },
    /// Paint a stroke on the body's surface. Its number is one more than the last on the body.
    AddBodyMark { points: Vec<DVec3> },
    /// Take one stroke away, on cloth or body; later ones move up a number.
    DeleteMark { mark: MarkId },
    /// Take the strokes numbered `number` (from 1) away on both sides.
    DeletePair { number: usize },
    /// Give a stroke the number `to` (from 1) among those of its side.
    MoveMark { mark: MarkId, to: usize },
    /// Give a stroke a name; an empty one takes its name away.
    RenameMark { mark: MarkId, name: String },
    /// Take all strokes away.
    ClearMarks,
    /// Replace all strokes. Ids in it are kept.
    SetMarks { marks: Arc<Marks> },

    /// Put a new piece on the table.
    AddPiece { piece: Arc<Piece> },
    /// Take a piece away with its seams and its strokes (and their partners, so that other pairs stay pairs).
    DeletePiece { piece: PieceId },
    /// Rename a piece.
    RenamePiece { piece: PieceId, name: String },
    /// Move, turn or flip a piece on the table.
    SetPiecePose { piece: PieceId, pose: PlanePose },
    /// Edit the pattern: all of it or nothing. `anew` within a gesture: in place of what the gesture did before.
    EditPattern { edits: Vec<PatternEdit>, anew: bool },
    /// Redraw a piece. A sewn piece keeps its number of edges.
    SetOutline { piece: PieceId, outline: Vec<Edge> },
    /// Sew two edges together.
    AddSeam { seam: Seam },
    /// Undo a seam.
    DeleteSeam { seam: SeamId },
    /// Sew the edges the other way round.
    ReverseSeam { seam: SeamId },
    /// Start from another pattern with its strokes: a sample, an import. The cloth comes off.
    ReplacePattern { name: String, pattern: Arc<Pattern>, marks: Arc<Marks> },

    /// Take another body, perhaps with animations that move it. The cloth comes off; the strokes on the old body are carried to
    /// the new one where they find a place.
    SetBody {
        body: BodyChoice,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        animations: Option<Arc<Animations>>,
    },
    /// The body takes another pose: `body` has its triangles, vertex for vertex. The dressed cloth goes along, and with
    /// `settle` it settles there. Strokes on the body follow their triangles. A `draft` is for a pose that is still being
    /// chosen: quick, and not so exact.
    Repose {
        body: BodyChoice,
        settle: bool,
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        draft: bool,
    },
    /// The mannequin is built to other measurements, in the pose it stands in. The dressed cloth goes along and, unless it was
    /// draped, settles there; strokes on the body are carried where they find a place.
    ChangeSize { measurements: Measurements },
    /// Choose another pose of the body, from a file: `body` has its triangles, vertex for vertex. It stays where it is.
    AimPose { body: BodyChoice },
    /// The body goes from the pose in which the other was chosen to that one, so far (0..=1) that its limbs keep their size
    /// on the way; cloth, strokes and `draft` as with `Repose`.
    PoseTowards {
        share: f64,
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        draft: bool,
    },
    /// Take the animations of a file whose body has the triangles of the dressed one, vertex for vertex. It stays where it is.
    TakeAnimations { animations: Arc<Animations> },
    /// The body goes to this moment of its animations, or (none) to where it is at rest; cloth, strokes and `draft` as with
    /// `Repose`.
    Animate {
        at: Option<Moment>,
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        draft: bool,
    },
    /// Draw bones in the body, from end to end, which cloth in the hand cannot be pulled across; none: the body's own again.
    SetBones { bones: Option<Vec<[DVec3; 2]>> },
    /// Change mesh size and how the cloth relaxes.
    SetSettings { settings: Settings },

    /// Grow the cloth round the body from the marks.
    Wrap,
    /// Grow the dressed cloth anew from the pairs of marks with these numbers (from 1; none: all). Cloth as far from them
    /// as the nearest pin, or farther, stays.
    Rewrap { pairs: Vec<usize> },
    /// Take the last wrap back: what was on the body before it returns.
    CancelWrap,
    /// Take the cloth off.
    Unwrap,
    /// Pin the cloth at a place of a piece, to where it is on the body.
    AddPin { piece: PieceId, at: DVec2 },
    /// Pull a pin out.
    DeletePin { pin: PinId },
    /// Pull all pins out that are not locked.
    ClearPins,
    /// Pull these pins out.
    DeletePins { pins: Vec<PinId> },
    /// Stick a pin in elsewhere.
    MovePin { pin: PinId, piece: PieceId, at: DVec2 },
    /// Lock pins, so that they can be neither moved nor pulled out, or unlock them.
    LockPins { pins: Vec<PinId>, locked: bool },
    /// Take the dressed cloth in the hand at a place of a piece. The drag lasts until `Release`; `CancelGesture` takes all
    /// of it back.
    Grab { piece: PieceId, at: DVec2, mode: DragMode },
    /// The pointer is there now: a ray into the scene.
    DragTo { ray: Ray },
    /// Let go; the cloth settles.
    Release,
    /// Pause or go on relaxing. Not an undo step.
    SetRelaxing { on: bool },

    /// Sew the garment together from where its pieces are placed in space, and drape it.
    Sew,
    /// Put the garment on by the best start: by marks, its own or suggested ones, and draped; else sewn from where its pieces are
    /// placed. The first without a fault is taken.
    Dress {
        #[serde(default)]
        choice: StartChoice,
    },
    /// Let physics move the dressed cloth until it rests (all of it one undo step), or stop that (no step).
    SetDraping { on: bool },
    /// The same for `ticks` ticks, 1..=600.
    StepDraping { ticks: u32 },
    /// What a piece is made of, or (no piece) all that have no fabric of their own. No fabric: that of all the others, or the
    /// usual one.
    SetFabric { piece: Option<PieceId>, fabric: Option<String> },

    /// Take the last step back, document and cloth.
    Undo,
    /// Do it again.
    Redo,
    /// Esc during a gesture: everything it did is taken back and cannot be redone.
    CancelGesture,
    /// The simulation has dropped states before this request: steps that need them can no longer be undone.
    ForgetHistory { before_seq: u64 },
}

/// Why a command was not carried out, in words for a person. The session is as if it had never been given.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Rejection(pub String);

impl Rejection {
    /// A rejection in these words.
    pub fn new(words: impl Into<String>) -> Self {
        Self(words.into())
    }
}
