//! Actions that put cloth on the body and move it.

use egui::{Key, KeyboardShortcut, Modifiers};

use crate::drag::DragMode;
use crate::ui::actions::row::{Need, Row, ctrl, key, row, shift};
use crate::ui::actions::{Action, Tool};

/// The rows in the order of the menus.
pub const ROWS: &[Row] = &[
    row(
        "Garment",
        Action::Dress,
        "Dress",
        "Put the garment on by the best start: marks, its own or suggested ones, or sewn \
         from placement",
    )
    .keys(&[ctrl(Key::Enter)])
    .needs(&[Need::Pieces, Need::Body, Need::NotGrowing, Need::PlacedOrPairs]),
    row(
        "Garment",
        Action::DressAllSizes,
        "Dress all sizes…",
        "Dress the pattern in each of its sizes on this body, and show how they fit side by side",
    )
    .needs(&[Need::Sizes, Need::Pieces, Need::Body, Need::PlacedOrPairs]),
    row("Garment", Action::Wrap, "Wrap", "Grow the cloth round the body so that the marks meet")
        .keys(&[key(Key::Enter)])
        .needs(&[Need::Pieces, Need::Body, Need::NotGrowing, Need::Pairs]),
    row(
        "Garment",
        Action::Rewrap,
        "Rewrap",
        "Wrap the dressed cloth again by its new marks; pins keep what lies beyond them",
    )
    .keys(&[KeyboardShortcut::new(Modifiers::SHIFT, Key::Enter)])
    .needs(&[Need::Dressed, Need::NotGrowing, Need::NewPairs]),
    row(
        "Garment",
        Action::Cancel,
        "Cancel",
        "Stop: what was on the body before comes back, or the pose before; draping is paused",
    )
    .keys(&[key(Key::Escape)])
    .needs(&[Need::Work]),
    row("Garment", Action::Unwrap, "Undress", "Take the cloth off the body; the marks stay")
        .needs(&[Need::Dressed]),
    row("Garment", Action::ToggleRelaxing, "Relax", "Let the cloth even itself out, or hold it still")
        .keys(&[KeyboardShortcut::new(Modifiers::SHIFT, Key::Space)])
        .needs(&[Need::NotTrying, Need::Dressed]),
    row(
        "Garment",
        Action::Choose(Tool::Place),
        "Place pieces",
        "Stand pieces round the body before they are sewn: select one, then click a dot; \
         drag it, an arrow or a ring",
    )
    .keys(&[shift(Key::B)])
    .needs(&[Need::Pieces, Need::Body]),
    row(
        "Garment",
        Action::BringPieces,
        "Arrange pieces on the body",
        "Move the pieces as a whole to where they belong on this body, and sleeves on to \
         its arms",
    )
    .needs(&[Need::Body, Need::Placed]),
    row(
        "Garment",
        Action::ToggleRolled,
        "Roll",
        "Roll the pieces that stand round a limb into tubes, or make them flat",
    )
    .needs(&[Need::Standing]),
    row(
        "Garment",
        Action::Unplace,
        "Remove placement",
        "The selected pieces no longer stand round the body and are not sewn from \
         placement; they stay on the table",
    )
    .needs(&[Need::Standing]),
    row(
        "Garment",
        Action::Sew,
        "Sew from placement",
        "Draw the seams shut from where the pieces stand round the body, and drape",
    )
    .needs(&[Need::NotGrowing, Need::Body, Need::PlacedFirst]),
    row(
        "Garment",
        Action::ToggleDrape,
        "Drape",
        "Let weight and fabric move the dressed cloth until it rests, or pause",
    )
    .keys(&[key(Key::Space)])
    .needs(&[Need::NotTrying, Need::Dressed]),
    row("Garment", Action::StepDrape, "Drape one step", "Drape for a sixtieth of a second").needs(&[
        Need::NotTrying,
        Need::NotDraping,
        Need::Dressed,
    ]),
    row(
        "Garment",
        Action::Choose(Tool::Drag(DragMode::Surface)),
        "Drag",
        "Drag the cloth along the skin; pins hold it back",
    )
    .keys(&[key(Key::D)])
    .needs(&[Need::Dressed]),
    row(
        "Garment",
        Action::Choose(Tool::Drag(DragMode::Vertex)),
        "Drag a point",
        "Drag one point of the cloth; the rest follows as it relaxes",
    )
    .needs(&[Need::Dressed]),
    row(
        "Garment",
        Action::Choose(Tool::Drag(DragMode::Rigid)),
        "Drag rigidly",
        "Move the whole cloth through space",
    )
    .needs(&[Need::Dressed]),
    row(
        "Garment",
        Action::Choose(Tool::Pin),
        "Pin",
        "Click to pin the cloth where it is, drag for a row of pins, click a pin to pull \
         it out",
    )
    .keys(&[key(Key::P)])
    .needs(&[Need::Dressed]),
    row(
        "Garment",
        Action::Choose(Tool::ClothLine),
        "Line on the cloth",
        "Click points on the dressed cloth to draw a line inside a piece, for folds, \
         stitches or wrinkles; Enter ends it",
    )
    .keys(&[shift(Key::I)])
    .needs(&[Need::Dressed]),
    row(
        "Garment › Bones",
        Action::Choose(Tool::Bone),
        "Draw bones",
        "Drag through the body to draw a bone, which cloth cannot be pulled across; \
         Ctrl+click takes one away",
    )
    .needs(&[Need::Body]),
    row(
        "Garment › Bones",
        Action::OwnBones,
        "The body's own bones",
        "Use the bones the body came with, or those found in it, and drop drawn ones",
    )
    .needs(&[Need::Body]),
    row(
        "Garment › Bones",
        Action::NoBones,
        "No bones",
        "Use no bones: cloth can be pulled across arms and neck",
    )
    .needs(&[Need::Body]),
    row("Garment", Action::ClearPins, "Remove all pins", "Pull out every pin in the cloth")
        .needs(&[Need::Pins]),
];
