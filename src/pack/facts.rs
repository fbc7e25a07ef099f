//! The contents of a tech pack, measured on pattern and dressed garment.

use std::sync::Arc;

use serde::Serialize;

use crate::fit::{self, BodyIndex, Opening};
use crate::geometry::words::{Words, words};
use crate::marker::{MarkerError, WIDEST};
use crate::pack::alike::{Cut, Likeness};
use crate::pack::cloths::{Cloth, Colourway, Taken, Wish, area, cloths, colourways};
use crate::pack::seams::SeamRow;
use crate::pack::shape::{Front, size_of};
use crate::pack::sizes::SizeRow;
use crate::pack::trims::{Supply, TrimRow, supplies, trims};
use crate::pack::words;
use crate::pattern::{Pattern, Piece};
use crate::session::size_fit::Ease;
use crate::session::{Document, Outfit};

/// What a tech pack is made of.
#[derive(Clone, Copy, Debug)]
pub struct Source<'a> {
    /// Name of the garment.
    pub name: &'a str,
    pub document: &'a Document,
    /// The dressed garment, if there is one.
    pub outfit: Option<&'a Outfit>,
}

/// A piece, or several that are cut alike or as mirror images.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PieceRow {
    /// Numbers of the pieces.
    pub pieces: Vec<u32>,
    /// Their names.
    pub names: Vec<String>,
    /// How many are cut for a garment.
    pub cut: usize,
    /// How many of these are mirror images of the first.
    pub mirrored: usize,
    /// Number of its cloth in [`Pack::cloths`], from 0.
    pub cloth: usize,
    /// Angle of the grain from upright in the drawing, counter-clockwise, degrees, above -90 and at most 90.
    pub grain_degrees: f64,
    /// Whether a grainline is drawn on it.
    pub has_grainline: bool,
    /// Width and height as it is drawn, without allowance, metres.
    pub size: [f64; 2],
    /// Area of one within its cutting line, square metres.
    pub area: f64,
    /// Seam allowance, metres; None where it has a cutting line of its own.
    pub allowance: Option<f64>,
    /// Number of notches on one.
    pub notches: usize,
}

/// The contents of a tech pack, for people and programs: its texts are English, and translated where they are written.
#[derive(Clone, Debug, Serialize)]
pub struct Pack {
    pub version: &'static str,
    pub name: String,
    /// Name of the body that the garment is dressed on; None where it is not.
    pub body: Option<String>,
    /// Names of the sizes, from small to large; none where the pattern is not graded.
    pub sizes: Vec<String>,
    /// Name of the size that is drawn.
    pub base_size: String,
    /// Width of cloth that the layouts are on, metres.
    pub width: f64,
    pub nap: bool,
    pub pieces: Vec<PieceRow>,
    pub cloths: Vec<Cloth>,
    pub colourways: Vec<Colourway>,
    pub trims: Vec<TrimRow>,
    pub supplies: Vec<Supply>,
    pub seams: Vec<SeamRow>,
    pub measures: Vec<SizeRow>,
    /// Girths of body and pattern, where the cloth goes round the body.
    pub ease: Vec<Ease>,
    /// Hems, neck and cuffs as worn, longest first.
    pub openings: Vec<Opening>,
    /// What a maker must know beside, in sentences.
    pub notes: Vec<Words>,
}

impl Pack {
    /// The contents for `source`.
    ///
    /// # Errors
    /// There are no pieces, or a number of `wish` that no cloth has.
    pub fn of(source: Source<'_>, wish: &Wish) -> Result<Self, MarkerError> {
        let Source { name, document, outfit } = source;
        let pattern = &document.pattern;
        if pattern.pieces.is_empty() {
            return Err(MarkerError::Empty);
        }
        if !(wish.width > 0.0 && wish.width <= WIDEST) {
            let words = words!(
                "cloth {width} m wide: it must be more than 0 and at most {most}",
                width = wish.width,
                most = WIDEST
            );
            return Err(MarkerError::Number(words));
        }
        let seconds = wish.effort.seconds;
        if !(seconds >= 0.0 && seconds.is_finite()) {
            return Err(MarkerError::Number(words!("{seconds} seconds: it must be 0 or more", seconds)));
        }
        let cloths = cloths(document, wish)?;
        let trims = trims(pattern, &document.artwork);
        let measures = SizeRow::all(pattern);
        Ok(Self {
            version: env!("CARGO_PKG_VERSION"),
            name: name.to_owned(),
            body: outfit.map(|_| document.body.name().to_owned()),
            sizes: pattern.sizes.names.clone(),
            base_size: pattern.sizes.base_name().to_owned(),
            width: wish.width,
            nap: wish.nap,
            pieces: piece_rows(pattern, &cloths),
            colourways: colourways(document),
            supplies: supplies(pattern, &trims),
            seams: SeamRow::all(pattern),
            ease: outfit.map(|outfit| Ease::of(&document.body, outfit)).unwrap_or_default(),
            openings: outfit.map(openings).unwrap_or_default(),
            notes: notes(pattern, outfit, &measures),
            cloths,
            trims,
            measures,
        })
    }

    /// The cloth that is needed, in a few lines, for people.
    pub fn words(&self) -> Vec<String> {
        let line = |i: usize, cloth: &Cloth, taken: &Taken| {
            let size = if taken.size.is_empty() {
                String::new()
            } else {
                format!(", size {}", words::name(&taken.size))
            };
            let needed = match (taken.length, taken.yield_percent, &taken.why) {
                (Some(length), Some(percent), _) => {
                    format!("{length:.3} m of cloth {:.3} m wide; {percent:.1} % of it in pieces", self.width)
                }
                (_, _, why) => why.as_ref().map_or_else(String::new, Words::to_string),
            };
            format!("cloth {} ({}){size}: {needed}", self.cloth_name(i), cloth.fabric)
        };
        let all = self.cloths.iter().enumerate();
        all.flat_map(|(i, cloth)| cloth.taken.iter().map(move |taken| line(i, cloth, taken))).collect()
    }

    /// Name of the cloth with this number, for people.
    pub fn cloth_name(&self, cloth: usize) -> String {
        let letter = char::from_u32('A' as u32 + cloth as u32).filter(char::is_ascii_uppercase);
        letter.map_or_else(|| (cloth + 1).to_string(), |letter| letter.to_string())
    }
}

fn openings(outfit: &Outfit) -> Vec<Opening> {
    let Outfit { source, garment, state, body, .. } = outfit;
    fit::measure(&source.pattern, garment, state, &BodyIndex::new(body)).openings
}

fn piece_rows(pattern: &Pattern, cloths: &[Cloth]) -> Vec<PieceRow> {
    let cloth = |id: u32| cloths.iter().position(|cloth| cloth.pieces.contains(&id)).unwrap_or(0);
    let mut rows: Vec<(PieceRow, Cut)> = Vec::new();
    for (&id, piece) in &pattern.pieces {
        let (own, cloth) = (Cut::of(piece), cloth(id.0));
        let likeness = |(row, cut): &(PieceRow, Cut)| {
            let is_twin = piece.twin.is_some_and(|twin| row.pieces.first() == Some(&twin.0));
            let alike = if is_twin { Some(Likeness::Mirrored) } else { cut.likeness(&own) };
            alike.filter(|_| row.cloth == cloth)
        };
        let found = rows.iter().enumerate().find_map(|(k, row)| Some((k, likeness(row)?)));
        let Some((k, likeness)) = found else {
            rows.push((piece_row(id.0, piece, cloth), own));
            continue;
        };
        let row = &mut rows[k].0;
        row.pieces.push(id.0);
        row.names.push(piece.name.clone());
        row.cut += 1;
        row.mirrored += usize::from(likeness == Likeness::Mirrored);
    }
    rows.into_iter().map(|(row, _)| row).collect()
}

fn piece_row(id: u32, piece: &Piece, cloth: usize) -> PieceRow {
    let grain = Front::of(piece).grain(piece);
    let degrees = (-grain.x).atan2(grain.y).to_degrees();
    // An arrow has no head on a grain without a nap: what points down is upright, too.
    let upright = if degrees > 90.0 + 1e-9 {
        degrees - 180.0
    } else if degrees <= -90.0 + 1e-9 {
        degrees + 180.0
    } else {
        degrees
    };
    PieceRow {
        pieces: vec![id],
        names: vec![piece.name.clone()],
        cut: 1,
        mirrored: 0,
        cloth,
        grain_degrees: upright,
        has_grainline: piece.grainline.is_some(),
        size: size_of(piece).to_array(),
        area: area(piece),
        allowance: piece.cut_line.is_empty().then_some(piece.allowance),
        notches: piece.notches.len(),
    }
}

fn notes(pattern: &Pattern, outfit: Option<&Outfit>, measures: &[SizeRow]) -> Vec<Words> {
    let mut notes = Vec::new();
    let pieces = || pattern.pieces.values();
    let bare = pieces().filter(|piece| piece.allowance == 0.0 && piece.cut_line.is_empty()).count();
    if bare == pattern.pieces.len() {
        notes.push(
            words!("No piece has a seam allowance: the cutting lines are the seam lines. Add it before cutting; the cloth needed grows by it."),
        );
    } else if bare > 0 {
        let (n, count) = (bare, pattern.pieces.len());
        notes.push(words!("{n} of {count} pieces have no seam allowance.", n, count));
    }
    if pieces().any(|piece| piece.outline.iter().any(|edge| edge.trims.hem.is_some())) {
        notes.push(words!("Hems are turned in: their width is cloth beyond the edge."));
    }
    let (n, count) = (pieces().filter(|piece| piece.grainline.is_none()).count(), pattern.pieces.len());
    if n > 0 {
        notes.push(words!(
            "No grainline is drawn on {n} of {count} pieces: their own upright is taken for it.",
            n,
            count
        ));
    }
    if outfit.is_some_and(|outfit| is_changed(&outfit.source.pattern, pattern)) {
        notes.push(
            words!("The pattern has changed since it was dressed: pictures, girths and openings are of its earlier state."),
        );
    }
    for size in measures {
        notes.extend(size.problems.iter().cloned());
    }
    notes
}

/// Whether pieces were cut anew or sewn otherwise between two states of a pattern.
fn is_changed(one: &Pattern, other: &Pattern) -> bool {
    let alike = |a: &Arc<Piece>, b: &Arc<Piece>| {
        Arc::ptr_eq(a, b) || (a.outline == b.outline && a.holes == b.holes && a.lines == b.lines)
    };
    one.seams != other.seams
        || !one.pieces.keys().eq(other.pieces.keys())
        || !one.pieces.values().zip(other.pieces.values()).all(|(a, b)| alike(a, b))
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::marker::nest::Effort;

    fn of(pattern: Pattern) -> Result<Pack, MarkerError> {
        let document = Document { pattern: Arc::new(pattern), ..Document::default() };
        let wish = Wish { effort: Effort { seconds: 0.0, seed: 1 }, ..Wish::default() };
        Pack::of(Source { name: "a", document: &document, outfit: None }, &wish)
    }

    fn square(name: &str) -> Piece {
        Piece::polygon(name, &[DVec2::ZERO, DVec2::X * 0.3, DVec2::splat(0.3), DVec2::Y * 0.3])
    }

    #[test]
    fn twins_and_copies_are_one_row() {
        let mut pattern = Pattern::default();
        let front = pattern.add_piece(Piece { allowance: 0.01, ..square("front") });
        let mut sleeve = square("left");
        sleeve.outline[1].start.x += 0.1;
        let left = pattern.add_piece(sleeve.clone());
        let right = pattern.add_piece(Piece { twin: Some(left), name: "right".to_owned(), ..sleeve });
        Arc::make_mut(pattern.pieces.get_mut(&left).expect("a piece")).twin = Some(right);
        pattern.add_piece(Piece { allowance: 0.01, ..square("back") });
        let pack = of(pattern).expect("contents");
        let rows: Vec<_> =
            pack.pieces.iter().map(|row| (row.names.join(" "), row.cut, row.mirrored)).collect();
        assert_eq!(rows, [("front back".to_owned(), 2, 0), ("left right".to_owned(), 2, 1)]);
        assert_eq!(pack.pieces[0].pieces[0], front.0);
        assert!(pack.notes[0].starts_with("2 of 4 pieces have no seam allowance"), "{:?}", pack.notes);
        assert_eq!(of(Pattern::default()).expect_err("none"), MarkerError::Empty);
    }

    #[test]
    fn the_grain_is_an_angle_from_upright() {
        let degrees = |head: DVec2| {
            let piece = Piece { grainline: Some([DVec2::ZERO, head]), ..square("a") };
            piece_row(0, &piece, 0).grain_degrees.round()
        };
        let ways =
            [DVec2::Y, DVec2::NEG_Y, DVec2::NEG_X, DVec2::X, DVec2::new(1.0, 1.0), DVec2::new(-1.0, -1.0)];
        assert_eq!(ways.map(degrees), [0.0, 0.0, 90.0, 90.0, -45.0, -45.0]);
    }
}
