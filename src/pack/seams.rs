//! Which edges are sewn to which, their lengths and ease.

use serde::Serialize;

use crate::geometry::ids::SeamId;
use crate::geometry::words::{Words, decimal, words};
use crate::language::{number, say, tr};
use crate::pack::words;
use crate::pattern::{Pattern, Piece, Seam, Stretch};

/// Difference of the sides of a seam up to which they are equal, metres.
const ALIKE: f64 = 5e-4;
/// Ratio of the sides of a seam from which the longer is gathered, not eased in.
const GATHERED: f64 = 1.1;

/// One side of a seam.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SideRow {
    /// Name of its piece.
    pub piece: String,
    /// The edge, or the stretch of edges, in words.
    pub edge: Words,
    /// Length, metres; None where there is no such stretch.
    pub length: Option<f64>,
}

/// A seam.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SeamRow {
    /// Number of the seam.
    pub seam: u32,
    pub sides: [SideRow; 2],
    /// How much longer the first side is than the second, metres.
    pub ease: Option<f64>,
    /// Whether there is a zip in it.
    pub zip: bool,
}

impl SeamRow {
    /// All seams of `pattern`, in the order of their numbers.
    pub fn all(pattern: &Pattern) -> Vec<Self> {
        pattern.seams.iter().map(|(&id, seam)| Self::new(pattern, id, seam)).collect()
    }

    fn new(pattern: &Pattern, id: SeamId, seam: &Seam) -> Self {
        let sides = seam.sides.map(|side| side_row(pattern, &side));
        let ease = sides[0].length.zip(sides[1].length).map(|(one, other)| one - other);
        Self { seam: id.0, sides, ease, zip: seam.zip.is_some() }
    }

    /// What is to be done with the excess of a side, in the language that is shown.
    pub fn ease_words(&self) -> String {
        let (Some(ease), [Some(one), Some(other)]) = (self.ease, self.lengths()) else {
            return tr("one side is not there").to_owned();
        };
        if ease.abs() <= ALIKE {
            return tr("even").to_owned();
        }
        let (longer, shorter) = (one.max(other), one.min(other));
        let (is_first, cm) = (ease > 0.0, words::cm(longer - shorter));
        let ratio = number(longer / shorter, 2);
        match (is_first, shorter > 0.0 && longer / shorter >= GATHERED) {
            (true, true) => say!("gather the first, {ratio} to 1", ratio),
            (false, true) => say!("gather the second, {ratio} to 1", ratio),
            (true, false) => say!("ease the first in, {cm} cm", cm),
            (false, false) => say!("ease the second in, {cm} cm", cm),
        }
    }

    /// The lengths of both sides, metres.
    pub fn lengths(&self) -> [Option<f64>; 2] {
        [self.sides[0].length, self.sides[1].length]
    }
}

fn side_row(pattern: &Pattern, side: &Stretch) -> SideRow {
    let piece = pattern.pieces.get(&side.piece);
    SideRow {
        piece: piece.map_or_else(|| side.piece.to_string(), |piece| piece.name.clone()),
        edge: piece.map_or_else(Words::default, |piece| edge_words(piece, side)),
        length: piece.and_then(|piece| side.length(piece)),
    }
}

/// The stretch in words: "edge 3", "edges 3 to 5", "edge 3 from 20 to 80 %"; with the name of the edge, if it has one.
fn edge_words(piece: &Piece, side: &Stretch) -> Words {
    let Some(parts) = side.parts(piece) else { return words!("an edge that is not there") };
    let (Some(&(first, from, _)), Some(&(last, _, to))) = (parts.first(), parts.last()) else {
        return Words::default();
    };
    let percent = |share: f64| decimal(share * 100.0, 0);
    if first == last && parts.len() == 1 {
        let label = piece.edge(first).label.as_deref().filter(|label| !label.trim().is_empty());
        let edge =
            label.map_or_else(|| words!("edge {n}", n = first), |label| Words::plain(words::name(label)));
        return match (from > 0.0, to < 1.0) {
            (false, false) => edge,
            _ => words!("{edge} from {from} to {to} %", edge, from = percent(from), to = percent(to)),
        };
    }
    let end = |edge: usize, share: f64, is_whole: bool| match is_whole {
        true => Words::plain(edge.to_string()),
        false => words!("{n} at {percent} %", n = edge, percent = percent(share)),
    };
    words!("edges {from} to {to}", from = end(first, from, from <= 0.0), to = end(last, to, to >= 1.0))
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::geometry::ids::PieceId;
    use crate::pattern::EdgeRef;

    /// A strip 1 m wide sewn to a strip `width` wide along their lower edges.
    fn sewn(width: f64) -> SeamRow {
        let mut pattern = Pattern::default();
        let strip = |name: &str, w: f64| {
            Piece::polygon(name, &[DVec2::ZERO, DVec2::X * w, DVec2::new(w, 0.2), DVec2::new(0.0, 0.2)])
        };
        let pieces = [pattern.add_piece(strip("skirt", 1.0)), pattern.add_piece(strip("band", width))];
        pattern.add_seam(Seam::of_edges(pieces.map(|piece| EdgeRef { piece, edge: 0 }), false));
        SeamRow::all(&pattern).remove(0)
    }

    #[test]
    fn the_excess_of_a_side_is_told() {
        let words = |width: f64| sewn(width).ease_words();
        assert_eq!(words(1.0), "even");
        assert_eq!(words(0.97), "ease the first in, 3.0 cm");
        assert_eq!(words(2.0), "gather the second, 2.00 to 1");
        let seam = sewn(0.97);
        assert_eq!((seam.sides[0].piece.as_str(), seam.sides[0].edge.as_str()), ("skirt", "edge 0"));
        assert!((seam.ease.expect("both sides") - 0.03).abs() < 1e-12);
    }

    #[test]
    fn stretches_are_told_in_words() {
        let piece = Piece::polygon("a", &[DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y]);
        let stretch = |edge, from, further, to| Stretch { edge, from, further, to, piece: PieceId(0) };
        assert_eq!(edge_words(&piece, &stretch(1, 0.2, 0, 0.8)), "edge 1 from 20 to 80 %");
        assert_eq!(edge_words(&piece, &stretch(0, 0.0, 2, 1.0)), "edges 0 to 2");
        assert_eq!(edge_words(&piece, &stretch(0, 0.5, 1, 0.25)), "edges 0 at 50 % to 1 at 25 %");
        assert_eq!(edge_words(&piece, &stretch(9, 0.0, 0, 1.0)), "an edge that is not there");
    }
}
