//! The pieces drawn to scale, each with its name, its size and the numbers of its seams.

use glam::DVec2;

use crate::geometry::ids::PieceId;
use crate::io::pdf::booklet::{Ink, Mark};
use crate::language::{short, tr};
use crate::pack::flow::{Flow, ROOM};
use crate::pack::shape::{Front, Shape, size_of};
use crate::pack::words;
use crate::pattern::{Pattern, Piece, Trims};

/// Scales that are used, and their tenfolds: of 1 to each.
const SCALES: [f64; 9] = [1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0];
/// Millimetres in a metre.
const MM: f64 = 1000.0;
/// Space between drawings, millimetres.
const GAP: f64 = 7.0;
/// Font size and distance of lines of the names below the drawings, millimetres.
const NAME: f64 = 2.9;
const LINE: f64 = 3.7;
/// Least width that a name has, millimetres.
const LEAST: f64 = 27.0;
/// Radius of the circles round the numbers of seams, millimetres.
const CIRCLE: f64 = 1.65;
/// Number of pieces for which there is a page of drawings.
const ON_A_PAGE: usize = 12;
/// Length of a notch, and of the sides of an arrow head, millimetres.
const NOTCH: f64 = 1.6;
const ARROW: f64 = 1.8;
/// Places along a seam where its number is tried, shares of its length.
const PLACES: [f64; 7] = [0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8];
/// Order in which they are tried.
const TRIED: [usize; 7] = [3, 2, 4, 1, 5, 0, 6];

/// What is worked along lines: its ink, and what the legend says of it.
pub(super) const WORKED: [(Ink, &str); 5] = [
    (Ink::Own([222, 120, 20]), "Orange: elastic."),
    (Ink::Own([30, 140, 80]), "Green: hem."),
    (Ink::Own([140, 70, 180]), "Violet: topstitching."),
    (Ink::Own([200, 45, 60]), "Red: fold."),
    (Ink::Own([20, 150, 190]), "Cyan: piping."),
];

/// A piece to be drawn.
#[derive(Clone, Debug)]
pub struct Sketch {
    shape: Shape,
    name: String,
    size: String,
    fill: Ink,
    /// Number of each seam, with points along it, metres.
    seams: Vec<(u32, Vec<DVec2>)>,
    /// Lines that something is worked along: its number in [`WORKED`], and points, metres.
    worked: Vec<(usize, Vec<DVec2>)>,
    /// Middles of buttons, their diameters, metres, and their colours.
    buttons: Vec<(DVec2, f64, [u8; 3])>,
    /// Middles of buttonholes and the diameters of their buttons, metres.
    buttonholes: Vec<(DVec2, f64)>,
}

impl Sketch {
    /// All pieces of `pattern`; `colour` gives the colour of the cloth of each.
    pub fn all(pattern: &Pattern, colour: impl Fn(PieceId) -> Option<[u8; 3]>) -> Vec<Self> {
        let sketch =
            |(&id, piece): (&PieceId, &std::sync::Arc<Piece>)| Self::new(pattern, id, piece, colour(id));
        pattern.pieces.iter().map(sketch).collect()
    }

    fn new(pattern: &Pattern, id: PieceId, piece: &Piece, colour: Option<[u8; 3]>) -> Self {
        let front = Front::of(piece);
        let sides =
            pattern.seams.iter().flat_map(|(seam, own)| own.sides.iter().map(move |side| (seam, side)));
        let seams = sides
            .filter(|(_, side)| side.piece == id)
            .filter_map(|(seam, side)| Some((seam.0, front.all(side.points(piece, &PLACES)?))));
        let buttons = pattern.buttons.values().filter(|button| !button.tack);
        let holes = buttons.clone().filter(|b| b.hole.piece == id);
        let size = size_of(piece);
        Self {
            shape: Shape::of(piece),
            name: format!("{} {}", id.0, words::name(&piece.name)),
            size: format!("{} × {} cm", words::cm(size.x), words::cm(size.y)),
            fill: Ink::Own(colour.map_or([244, 244, 244], pale)),
            seams: seams.collect(),
            worked: worked(piece, front),
            buttonholes: holes.map(|b| (front.at(b.hole.at), b.diameter)).collect(),
            buttons: buttons
                .filter(|b| b.button.piece == id)
                .map(|b| (front.at(b.button.at), b.diameter, b.colour))
                .collect(),
        }
    }

    /// Width and height on paper at a scale of 1 to `ratio`, millimetres.
    fn on_paper(&self, ratio: f64) -> DVec2 {
        self.shape.size() * MM / ratio
    }
}

/// A colour mixed with much white.
fn pale(colour: [u8; 3]) -> [u8; 3] {
    colour.map(|c| 255 - (255 - c) / 4)
}

/// The lines of `piece` that something is worked along.
fn worked(piece: &Piece, front: Front) -> Vec<(usize, Vec<DVec2>)> {
    let fractions: Vec<f64> = (0..=16).map(|i| f64::from(i) / 16.0).collect();
    let kinds = |trims: Trims| {
        let Trims { fold, elastic, topstitch, hem, piping, wrinkle: _ } = trims;
        let all = [elastic.is_some(), hem.is_some(), topstitch.is_some(), fold.is_some(), piping.is_some()];
        (0..all.len()).filter(move |&k| all[k])
    };
    let mut lines = Vec::new();
    for i in 0..piece.edge_count() {
        for kind in kinds(piece.edge(i).trims) {
            lines.push((kind, front.all(piece.edge_points(i, &fractions))));
        }
    }
    for line in &piece.lines {
        for (i, edge) in line.edges.iter().enumerate() {
            let end = line.edges.get(i + 1).map_or(line.end, |next| next.start);
            for kind in kinds(edge.trims) {
                let points = crate::pattern::curve::points(edge.start, edge.shape, end, &fractions);
                lines.push((kind, front.all(points)));
            }
        }
    }
    lines
}

/// Where drawings go: page by page the number of the sketch, and its upper left corner in the room of the page, millimetres.
type Places = Vec<Vec<(usize, DVec2)>>;

/// Rows of drawings at a scale of 1 to `ratio` in pages of `room` millimetres, with `lines` lines of words below each.
/// None where one does not fit a page.
fn placed(sketches: &[Sketch], ratio: f64, room: DVec2, (least, lines): (f64, f64)) -> Option<Places> {
    let mut pages: Places = vec![Vec::new()];
    let (mut at, mut tallest) = (DVec2::ZERO, 0.0_f64);
    for (i, sketch) in sketches.iter().enumerate() {
        let own = sketch.on_paper(ratio);
        let cell = DVec2::new(own.x.max(least), own.y + lines * LINE + 1.0);
        if !cell.cmple(room).all() {
            return None;
        }
        if at.x > 0.0 && at.x + cell.x > room.x {
            at = DVec2::new(0.0, at.y + tallest + GAP);
            tallest = 0.0;
        }
        if at.y + cell.y > room.y {
            pages.push(Vec::new());
            (at, tallest) = (DVec2::ZERO, 0.0);
        }
        pages.last_mut()?.push((i, at));
        at.x += cell.x + GAP;
        tallest = tallest.max(cell.y);
    }
    Some(pages)
}

/// The first of `ratios` at which the drawings fit `most` pages, where one does.
fn scaled(
    sketches: &[Sketch],
    ratios: impl Iterator<Item = f64>,
    room: DVec2,
    cell: (f64, f64),
    most: usize,
) -> Option<(f64, Places)> {
    let fits = |ratio: f64| Some((ratio, placed(sketches, ratio, room, cell)?));
    ratios.filter_map(fits).find(|(_, pages)| pages.len() <= most)
}

/// Scales that are round numbers, from large to small.
fn round() -> impl Iterator<Item = f64> {
    (0..7).flat_map(|tens| SCALES.map(|scale| scale * 10.0_f64.powi(tens)))
}

/// Draws all pieces on pages of their own.
pub fn pages(flow: &mut Flow, sketches: &[Sketch]) {
    let most = sketches.len().div_ceil(ON_A_PAGE).max(1);
    let room = ROOM - DVec2::Y * 24.0;
    let Some((ratio, pages)) = scaled(sketches, round(), room, (LEAST, 3.0), most) else {
        return flow.words(tr("The pieces are too large to be drawn."), Ink::Grey);
    };
    for (k, page) in pages.iter().enumerate() {
        flow.turn();
        let heading = if k == 0 { tr("Pieces to scale") } else { tr("Pieces to scale, continued") };
        flow.heading(heading);
        legend(flow, sketches, page);
        let corner = flow.strip(room.y);
        scale_bar(flow, ratio, corner);
        for &(i, at) in page {
            let own = sketches[i].on_paper(ratio);
            let cell = own.x.max(LEAST);
            draw(flow, &sketches[i], ratio, corner + at + DVec2::X * (cell - own.x) / 2.0);
            names(flow, &sketches[i], corner + at + DVec2::Y * (own.y + 1.0), cell);
        }
    }
}

/// Draws all pieces small in a strip of at most this height; false where they do not fit it.
pub fn overview(flow: &mut Flow, sketches: &[Sketch], most: f64) -> bool {
    let (least, room) = (14.0, DVec2::new(ROOM.x, most));
    let any = std::iter::successors(Some(2.0), |ratio| Some(ratio * 1.05)).take(300);
    let Some((ratio, pages)) = scaled(sketches, any, room, (least, 1.0), 1) else { return false };
    let below = |&(i, at): &(usize, DVec2)| at.y + sketches[i].on_paper(ratio).y + LINE;
    let corner = flow.strip(pages[0].iter().map(below).fold(0.0, f64::max) + 4.0);
    for &(i, at) in &pages[0] {
        let own = sketches[i].on_paper(ratio);
        let cell = own.x.max(least);
        let plain = Sketch { seams: Vec::new(), ..sketches[i].clone() };
        draw(flow, &plain, ratio, corner + at + DVec2::X * (cell - own.x) / 2.0);
        let name = flow.letters().cut(&sketches[i].name, NAME, cell + GAP - 1.0);
        let width = flow.letters().width(&name, NAME);
        // A wide name does not stand out at the left.
        let middle = (at.x + cell / 2.0).max(width / 2.0);
        flow.centred(corner + DVec2::new(middle, at.y + own.y + LINE), NAME, &name, Ink::Black);
    }
    true
}

/// What the lines on this page mean.
fn legend(flow: &mut Flow, sketches: &[Sketch], page: &[(usize, DVec2)]) {
    let shown = || page.iter().map(|&(i, _)| &sketches[i]);
    let mut all = vec![tr("Black: cut.")];
    if shown().any(|sketch| !sketch.shape.seam.is_empty()) {
        all.push(tr("Blue dashes: sew."));
    }
    all.push(tr("Grey: grain, and lines on the piece."));
    if shown().any(|sketch| !sketch.seams.is_empty()) {
        all.push(tr("Circles: numbers of seams."));
    }
    for (kind, (_, meaning)) in WORKED.iter().enumerate() {
        if shown().any(|sketch| sketch.worked.iter().any(|(own, _)| *own == kind)) {
            all.push(tr(meaning));
        }
    }
    all.push(tr("Sizes are without seam allowance."));
    flow.words(&all.join(" "), Ink::Grey);
}

/// A bar of a round length, above the right corner of the drawings.
fn scale_bar(flow: &mut Flow, ratio: f64, corner: DVec2) {
    let mut lengths = (0..7).flat_map(|tens| [0.01, 0.02, 0.05].map(|m| m * 10.0_f64.powi(tens)));
    let length = lengths.rfind(|m| m * MM / ratio <= 40.0).unwrap_or(0.01);
    let right = corner + DVec2::new(ROOM.x, -16.0);
    let left = right - DVec2::X * (length * MM / ratio);
    flow.rule([left, right], Ink::Black, 0.3);
    for end in [left, right] {
        flow.rule([end - DVec2::Y * 1.2, end + DVec2::Y * 1.2], Ink::Black, 0.3);
    }
    let words = format!("1 : {}   {:.0} cm", short(ratio, 1), length * 100.0);
    let width = flow.letters().width(&words, NAME);
    flow.write(left - DVec2::new(width + 2.0, -1.0), NAME, &words, Ink::Black);
}

/// Name and size below a drawing.
fn names(flow: &mut Flow, sketch: &Sketch, at: DVec2, width: f64) {
    let mut lines = flow.letters().lines(&sketch.name, NAME, width + 4.0);
    if lines.len() > 2 {
        let rest = lines.split_off(1).join(" ");
        lines.push(flow.letters().cut(&rest, NAME, width + 2.0));
    }
    for (i, line) in lines.iter().enumerate() {
        flow.centred(at + DVec2::new(width / 2.0, LINE * (i + 1) as f64 - 0.6), NAME, line, Ink::Black);
    }
    let below = at + DVec2::new(width / 2.0, LINE * (lines.len() + 1) as f64 - 0.6);
    flow.centred(below, NAME - 0.3, &sketch.size, Ink::Grey);
}

/// Draws one piece with its upper left corner at `at`.
fn draw(flow: &mut Flow, sketch: &Sketch, ratio: f64, at: DVec2) {
    let shape = &sketch.shape;
    let corner = DVec2::new(shape.bounds[0].x, shape.bounds[1].y);
    let place = |p: DVec2| at + DVec2::new(p.x - corner.x, corner.y - p.y) * MM / ratio;
    let all = |points: &[DVec2]| points.iter().map(|&p| place(p)).collect::<Vec<_>>();
    let line = |points: &[DVec2], is_closed: bool, ink: Ink, width: f64, dash: &'static [f64]| Mark::Line {
        points: all(points),
        is_closed,
        ink,
        width,
        dash,
    };
    flow.mark(Mark::Fill { points: all(&shape.cut), ink: sketch.fill });
    for hole in &shape.holes {
        flow.mark(Mark::Fill { points: all(hole), ink: Ink::Own([255; 3]) });
    }
    for cut in std::iter::once(&shape.cut).chain(&shape.holes) {
        flow.mark(line(cut, true, Ink::Black, 0.25, &[]));
    }
    if !shape.seam.is_empty() {
        flow.mark(line(&shape.seam, true, Ink::Blue, 0.18, &[1.4, 0.7]));
    }
    for own in &shape.lines {
        flow.mark(line(own, false, Ink::Grey, 0.18, &[1.0, 0.7]));
    }
    for (kind, own) in &sketch.worked {
        flow.mark(line(own, false, WORKED[*kind].0, 0.5, &[]));
    }
    for [on, inward] in &shape.notches {
        let from = place(*on);
        flow.rule([from, from + DVec2::new(inward.x, -inward.y) * NOTCH], Ink::Black, 0.25);
    }
    grain(flow, shape.grain.map(place));
    for &(middle, diameter, colour) in &sketch.buttons {
        let points = circle(place(middle), (diameter / 2.0 * MM / ratio).max(0.6));
        flow.mark(Mark::Fill { points: points.clone(), ink: Ink::Own(colour) });
        flow.mark(Mark::Line { points, is_closed: true, ink: Ink::Grey, width: 0.15, dash: &[] });
    }
    for &(middle, diameter) in &sketch.buttonholes {
        let half = DVec2::X * (diameter / 2.0 * MM / ratio).max(0.7);
        flow.rule([place(middle) - half, place(middle) + half], Ink::Black, 0.3);
    }
    seam_numbers(flow, sketch, place);
}

fn grain(flow: &mut Flow, [tail, head]: [DVec2; 2]) {
    flow.rule([tail, head], Ink::Grey, 0.2);
    let back = (tail - head).normalize_or_zero() * ARROW;
    for turn in [0.4, -0.4] {
        flow.rule([head, head + DVec2::from_angle(turn).rotate(back)], Ink::Grey, 0.2);
    }
}

/// The numbers of the seams in circles on their edges, where there is room for them.
fn seam_numbers(flow: &mut Flow, sketch: &Sketch, place: impl Fn(DVec2) -> DVec2) {
    let mut taken: Vec<DVec2> = Vec::new();
    for (seam, points) in &sketch.seams {
        let is_free = |p: &DVec2| taken.iter().all(|other| other.distance(*p) > 2.2 * CIRCLE);
        let mut places = TRIED.iter().filter_map(|&i| points.get(i)).map(|&p| place(p));
        let Some(at) = places.find(|p| is_free(p)) else { continue };
        taken.push(at);
        let points = circle(at, CIRCLE);
        flow.mark(Mark::Fill { points: points.clone(), ink: Ink::Own([255; 3]) });
        flow.mark(Mark::Line { points, is_closed: true, ink: Ink::Grey, width: 0.15, dash: &[] });
        let words = seam.to_string();
        let size = if words.len() > 2 { 1.5 } else { 2.0 };
        flow.centred(at + DVec2::Y * size * 0.35, size, &words, Ink::Black);
    }
}

fn circle(middle: DVec2, radius: f64) -> Vec<DVec2> {
    let point = |i: u32| middle + DVec2::from_angle(std::f64::consts::TAU * f64::from(i) / 24.0) * radius;
    (0..24).map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::pdf::booklet::{Letters, PAGE};
    use crate::pack::flow::MARGIN;

    fn sketches(count: usize, size: f64) -> Vec<Sketch> {
        let mut pattern = Pattern::default();
        for i in 0..count {
            let corners = [DVec2::ZERO, DVec2::X * size, DVec2::splat(size), DVec2::Y * size];
            pattern.add_piece(Piece::polygon(&format!("piece {i}"), &corners));
        }
        Sketch::all(&pattern, |_| None)
    }

    #[test]
    fn pieces_of_any_number_and_size_fit_their_pages() {
        for (count, size) in [(1, 0.05), (4, 0.7), (30, 0.4), (400, 0.01), (3, 40.0), (2, 4000.0)] {
            let mut flow = Flow::new(Letters::new().expect("letters"));
            pages(&mut flow, &sketches(count, size));
            let pages = flow.finish("");
            assert!(pages.len() <= count.div_ceil(ON_A_PAGE).max(1), "{count}: {} pages", pages.len());
            let outlines: Vec<&Vec<DVec2>> = pages
                .iter()
                .flatten()
                .filter_map(|mark| match mark {
                    Mark::Fill { points, .. } => Some(points),
                    _ => None,
                })
                .collect();
            assert_eq!(outlines.len(), count);
            let is_on_page =
                |p: &DVec2| p.cmpge(DVec2::splat(MARGIN - 0.1)).all() && p.cmple(PAGE - 15.0).all();
            assert!(outlines.iter().all(|points| points.iter().all(is_on_page)), "{count} of {size} m");
        }
    }

    #[test]
    fn a_drawing_is_to_the_scale_that_is_told() {
        let (ratio, places) =
            scaled(&sketches(1, 0.7), round(), DVec2::new(180.0, 230.0), (27.0, 3.0), 1).expect("a scale");
        assert_eq!((ratio, places[0].len()), (4.0, 1));
        assert!((sketches(1, 0.7)[0].on_paper(ratio).x - 175.0).abs() < 1e-9);
    }
}
