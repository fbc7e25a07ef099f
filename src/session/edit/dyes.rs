//! Commands for colours, prints and colourways.

use std::sync::Arc;

use crate::geometry::ids::PieceId;
use crate::geometry::words::{Words, within_quotes, words};
use crate::session::command::Rejection;
use crate::session::document::Document;
use crate::session::dyes::{Colourway, Dye, colourways_problem};
use crate::session::edit::{ClothChange, Edit, artwork, checks};

/// Sets colour and print of `piece` (None: of all pieces that have none of their own).
pub fn set_dye(mut document: Document, piece: Option<PieceId>, dye: Dye) -> Result<Edit, Rejection> {
    if let Some(piece) = piece {
        checks::find_piece(&document.pattern, piece)?;
    }
    document.dyes.set(piece, dye);
    match document.dyes.problem().or_else(|| artwork::problem(&document)) {
        None => Ok(Edit::new(words!("change the colour"), document)),
        Some(words) => Err(Rejection(words)),
    }
}

/// Keeps the present fabrics, colours and prints under `name`, in place of a colourway of that name.
pub fn keep(mut document: Document, name: &str) -> Result<Edit, Rejection> {
    let kept =
        Colourway { name: name.to_owned(), fabrics: document.fabrics.clone(), dyes: document.dyes.clone() };
    let colourways = Arc::make_mut(&mut document.colourways);
    match colourways.iter_mut().find(|colourway| colourway.name == name) {
        Some(colourway) => *colourway = kept,
        None => colourways.push(kept),
    }
    match colourways_problem(colourways) {
        None => Ok(Edit::new(words!("keep the colourway"), document)),
        Some(words) => Err(Rejection(words)),
    }
}

/// Takes fabrics, colours and prints from the colourway `name`.
pub fn wear(mut document: Document, name: &str) -> Result<Edit, Rejection> {
    let Colourway { fabrics, dyes, .. } = find(&document, name)?.clone();
    let is_same_cloth = document.fabrics == fabrics;
    (document.fabrics, document.dyes) = (fabrics, dyes);
    let edit = Edit::new(words!("change the colourway"), document);
    Ok(if is_same_cloth { edit } else { edit.with(ClothChange::SetFabrics) })
}

/// Deletes the colourway `name`.
pub fn delete(mut document: Document, name: &str) -> Result<Edit, Rejection> {
    find(&document, name)?;
    Arc::make_mut(&mut document.colourways).retain(|colourway| colourway.name != name);
    Ok(Edit::new(words!("delete the colourway"), document))
}

fn find<'d>(document: &'d Document, name: &str) -> Result<&'d Colourway, Rejection> {
    let found = document.colourways.iter().find(|colourway| colourway.name == name);
    found.ok_or_else(|| {
        let names: Vec<&str> = document.colourways.iter().map(|colourway| &*colourway.name).collect();
        let there_are = match names.is_empty() {
            true => words!("it has none"),
            false => Words::plain(names.join(", ")),
        };
        Rejection(words!(
            "there is no colourway \"{name}\": {there_are}",
            name = within_quotes(name),
            there_are
        ))
    })
}
