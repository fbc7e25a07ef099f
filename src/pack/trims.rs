//! What is worked on the pieces (folds, elastic, stitches, hems, buttons, zips, graphics), and what is bought for it.

use serde::Serialize;

use crate::geometry::ids::PieceId;
use crate::pack::words;
use crate::pattern::{Pattern, Piece, Trims};
use crate::session::Artwork;

/// Something worked on a piece, alike in one or several places.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TrimRow {
    /// Number and name of the piece.
    pub piece: u32,
    pub piece_name: String,
    /// What it is: "elastic", "button".
    pub what: &'static str,
    /// Where, in words.
    pub places: Vec<String>,
    /// Length of all places together, metres; None for what is at a point.
    pub length: Option<f64>,
    /// Its measures, in words.
    pub measures: String,
    /// Its colour, sRGB.
    pub colour: Option<[u8; 3]>,
}

/// Something to be bought for a garment.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Supply {
    /// What it is, with its measures.
    pub what: String,
    /// How many; None for what is bought by length.
    pub count: Option<usize>,
    /// Its length, metres: of one where several are counted alike, else of all.
    pub length: Option<f64>,
    pub colour: Option<[u8; 3]>,
}

/// All that is worked on the pieces of `pattern`, piece by piece.
pub fn trims(pattern: &Pattern, artwork: &Artwork) -> Vec<TrimRow> {
    let mut rows = Vec::new();
    for (&id, piece) in &pattern.pieces {
        let mut own = Rows { id, piece, rows: Vec::new() };
        for edge in 0..piece.edge_count() {
            let label = piece.edge(edge).label.as_deref().map(str::trim).filter(|label| !label.is_empty());
            let place = label.map_or_else(|| format!("edge {edge}"), words::name);
            own.along(piece.edge(edge).trims, place, || piece.edge_length(edge));
        }
        for (k, line) in piece.lines.iter().enumerate() {
            for (i, edge) in line.edges.iter().enumerate() {
                let place = match line.name.trim() {
                    "" => format!("line {k}"),
                    name => words::name(name),
                };
                own.along(edge.trims, place, || line_length(line, i));
            }
        }
        own.fastenings(pattern);
        own.graphics(artwork);
        rows.append(&mut own.rows);
    }
    rows
}

/// The rows of one piece.
struct Rows<'a> {
    id: PieceId,
    piece: &'a Piece,
    rows: Vec<TrimRow>,
}

impl Rows<'_> {
    fn add(
        &mut self,
        what: &'static str,
        place: String,
        length: Option<f64>,
        measures: String,
        colour: Option<[u8; 3]>,
    ) {
        let alike = |row: &&mut TrimRow| (row.what, &row.measures, row.colour) == (what, &measures, colour);
        if let Some(row) = self.rows.iter_mut().find(alike) {
            if row.places.last() != Some(&place) {
                row.places.push(place);
            }
            row.length = row.length.zip(length).map(|(one, other)| one + other);
            return;
        }
        self.rows.push(TrimRow {
            piece: self.id.0,
            piece_name: self.piece.name.clone(),
            what,
            places: vec![place],
            length,
            measures,
            colour,
        });
    }

    /// What is worked along one edge, of which `length` gives the length in metres.
    fn along(&mut self, trims: Trims, place: String, length: impl Fn() -> f64) {
        if trims.is_none() {
            return;
        }
        let Trims { fold, elastic, topstitch, hem } = trims;
        let length = Some(length());
        if let Some(fold) = fold {
            let way = if fold.angle >= 0.0 { "outwards" } else { "inwards" };
            let measures = format!("{:.0}° {way}", fold.angle.to_degrees().abs());
            self.add("fold", place.clone(), length, measures, None);
        }
        if let Some(elastic) = elastic {
            let measures = format!("cut to {:.0} % of the cloth", elastic.ratio * 100.0);
            self.add("elastic", place.clone(), length, measures, None);
        }
        if let Some(stitch) = topstitch {
            let mut measures = format!(
                "{} at {:.1} mm, stitches of {:.1} mm",
                words::count(usize::from(stitch.rows), "row"),
                stitch.distance * 1e3,
                stitch.length * 1e3
            );
            if stitch.rows > 1 {
                measures += &format!(", rows {:.1} mm apart", stitch.spacing * 1e3);
            }
            self.add("topstitching", place.clone(), length, measures, Some(stitch.colour));
        }
        if let Some(hem) = hem {
            let measures = format!("{:.1} cm turned in", hem.width * 100.0);
            self.add("hem", place, length, measures, hem.colour);
        }
    }

    fn fastenings(&mut self, pattern: &Pattern) {
        for (id, button) in &pattern.buttons {
            let measures = format!("{:.1} mm", button.diameter * 1e3);
            if button.button.piece == self.id {
                self.add("button", id.to_string(), None, measures.clone(), Some(button.colour));
            }
            if button.hole.piece == self.id {
                self.add("buttonhole", id.to_string(), None, format!("for {measures}"), None);
            }
        }
        for (id, seam) in &pattern.seams {
            let Some(zip) = seam.zip else { continue };
            if let Some(side) = seam.sides.iter().find(|side| side.piece == self.id) {
                self.add("zip", id.to_string(), side.length(self.piece), String::new(), Some(zip.colour));
            }
        }
    }

    fn graphics(&mut self, artwork: &Artwork) {
        let own = self.id;
        for (id, graphic) in artwork.graphics.iter().filter(|(_, graphic)| graphic.piece == own) {
            let image = artwork.images.get(&graphic.image);
            let name = image.map_or_else(|| "an image".to_owned(), |image| words::name(&image.name));
            let measures = format!("{name}, {:.1} cm wide", graphic.width_m * 100.0);
            self.add("graphic", id.to_string(), None, measures, None);
        }
    }
}

/// Length of edge `i` of an internal line, metres.
fn line_length(line: &crate::pattern::InternalLine, i: usize) -> f64 {
    let end = line.edges.get(i + 1).map_or(line.end, |next| next.start);
    crate::pattern::curve::exact_length(line.edges[i].start, line.edges[i].shape, end)
}

/// What is bought for one garment: buttons, zips, elastic and thread that is seen.
pub fn supplies(pattern: &Pattern, trims: &[TrimRow]) -> Vec<Supply> {
    let mut supplies: Vec<Supply> = Vec::new();
    for button in pattern.buttons.values() {
        let what = format!("button of {:.1} mm", button.diameter * 1e3);
        add(&mut supplies, Supply { what, count: Some(1), length: None, colour: Some(button.colour) });
    }
    for (id, seam) in &pattern.seams {
        let Some(zip) = seam.zip else { continue };
        let length = seam.sides[0].length(match pattern.pieces.get(&seam.sides[0].piece) {
            Some(piece) => piece,
            None => continue,
        });
        let what = format!("zip in {id}");
        supplies.push(Supply { what, count: Some(1), length, colour: Some(zip.colour) });
    }
    let mut elastic = 0.0;
    for piece in pattern.pieces.values() {
        let edges = (0..piece.edge_count())
            .filter_map(|i| Some(piece.edge(i).trims.elastic?.ratio * piece.edge_length(i)));
        let lines = piece.lines.iter().flat_map(|line| {
            let each = move |i: usize| Some(line.edges[i].trims.elastic?.ratio * line_length(line, i));
            (0..line.edges.len()).filter_map(each)
        });
        elastic += edges.chain(lines).sum::<f64>();
    }
    if elastic > 0.0 {
        let what = "elastic, cut to its length at rest".to_owned();
        supplies.push(Supply { what, count: None, length: Some(elastic), colour: None });
    }
    for row in trims.iter().filter(|row| row.what == "topstitching") {
        let what = "topstitching in this thread, length of its lines".to_owned();
        add(&mut supplies, Supply { what, count: None, length: row.length, colour: row.colour });
    }
    supplies
}

/// Adds `new` to a supply of its kind, or as another.
fn add(supplies: &mut Vec<Supply>, new: Supply) {
    let alike = |own: &&mut Supply| own.what == new.what && own.colour == new.colour;
    match supplies.iter_mut().find(alike) {
        Some(own) => {
            own.count = own.count.zip(new.count).map(|(one, other)| one + other);
            own.length = own.length.zip(new.length).map(|(one, other)| one + other);
        }
        None => supplies.push(new),
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::pattern::{Button, EdgeRef, Elastic, Hem, PiecePoint, Seam, Zip};

    #[test]
    fn trims_and_supplies_are_counted() {
        let mut pattern = Pattern::default();
        let corners = [DVec2::ZERO, DVec2::X * 0.4, DVec2::new(0.4, 0.2), DVec2::Y * 0.2];
        let mut piece = Piece::polygon("band", &corners);
        for edge in [0, 2] {
            piece.outline[edge].trims.elastic = Some(Elastic { ratio: 0.5, tension: 15.0 });
        }
        piece.outline[1].trims.hem = Some(Hem { width: 0.02, colour: None });
        let id = pattern.add_piece(piece);
        let other = pattern.add_piece(Piece::polygon("other", &corners));
        let at = PiecePoint { piece: id, at: DVec2::splat(0.1) };
        for _ in 0..3 {
            let hole = PiecePoint { piece: other, ..at };
            let button = Button { button: at, hole, diameter: 0.011, colour: Button::PEARL, open: false };
            pattern.add_button(button);
        }
        let sides = [id, other].map(|piece| EdgeRef { piece, edge: 3 });
        pattern.add_seam(Seam { zip: Some(Zip::CLOSED), ..Seam::of_edges(sides, false) });
        let rows = trims(&pattern, &Artwork::default());
        let row = |piece: &str, what: &str| {
            rows.iter().find(|row| row.piece_name == piece && row.what == what).expect("a row")
        };
        let elastic = row("band", "elastic");
        assert_eq!(elastic.places, ["edge 0", "edge 2"]);
        assert!((elastic.length.expect("a length") - 0.8).abs() < 1e-6);
        assert_eq!(row("band", "hem").measures, "2.0 cm turned in");
        assert_eq!((row("band", "button").places.len(), row("other", "buttonhole").places.len()), (3, 3));
        let supplies = supplies(&pattern, &rows);
        let told: Vec<_> = supplies.iter().map(|s| (s.what.as_str(), s.count, s.length.is_some())).collect();
        let zip = format!("zip in {}", pattern.seams.keys().next().expect("a seam"));
        assert_eq!(
            told,
            [
                ("button of 11.0 mm", Some(3), false),
                (zip.as_str(), Some(1), true),
                ("elastic, cut to its length at rest", None, true)
            ]
        );
        assert!((supplies[2].length.expect("a length") - 0.4).abs() < 1e-6);
    }
}
