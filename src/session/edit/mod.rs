//! What each command does to a document. Pure functions: they return a new document, or a rejection.

mod artwork;
mod body;
mod checks;
mod drag;
mod drape;
mod dyes;
mod marks;
mod pattern;
mod settings;
mod wrap;

use std::sync::Arc;

use glam::DVec3;

use crate::drag::{DragMode, Ray};
use crate::geometry::words::{Words, words};
use crate::pattern::edit::{Carried, PatternEdit};
use crate::pattern::{Pattern, Problem};
use crate::relax::RelaxSettings;
use crate::session::body::BodyCache;
use crate::session::carry;
use crate::session::command::{Command, Rejection};
use crate::session::document::{Document, Settings};
use crate::session::dyes::colourways_problem;
use crate::session::history::StepKind;
use crate::sim::{ClothPlace, StartChoice};
use crate::wrap::Marks;

/// The request to the simulation that a command makes.
#[derive(Clone, Debug, PartialEq)]
pub enum ClothChange {
    /// Nothing.
    None,
    /// Wrap the document's garment round its body.
    Wrap,
    /// Wrap it again by some pairs of marks.
    Rewrap(Vec<usize>),
    /// Take the cloth off.
    Clear,
    /// The pattern was edited: the dressed cloth follows. The vector tells which drawings on pieces were moved.
    Resew(Vec<Carried>),
    /// Change the pose to that of the document's body; the cloth follows and, with `settle`, settles.
    Repose { settle: bool, draft: bool },
    /// Change the size to that of the document's mannequin.
    Resize,
    /// Change the settings of relaxation.
    SetRelax(RelaxSettings),
    /// Pin the cloth where the document's pins are.
    SetPins,
    /// Begin to drag the cloth.
    Grab { at: ClothPlace, mode: DragMode },
    /// Move the dragged point.
    DragTo(Ray),
    /// End the drag.
    Release,
    /// Pause (false) or go on (true).
    SetRelaxing(bool),
    /// Sew the garment from the placement of its pieces.
    Sew,
    /// Put the garment on by the best start.
    Dress(StartChoice),
    /// Start or stop draping.
    SetDraping(bool),
    /// Drape for this many ticks.
    StepDraping(u32),
    /// Change the fabrics to those of the document.
    SetFabrics,
    /// Change which pieces are frozen or deactivated to what the document has.
    SetActivities,
}

/// Result of a command.
#[derive(Clone, Debug)]
pub struct Edit {
    /// The new document.
    pub document: Document,
    /// Label for menus: "Undo LABEL".
    pub label: Words,
    /// Request to the simulation.
    pub cloth: ClothChange,
    /// What was lost, such as marks that found no place.
    pub problems: Vec<Problem>,
}

impl Edit {
    fn new(label: Words, document: Document) -> Self {
        Self { document, label, cloth: ClothChange::None, problems: Vec::new() }
    }

    fn with(self, cloth: ClothChange) -> Self {
        Self { cloth, ..self }
    }

    /// Whether it is an undo step. Pausing is not; the step of a drag begins with its start.
    pub fn is_step(&self) -> bool {
        let is_none = matches!(
            self.cloth,
            ClothChange::SetRelaxing(_)
                | ClothChange::SetDraping(false)
                | ClothChange::DragTo(_)
                | ClothChange::Release
        );
        !is_none
    }

    /// Kind of its undo step.
    pub fn kind(&self) -> StepKind {
        match self.cloth {
            ClothChange::Wrap | ClothChange::Rewrap(_) | ClothChange::Sew | ClothChange::Dress(_) => {
                StepKind::Wrap
            }
            ClothChange::Repose { .. } | ClothChange::Resize => StepKind::Pose,
            ClothChange::Clear
            | ClothChange::Resew(_)
            | ClothChange::SetPins
            | ClothChange::SetDraping(true)
            | ClothChange::StepDraping(_)
            | ClothChange::SetFabrics
            | ClothChange::SetActivities
            | ClothChange::Grab { .. } => StepKind::Cloth,
            _ => StepKind::Edit,
        }
    }
}

/// Carries out `command` on a copy of `document`. Commands about history belong to the session and are rejected here.
///
/// `bodies` is a cache of bodies. New strokes on the body are tied to it.
pub fn edit(document: &Document, command: &Command, bodies: &mut BodyCache) -> Result<Edit, Rejection> {
    let mut edit = untied(document, command, bodies)?;
    let new = &mut edit.document;
    // Compared by value: in a replay the marks are equal to, but not the same object as, those given in the session.
    if new.marks != document.marks
        && let Ok(body) = bodies.body(&new.body)
    {
        carry::tie(&mut new.marks, &body);
    }
    Ok(edit)
}

fn untied(document: &Document, command: &Command, bodies: &mut BodyCache) -> Result<Edit, Rejection> {
    let new = document.clone();
    match command {
        Command::AddClothMark { piece, side, points } => marks::add_cloth(new, *piece, *side, points),
        Command::AddBodyMark { points } => marks::add_body(new, points),
        Command::DeleteMark { mark } => marks::delete(new, *mark),
        Command::DeletePair { number } => marks::delete_pair(new, *number),
        Command::MoveMark { mark, to } => marks::renumber(new, *mark, *to),
        Command::RenameMark { mark, name } => marks::rename(new, *mark, name),
        Command::ClearMarks => marks::clear(new),
        Command::SetMarks { marks } => marks::set(new, marks),
        Command::ReplacePattern { name, pattern, marks } => pattern::replace_all(new, name, pattern, marks),
        Command::EditPattern { edits, .. } => pattern::edit(new, edits),
        // Older commands, which recordings use from the beginning.
        Command::AddPiece { piece } => edit_by(new, PatternEdit::AddPiece { piece: Arc::clone(piece) }),
        Command::DeletePiece { piece } => edit_by(new, PatternEdit::DeletePieces { pieces: vec![*piece] }),
        Command::RenamePiece { piece, name } => {
            edit_by(new, PatternEdit::Rename { piece: *piece, name: name.clone() })
        }
        Command::SetPiecePose { piece, pose } => {
            edit_by(new, PatternEdit::Place { poses: vec![(*piece, *pose)] })
        }
        Command::SetOutline { piece, outline } => {
            edit_by(new, PatternEdit::SetOutline { piece: *piece, outline: outline.clone() })
        }
        Command::AddSeam { seam } => edit_by(new, PatternEdit::Sew { seam: *seam }),
        Command::DeleteSeam { seam } => edit_by(new, PatternEdit::Unpick { seams: vec![*seam] }),
        Command::ReverseSeam { seam } => edit_by(new, PatternEdit::TurnSeam { seam: *seam }),
        Command::SetBody { body, animations } => body::set(new, body, animations.as_ref(), bodies),
        Command::Repose { body, settle, draft } => body::repose(new, body, [*settle, *draft], bodies),
        Command::ChangeSize { measurements } => body::resize(new, *measurements, bodies),
        Command::AimPose { body } => body::aim(new, body, bodies),
        Command::PoseTowards { share, draft } => body::towards(new, *share, *draft, bodies),
        Command::TakeAnimations { animations } => body::take_animations(new, animations, bodies),
        Command::Animate { at, draft } => body::animate(new, *at, *draft, bodies),
        Command::SetBones { bones } => body::set_bones(new, bones.as_deref()),
        Command::SetSettings { settings } => settings::set(new, settings),
        Command::Wrap => wrap::wrap(new),
        Command::Rewrap { pairs } => wrap::rewrap(new, pairs),
        Command::Unwrap => wrap::unwrap(new),
        Command::AddPin { piece, at } => drag::add_pin(new, *piece, *at),
        Command::DeletePin { pin } => drag::delete_pin(new, *pin),
        Command::ClearPins => drag::clear_pins(new),
        Command::DeletePins { pins } => drag::delete_pins(new, pins),
        Command::MovePin { pin, piece, at } => drag::move_pin(new, *pin, *piece, *at),
        Command::LockPins { pins, locked } => drag::lock_pins(new, pins, *locked),
        Command::Grab { piece, at, mode } => drag::grab(new, *piece, *at, *mode),
        Command::DragTo { ray } => drag::drag_to(new, *ray),
        Command::Release => Ok(Edit::new(words!("let go"), new).with(ClothChange::Release)),
        Command::SetRelaxing { on } => wrap::set_relaxing(new, *on),
        Command::Sew => drape::sew(new),
        Command::Dress { choice } => drape::dress(new, *choice),
        Command::SetDraping { on } => drape::set_draping(new, *on),
        Command::StepDraping { ticks } => drape::step(new, *ticks),
        Command::SetFabric { piece, fabric } => drape::set_fabric(new, *piece, fabric.as_deref()),
        Command::SetDye { piece, dye } => dyes::set_dye(new, *piece, *dye),
        Command::KeepColourway { name } => dyes::keep(new, name),
        Command::WearColourway { name } => dyes::wear(new, name),
        Command::DeleteColourway { name } => dyes::delete(new, name),
        Command::AddImage { file } => artwork::add_image(new, file),
        Command::DeleteImage { image } => artwork::delete_image(new, *image),
        Command::AddGraphic { graphic } => artwork::add_graphic(new, graphic),
        Command::SetGraphic { id, graphic } => artwork::set_graphic(new, *id, graphic),
        Command::DeleteGraphic { id } => artwork::delete_graphic(new, *id),
        Command::CancelWrap
        | Command::Undo
        | Command::Redo
        | Command::CancelGesture
        | Command::ForgetHistory { .. } => Err(Rejection(words!("this command is the session's own"))),
    }
}

fn edit_by(document: Document, edit: PatternEdit) -> Result<Edit, Rejection> {
    pattern::edit(document, &[edit])
}

/// The first thing in `document` that no command would accept; for documents from files.
pub fn document_problem(document: &Document) -> Option<Words> {
    let Document {
        pattern,
        body,
        marks,
        last_mark,
        pins,
        last_pin,
        aim,
        animations,
        moment,
        bones,
        fabrics,
        dyes,
        colourways,
        artwork: _,
        settings,
    } = document;
    if marks.ids().max().is_some_and(|id| id.0 > *last_mark) {
        return Some(words!("the counter of marks is behind their ids"));
    }
    if pins.iter().any(|pin| pin.id.0 > *last_pin) {
        return Some(words!("the counter of pins is behind their ids"));
    }
    pattern_problem(pattern)
        .or_else(|| {
            pins.iter().find_map(|pin| checks::cloth_place(pattern, pin.place).err()).map(|why| why.0)
        })
        .or_else(|| checks::marks(marks, pattern).err().map(|why| why.0))
        .or_else(|| checks::body(body).err().map(|why| why.0))
        .or_else(|| {
            let ends = aim.iter().flat_map(|aim| [&aim.from, &aim.to]);
            ends.into_iter().find_map(|end| checks::body(end).err()).map(|why| why.0)
        })
        .or_else(|| {
            let at = (*moment)?;
            match animations {
                Some(animations) => animations.body(body.name(), Some(at)).err(),
                None => Some(words!("the body is in an animation that is not there")),
            }
        })
        .or_else(|| bones.as_ref().and_then(|bones| checks::bones(bones).err()).map(|why| why.0))
        .or_else(|| drape::unknown_fabric(fabrics).map(|why| why.0))
        .or_else(|| dyes.problem())
        .or_else(|| colourways_problem(colourways))
        .or_else(|| artwork::problem(document))
        .or_else(|| {
            let mut fabrics = colourways.iter().map(|colourway| &colourway.fabrics);
            fabrics.find_map(drape::unknown_fabric).map(|why| why.0)
        })
        .or_else(|| checks::settings(settings).err().map(|why| why.0))
}

/// The first thing in `pattern` that no command would accept; for patterns from files.
fn pattern_problem(pattern: &Pattern) -> Option<Words> {
    checks::pattern(pattern).err().map(|why| why.0)
}

/// Whether `p` is valid as a position of cloth, on a body or beside it.
pub fn is_place(p: DVec3) -> bool {
    checks::point_3d(p / 2.0)
}

/// The first thing in the source of cloth that no command would accept; for cloth from files.
pub fn source_problem(pattern: &Pattern, marks: &Marks, settings: &Settings) -> Option<Words> {
    let checked = checks::pattern(pattern).and_then(|()| checks::marks(marks, pattern));
    checked.and_then(|()| checks::settings(settings)).err().map(|why| why.0)
}
