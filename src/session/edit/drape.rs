//! Commands for sewing, dressing, draping and fabrics.

use crate::cloth::Fabric;
use crate::geometry::ids::PieceId;
use crate::geometry::words::{within_quotes, words};
use crate::io::words::readable_words;
use crate::session::command::Rejection;
use crate::session::document::Document;
use crate::session::edit::{ClothChange, Edit, checks};
use crate::session::fabrics::Fabrics;
use crate::sim::{Start, StartChoice};

/// Most ticks in one command: ten seconds of draping.
const MOST_TICKS: u32 = 600;

pub fn sew(mut document: Document) -> Result<Edit, Rejection> {
    check_placed(&document)?;
    // Pins held the previous cloth.
    document.drop_pins();
    Ok(Edit::new(words!("sew"), document).with(ClothChange::Sew))
}

pub fn dress(mut document: Document, choice: StartChoice) -> Result<Edit, Rejection> {
    let has_marks = document.marks.pairs().next().is_some() && choice.only != Some(Start::Placement);
    if document.pattern.pieces.is_empty() {
        return Err(Rejection(words!("there is no piece of cloth to put on")));
    }
    if !has_marks {
        check_placed(&document)?;
    }
    // Pins held the previous cloth.
    document.drop_pins();
    Ok(Edit::new(words!("dress"), document).with(ClothChange::Dress(choice)))
}

fn check_placed(document: &Document) -> Result<(), Rejection> {
    let mut pieces = document.pattern.pieces.values();
    let is_placed = pieces.any(|piece| piece.placement.is_some());
    let words = words!(
        "no piece is placed in space: paint marks and wrap, or import a pattern that tells where its pieces go"
    );
    if is_placed { Ok(()) } else { Err(Rejection(words)) }
}

pub fn set_draping(document: Document, on: bool) -> Result<Edit, Rejection> {
    let label = if on { words!("drape") } else { words!("stop draping") };
    Ok(Edit::new(label, document).with(ClothChange::SetDraping(on)))
}

pub fn step(document: Document, ticks: u32) -> Result<Edit, Rejection> {
    if !(1..=MOST_TICKS).contains(&ticks) {
        return Err(Rejection(words!(
            "cloth is draped for 1 to {most} ticks at a time, not {ticks}",
            most = MOST_TICKS,
            ticks
        )));
    }
    Ok(Edit::new(words!("drape a step"), document).with(ClothChange::StepDraping(ticks)))
}

pub fn set_fabric(
    mut document: Document,
    piece: Option<PieceId>,
    fabric: Option<&str>,
) -> Result<Edit, Rejection> {
    if let Some(piece) = piece {
        checks::find_piece(&document.pattern, piece)?;
    }
    known(fabric)?;
    let name = fabric.map(str::to_owned);
    match (piece, name) {
        (None, name) => document.fabrics.all = name,
        (Some(piece), Some(name)) => {
            document.fabrics.pieces.insert(piece, name);
        }
        (Some(piece), None) => {
            document.fabrics.pieces.remove(&piece);
        }
    }
    Ok(Edit::new(words!("change the fabric"), document).with(ClothChange::SetFabrics))
}

fn known(name: Option<&str>) -> Result<(), Rejection> {
    match name.filter(|name| Fabric::preset(name).is_none()) {
        None => Ok(()),
        Some(name) => {
            let names: Vec<&str> = Fabric::presets().iter().map(|f| &*f.name).collect();
            let words = words!(
                "there is no fabric \"{name}\"; there are {names}",
                name = within_quotes(name),
                names = names.join(", ")
            );
            Err(Rejection(readable_words(words)))
        }
    }
}

/// The first fabric in `fabrics` that does not exist; for documents from files.
pub fn unknown_fabric(fabrics: &Fabrics) -> Option<Rejection> {
    let Fabrics { all, pieces } = fabrics;
    all.iter().chain(pieces.values()).find_map(|name| known(Some(name)).err())
}
