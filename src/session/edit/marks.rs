//! Commands for strokes.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::geometry::ids::{MarkId, PieceId};
use crate::geometry::words::words;
use crate::session::command::Rejection;
use crate::session::document::Document;
use crate::session::edit::{Edit, checks};
use crate::wrap::{BodyMark, ClothMark, ClothSide, MarkPlace, Marks};

pub fn add_cloth(
    mut document: Document,
    piece: PieceId,
    side: ClothSide,
    points: &[DVec2],
) -> Result<Edit, Rejection> {
    checks::stroke_2d(points)?;
    checks::find_piece(&document.pattern, piece)?;
    let id = document.fresh_mark();
    let marks = Arc::make_mut(&mut document.marks);
    marks.cloth.push(ClothMark { id, piece, side, points: points.to_vec() });
    let label = words!("mark {n} on the cloth", n = marks.cloth.len());
    Ok(Edit::new(label, document))
}

pub fn add_body(mut document: Document, points: &[DVec3]) -> Result<Edit, Rejection> {
    checks::stroke_3d(points)?;
    let id = document.fresh_mark();
    let marks = Arc::make_mut(&mut document.marks);
    marks.body.push(BodyMark { id, points: points.to_vec() });
    let label = words!("mark {n} on the body", n = marks.body.len());
    Ok(Edit::new(label, document))
}

pub fn delete(mut document: Document, mark: MarkId) -> Result<Edit, Rejection> {
    let marks = Arc::make_mut(&mut document.marks);
    let MarkPlace { on_cloth, number: n, .. } = marks.place(mark).ok_or_else(|| no_mark(mark))?;
    marks.cloth.retain(|m| m.id != mark);
    marks.body.retain(|m| m.id != mark);
    marks.prune();
    let label = match on_cloth {
        true => words!("delete mark {n} on the cloth", n),
        false => words!("delete mark {n} on the body", n),
    };
    Ok(Edit::new(label, document))
}

pub fn delete_pair(mut document: Document, number: usize) -> Result<Edit, Rejection> {
    let marks = Arc::make_mut(&mut document.marks);
    if number == 0 || number > marks.cloth.len().max(marks.body.len()) {
        return Err(Rejection(words!("no mark has the number {number}", number)));
    }
    remove_number(marks, number);
    Ok(Edit::new(words!("delete marks {n}", n = number), document))
}

/// Removes the strokes numbered `number` (from 1) on both sides.
pub fn remove_number(marks: &mut Marks, number: usize) {
    if number <= marks.cloth.len() {
        marks.cloth.remove(number - 1);
    }
    if number <= marks.body.len() {
        marks.body.remove(number - 1);
    }
    marks.prune();
}

pub fn renumber(mut document: Document, mark: MarkId, to: usize) -> Result<Edit, Rejection> {
    let marks = Arc::make_mut(&mut document.marks);
    if let Some(i) = marks.cloth.iter().position(|m| m.id == mark) {
        move_to(&mut marks.cloth, i, to)?;
    } else if let Some(i) = marks.body.iter().position(|m| m.id == mark) {
        move_to(&mut marks.body, i, to)?;
    } else {
        return Err(no_mark(mark));
    }
    Ok(Edit::new(words!("renumber a mark to {n}", n = to), document))
}

fn move_to<T>(marks: &mut Vec<T>, from: usize, to: usize) -> Result<(), Rejection> {
    if to == 0 || to > marks.len() {
        return Err(Rejection(words!("numbers here go from 1 to {most}", most = marks.len())));
    }
    let mark = marks.remove(from);
    marks.insert(to - 1, mark);
    Ok(())
}

pub fn rename(mut document: Document, mark: MarkId, name: &str) -> Result<Edit, Rejection> {
    checks::name_or_none(name)?;
    let marks = Arc::make_mut(&mut document.marks);
    let MarkPlace { on_cloth, number: n, .. } = marks.place(mark).ok_or_else(|| no_mark(mark))?;
    let label = if name.trim().is_empty() {
        marks.names.remove(&mark);
        match on_cloth {
            true => words!("take the name of mark {n} on the cloth away", n),
            false => words!("take the name of mark {n} on the body away", n),
        }
    } else {
        marks.names.insert(mark, name.to_owned());
        match on_cloth {
            true => words!("name mark {n} on the cloth {name}", n, name),
            false => words!("name mark {n} on the body {name}", n, name),
        }
    };
    Ok(Edit::new(label, document))
}

pub fn clear(mut document: Document) -> Result<Edit, Rejection> {
    if document.marks.cloth.is_empty() && document.marks.body.is_empty() {
        return Err(Rejection(words!("there are no marks")));
    }
    document.marks = Arc::default();
    Ok(Edit::new(words!("clear all marks"), document))
}

pub fn set(mut document: Document, marks: &Arc<Marks>) -> Result<Edit, Rejection> {
    checks::marks(marks, &document.pattern)?;
    document.take_marks(Arc::clone(marks));
    Ok(Edit::new(words!("replace all marks"), document))
}

fn no_mark(mark: MarkId) -> Rejection {
    Rejection(words!("there is no {what}", what = mark))
}
