//! What is worked on the pieces (folds, elastic, stitches, hems, piping, buttons, zips, graphics), and what is bought for it.

use serde::Serialize;

use crate::geometry::ids::PieceId;
use crate::geometry::words::{Value, Words, decimal, words};
use crate::pack::words;
use crate::pattern::{Pattern, Piece, Piping, Stretch, Trims};
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
    pub places: Vec<Words>,
    /// Length of all places together, metres; None for what is at a point.
    pub length: Option<f64>,
    /// Its measures, in words.
    pub measures: Words,
    /// Its colour, sRGB.
    pub colour: Option<[u8; 3]>,
}

/// Something to be bought for a garment.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Supply {
    /// What it is, with its measures.
    pub what: Words,
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
            let place =
                label.map_or_else(|| words!("edge {n}", n = edge), |label| Words::plain(words::name(label)));
            own.along(piece.edge(edge).trims, place, || piece.edge_length(edge));
        }
        for (k, line) in piece.lines.iter().enumerate() {
            for (i, edge) in line.edges.iter().enumerate() {
                let place = match line.name.trim() {
                    "" => words!("line {n}", n = k),
                    name => Words::plain(words::name(name)),
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
        place: Words,
        length: Option<f64>,
        measures: Words,
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
    fn along(&mut self, trims: Trims, place: Words, length: impl Fn() -> f64) {
        if trims.is_none() {
            return;
        }
        // A wrinkle is how cloth lies, and not worked.
        let Trims { fold, elastic, topstitch, hem, piping, wrinkle: _ } = trims;
        let length = Some(length());
        if let Some(fold) = fold {
            let degrees = decimal(fold.angle.to_degrees().abs(), 0);
            let measures = match fold.angle >= 0.0 {
                true => words!("{n}° outwards", n = degrees),
                false => words!("{n}° inwards", n = degrees),
            };
            self.add("fold", place.clone(), length, measures, None);
        }
        if let Some(elastic) = elastic {
            let measures = words!("cut to {n} % of the cloth", n = decimal(elastic.ratio * 100.0, 0));
            self.add("elastic", place.clone(), length, measures, None);
        }
        if let Some(stitch) = topstitch {
            let rows = match stitch.rows {
                1 => words!("1 row"),
                n => words!("{n} rows", n),
            };
            let [mm, stitches, apart] = [stitch.distance, stitch.length, stitch.spacing].map(mm);
            let measures = match stitch.rows > 1 {
                true => words!(
                    "{rows} at {mm} mm, stitches of {stitch} mm, rows {apart} mm apart",
                    rows,
                    mm,
                    stitch = stitches,
                    apart
                ),
                false => words!("{rows} at {mm} mm, stitches of {stitch} mm", rows, mm, stitch = stitches),
            };
            self.add("topstitching", place.clone(), length, measures, Some(stitch.colour));
        }
        if let Some(hem) = hem {
            let measures = words!("{cm} cm turned in", cm = decimal(hem.width * 100.0, 1));
            self.add("hem", place.clone(), length, measures, hem.colour);
        }
        if let Some(piping) = piping {
            self.add("piping", place, length, thickness(&piping), Some(piping.colour));
        }
    }

    fn fastenings(&mut self, pattern: &Pattern) {
        for (id, button) in &pattern.buttons {
            if button.tack {
                if button.pieces().contains(&self.id) {
                    self.add("tack", (*id).into(), None, Words::default(), None);
                }
                continue;
            }
            let mm = mm(button.diameter);
            if button.button.piece == self.id {
                self.add("button", (*id).into(), None, words!("{mm} mm", mm), Some(button.colour));
            }
            if button.hole.piece == self.id {
                self.add("buttonhole", (*id).into(), None, words!("for {mm} mm", mm), None);
            }
        }
        for (id, seam) in &pattern.seams {
            let Some(zip) = seam.zip else { continue };
            if let Some(side) = seam.sides.iter().find(|side| side.piece == self.id) {
                self.add("zip", (*id).into(), side.length(self.piece), Words::default(), Some(zip.colour));
            }
        }
    }

    fn graphics(&mut self, artwork: &Artwork) {
        let own = self.id;
        for (id, graphic) in artwork.graphics.iter().filter(|(_, graphic)| graphic.piece == own) {
            let image = artwork.images.get(&graphic.image);
            let cm = decimal(graphic.width_m * 100.0, 1);
            let measures = match image {
                Some(image) => words!("{name}, {cm} cm wide", name = words::name(&image.name), cm),
                None => words!("an image, {cm} cm wide", cm),
            };
            self.add("graphic", (*id).into(), None, measures, None);
        }
    }
}

/// Thickness of a covered cord, in words.
fn thickness(piping: &Piping) -> Words {
    words!("{mm} mm thick", mm = mm(piping.radius * 2.0))
}

/// A length (metres) in millimetres.
fn mm(metres: f64) -> Value {
    decimal(metres * 1e3, 1)
}

/// Lengths of piping, metres; on a seam whose sides both name it, of one of them: where they differ, as on the first side.
fn piping(pattern: &Pattern) -> Vec<(Piping, f64)> {
    let mut lengths = Vec::new();
    for piece in pattern.pieces.values() {
        for i in 0..piece.edge_count() {
            lengths.extend(piece.edge(i).trims.piping.map(|piping| (piping, piece.edge_length(i))));
        }
        for line in &piece.lines {
            let each = |i: usize| Some((line.edges[i].trims.piping?, line_length(line, i)));
            lengths.extend((0..line.edges.len()).filter_map(each));
        }
    }
    for seam in pattern.seams.values() {
        let [first, mut second] = seam.sides.map(|side| piped_shares(pattern, &side));
        if !seam.same_direction {
            second.iter_mut().for_each(|(_, ends)| *ends = [1.0 - ends[1], 1.0 - ends[0]]);
        }
        let length = pattern.pieces.get(&seam.sides[1].piece).and_then(|piece| seam.sides[1].length(piece));
        for (piping, [from, to]) in second {
            let common = |[a, b]: [f64; 2]| (b.min(to) - a.max(from)).max(0.0);
            let shared: f64 = first.iter().map(|(_, ends)| common(*ends)).sum();
            lengths.push((piping, -shared * length.unwrap_or(0.0)));
        }
    }
    lengths
}

/// The parts of a side of a seam that have piping, as shares of its length.
fn piped_shares(pattern: &Pattern, side: &Stretch) -> Vec<(Piping, [f64; 2])> {
    let Some((piece, parts)) = pattern.pieces.get(&side.piece).and_then(|p| Some((p, side.parts(p)?))) else {
        return Vec::new();
    };
    let lengths: Vec<f64> = parts.iter().map(|&(edge, a, b)| (b - a) * piece.edge_length(edge)).collect();
    let (total, mut at) = (lengths.iter().sum::<f64>(), 0.0);
    let mut shares = Vec::new();
    for ((edge, ..), length) in parts.into_iter().zip(lengths) {
        let ends = [at / total, (at + length) / total];
        shares.extend(piece.edge(edge).trims.piping.map(|piping| (piping, ends)));
        at += length;
    }
    shares
}

/// Length of edge `i` of an internal line, metres.
fn line_length(line: &crate::pattern::InternalLine, i: usize) -> f64 {
    let end = line.edges.get(i + 1).map_or(line.end, |next| next.start);
    crate::pattern::curve::exact_length(line.edges[i].start, line.edges[i].shape, end)
}

/// What is bought for one garment: buttons, zips, elastic, piping and thread that is seen.
pub fn supplies(pattern: &Pattern, trims: &[TrimRow]) -> Vec<Supply> {
    let mut supplies: Vec<Supply> = Vec::new();
    for button in pattern.buttons.values().filter(|button| !button.tack) {
        let what = words!("button of {mm} mm", mm = mm(button.diameter));
        add(&mut supplies, Supply { what, count: Some(1), length: None, colour: Some(button.colour) });
    }
    for (id, seam) in &pattern.seams {
        let Some(zip) = seam.zip else { continue };
        let length = seam.sides[0].length(match pattern.pieces.get(&seam.sides[0].piece) {
            Some(piece) => piece,
            None => continue,
        });
        let what = words!("zip in seam {n}", n = id.0);
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
        let what = words!("elastic, cut to its length at rest");
        supplies.push(Supply { what, count: None, length: Some(elastic), colour: None });
    }
    let mut cords: Vec<Supply> = Vec::new();
    for (cord, length) in piping(pattern) {
        let what = words!("piping {mm} mm thick", mm = mm(cord.radius * 2.0));
        add(&mut cords, Supply { what, count: None, length: Some(length), colour: Some(cord.colour) });
    }
    supplies.extend(cords.into_iter().filter(|cord| cord.length > Some(1e-6)));
    for row in trims.iter().filter(|row| row.what == "topstitching") {
        let what = words!("topstitching in this thread, length of its lines");
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
            let button =
                Button { button: at, hole, diameter: 0.011, colour: Button::PEARL, open: false, tack: false };
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

    #[test]
    fn piping_has_rows_and_a_seam_is_bought_one_cord() {
        let mut pattern = Pattern::default();
        let corners = [DVec2::ZERO, DVec2::X * 0.4, DVec2::new(0.4, 0.2), DVec2::Y * 0.2];
        let mut piece = Piece::polygon("front", &corners);
        let cord = Piping { radius: 0.0015, colour: [1, 2, 3] };
        for edge in [0, 3] {
            piece.outline[edge].trims.piping = Some(cord);
        }
        let front = pattern.add_piece(piece.clone());
        let back = pattern.add_piece(Piece { name: "back".to_owned(), ..piece });
        let bought = |pattern: &Pattern| {
            let rows = trims(pattern, &Artwork::default());
            let row = rows.iter().find(|row| row.piece_name == "front" && row.what == "piping");
            let row = row.expect("a row");
            assert_eq!((row.measures.as_str(), row.colour), ("3.0 mm thick", Some([1, 2, 3])));
            assert_eq!(row.places, ["edge 0", "edge 3"]);
            assert!((row.length.expect("a length") - 0.6).abs() < 1e-6);
            let supplies = supplies(pattern, &rows);
            let [cord] = &supplies[..] else { panic!("one supply") };
            assert_eq!((cord.what.as_str(), cord.count), ("piping 3.0 mm thick", None));
            cord.length.expect("a length")
        };
        assert!((bought(&pattern) - 1.2).abs() < 1e-6, "two pieces that are not sewn");
        let sides = [front, back].map(|piece| EdgeRef { piece, edge: 3 });
        pattern.add_seam(Seam::of_edges(sides, true));
        assert!((bought(&pattern) - 1.0).abs() < 1e-6, "the seam has one cord");
        // A quarter of the lower edge of the back, sewn to the first quarter of that of the front.
        let side = |piece, from, to| Stretch { from, to, ..Stretch::edge(piece, 0) };
        let sides = [side(front, 0.0, 0.25), side(back, 0.75, 1.0)];
        pattern.add_seam(Seam { sides, ..Seam::of_edges([EdgeRef { piece: front, edge: 0 }; 2], false) });
        assert!((bought(&pattern) - 0.9).abs() < 1e-6, "{}", bought(&pattern));
    }
}
