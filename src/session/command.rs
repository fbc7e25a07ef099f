//! Commands: everything a person can do. Each is complete in itself: ids and absolute values, in metres and radians.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

use crate::body::mannequin::Measurements;
use crate::drag::{DragMode, Ray};
use crate::geometry::ids::{GraphicId, ImageId, MarkId, PieceId, PinId, SeamId};
use crate::geometry::words::Words;
use crate::pattern::edit::PatternEdit;
use crate::pattern::{Edge, Pattern, Piece, PlanePose, Seam};
use crate::session::animations::{Animations, Moment};
use crate::session::artwork::{Graphic, ImageFile};
use crate::session::body_choice::BodyChoice;
use crate::session::document::Settings;
use crate::session::dyes::Dye;
use crate::sim::StartChoice;
use crate::wrap::{ClothSide, Marks};

/// A command. New items get their ids from the document's counters, so that a replay gives them the same ids.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Command {
    /// Paint a stroke on a piece, in that piece's own plane. Its number is that of the last stroke on the cloth plus one.
    AddClothMark { piece: PieceId, side: ClothSide, points: Vec<DVec2> },
    /// Paint a stroke on the body's surface. Its number is that of the last stroke on the body plus one.
    AddBodyMark { points: Vec<DVec3> },
    /// Delete one stroke, on cloth or body; later ones move up a number.
    DeleteMark { mark: MarkId },
    /// Delete the strokes numbered `number` (from 1) on both sides.
    DeletePair { number: usize },
    /// Give a stroke the number `to` (from 1) on its side.
    MoveMark { mark: MarkId, to: usize },
    /// Name a stroke; an empty name removes it.
    RenameMark { mark: MarkId, name: String },
    /// Delete all strokes.
    ClearMarks,
    /// Replace all strokes, keeping the ids in `marks`.
    SetMarks { marks: Arc<Marks> },

    /// Put a new piece on the table.
    AddPiece { piece: Arc<Piece> },
    /// Delete a piece with its seams and its strokes (and their partners, so that other pairs stay pairs).
    DeletePiece { piece: PieceId },
    /// Rename a piece.
    RenamePiece { piece: PieceId, name: String },
    /// Move, rotate or flip a piece on the table.
    SetPiecePose { piece: PieceId, pose: PlanePose },
    /// Edit the pattern: all of the edits or none. `anew` within a gesture: in place of what the gesture did before.
    EditPattern { edits: Vec<PatternEdit>, anew: bool },
    /// Replace the outline of a piece. A sewn piece keeps its number of edges.
    SetOutline { piece: PieceId, outline: Vec<Edge> },
    /// Sew two edges together.
    AddSeam { seam: Seam },
    /// Remove a seam.
    DeleteSeam { seam: SeamId },
    /// Reverse the direction of a seam.
    ReverseSeam { seam: SeamId },
    /// Replace the pattern and its strokes, by a sample or an import. The cloth comes off.
    ReplacePattern { name: String, pattern: Arc<Pattern>, marks: Arc<Marks> },

    /// Change the body, perhaps with animations that move it. The cloth comes off; the strokes on the old body are transferred to
    /// the new one where they find a place.
    SetBody {
        body: BodyChoice,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        animations: Option<Arc<Animations>>,
    },
    /// Change the pose of the body: `body` has its triangles, vertex for vertex. The dressed cloth follows, and with `settle` it
    /// settles there. Strokes on the body follow their triangles. A `draft` is a quick preview of lower quality, for a pose still
    /// being chosen.
    Repose {
        body: BodyChoice,
        settle: bool,
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        draft: bool,
    },
    /// Change the measurements of the mannequin, in its present pose. The dressed cloth follows and, unless it was draped,
    /// settles there; strokes on the body are transferred where they find a place.
    ChangeSize { measurements: Measurements },
    /// Choose a target pose of the body, from a file: `body` has its triangles, vertex for vertex. The body does not move yet.
    AimPose { body: BodyChoice },
    /// Move the body to the share 0..=1 of the way from the pose in which the target pose was chosen to that target. Limbs keep
    /// their size on the way; cloth, strokes and `draft` as with `Repose`.
    PoseTowards {
        share: f64,
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        draft: bool,
    },
    /// Take the animations of a file whose body has the triangles of the present one, vertex for vertex. The body does not move
    /// yet.
    TakeAnimations { animations: Arc<Animations> },
    /// Move the body to this moment of its animations, or (none) to where it is at rest; cloth, strokes and `draft` as with
    /// `Repose`.
    Animate {
        at: Option<Moment>,
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        draft: bool,
    },
    /// Set bones, each by its two ends, that dragged cloth cannot be pulled across; none: the body's own again.
    SetBones { bones: Option<Vec<[DVec3; 2]>> },
    /// Change the mesh size and the settings of relaxation and draping.
    SetSettings { settings: Settings },

    /// Grow the cloth round the body from the marks.
    Wrap,
    /// Grow the dressed cloth anew from the pairs of marks with these numbers (from 1; none: all). Cloth that is at least as far
    /// from them as the nearest pin stays.
    Rewrap { pairs: Vec<usize> },
    /// Undo the last wrap: what was on the body before it returns.
    CancelWrap,
    /// Take the cloth off.
    Unwrap,
    /// Pin the cloth at a place of a piece, to where it is on the body.
    AddPin { piece: PieceId, at: DVec2 },
    /// Remove a pin.
    DeletePin { pin: PinId },
    /// Remove all pins that are not locked.
    ClearPins,
    /// Remove these pins.
    DeletePins { pins: Vec<PinId> },
    /// Move a pin to another place of the cloth.
    MovePin { pin: PinId, piece: PieceId, at: DVec2 },
    /// Lock pins, so that they can be neither moved nor removed, or unlock them.
    LockPins { pins: Vec<PinId>, locked: bool },
    /// Begin to drag the dressed cloth at a place of a piece. The drag lasts until `Release`; `CancelGesture` undoes all of it.
    Grab { piece: PieceId, at: DVec2, mode: DragMode },
    /// Move the dragged point to this ray of the pointer into the scene.
    DragTo { ray: Ray },
    /// End the drag; the cloth settles.
    Release,
    /// Pause relaxing or go on. Not an undo step.
    SetRelaxing { on: bool },

    /// Sew the garment together from the placement of its pieces, and drape it.
    Sew,
    /// Put the garment on by the best start: by marks, its own or suggested ones, and draping; else sewn from the placement of
    /// its pieces, which comes before suggested marks where something turns over at a seam. The first without a fault is taken.
    Dress {
        #[serde(default)]
        choice: StartChoice,
    },
    /// Drape the dressed cloth until it rests (all of it one undo step), or stop draping (no step).
    SetDraping { on: bool },
    /// Drape the dressed cloth for `ticks` ticks, 1..=600.
    StepDraping { ticks: u32 },
    /// Set the fabric of a piece, or (no piece) of all that have no fabric of their own. No fabric: that of all the others, or
    /// the usual one.
    SetFabric { piece: Option<PieceId>, fabric: Option<String> },
    /// Set colour, print and image of a piece, or (no piece) of all that have none of their own.
    SetDye { piece: Option<PieceId>, dye: Dye },
    /// Keep the present fabrics, colours and prints as the colourway of this name.
    KeepColourway { name: String },
    /// Take fabrics, colours and prints from the colourway of this name.
    WearColourway { name: String },
    /// Delete the colourway of this name.
    DeleteColourway { name: String },
    /// Take an image (PNG, JPEG) into the document.
    AddImage { file: Arc<ImageFile> },
    /// Delete an image with its graphics; fabrics lose it as their surface.
    DeleteImage { image: ImageId },
    /// Place an image on a piece.
    AddGraphic { graphic: Graphic },
    /// Move, scale or turn a graphic, or give it another image.
    SetGraphic { id: GraphicId, graphic: Graphic },
    /// Delete a graphic.
    DeleteGraphic { id: GraphicId },

    /// Undo the last step, document and cloth.
    Undo,
    /// Redo the last undone step.
    Redo,
    /// Esc during a gesture: everything it did is undone and cannot be redone.
    CancelGesture,
    /// The simulation has dropped states before this request: steps that need them can no longer be undone.
    ForgetHistory { before_seq: u64 },
}

/// Why a command was not carried out, in words for a person. The session is unchanged.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Rejection(pub Words);
