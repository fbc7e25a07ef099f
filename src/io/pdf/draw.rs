//! Drawing on a PDF page: lines and texts, in millimetres with y down from the page's upper left corner.

use glam::DVec2;
use image::RgbaImage;
use krilla::color::rgb;
use krilla::geom::{Path, PathBuilder, Point, Size, Transform};
use krilla::image::Image;
use krilla::num::NormalizedF32;
use krilla::paint::{Fill, FillRule, Stroke, StrokeDash};
use krilla::surface::Surface;
use krilla::text::{Font, TextDirection};
use kurbo::PathSeg;

use super::POINTS;
use super::paper::{MARGIN, OVERLAP, Tile, Tiling};
use crate::io::ClothSheet;
use crate::io::trace::{Traced, allowance};
use crate::pattern::{Edge, curve};

/// Millimetres in a metre.
const SCALE: f64 = 1000.0;
/// Length of a notch drawn into the piece, millimetres.
const NOTCH: f64 = 5.0;
/// Length of the sides of a grainline's arrow heads, millimetres.
const ARROW: f64 = 6.0;
/// Average width of a letter, as a fraction of the font size.
const LETTER_WIDTH: f64 = 0.5;
/// Half the width of the diamonds that mark where pages meet, millimetres.
const DIAMOND: f64 = 4.0;

/// Colours that are drawn with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ink {
    Black,
    Blue,
    Grey,
    /// Any colour, sRGB.
    Own([u8; 3]),
}

impl Ink {
    fn colour(self) -> rgb::Color {
        match self {
            Self::Black => rgb::Color::new(0, 0, 0),
            Self::Blue => rgb::Color::new(31, 95, 191),
            Self::Grey => rgb::Color::new(110, 110, 110),
            Self::Own([r, g, b]) => rgb::Color::new(r, g, b),
        }
    }
}

/// The font for all texts.
pub struct Pens {
    font: Font,
}

impl Pens {
    /// Loads the built-in font; None if it cannot be read.
    pub fn new() -> Option<Self> {
        Some(Self { font: Font::new(epaint_default_fonts::UBUNTU_LIGHT.to_vec().into(), 0)? })
    }
}

/// A page to draw on.
pub struct Canvas<'a, 's> {
    surface: &'a mut Surface<'s>,
    pens: &'a Pens,
    /// The point of the pattern plane, in millimetres with y up, at the page's upper left corner.
    pub shift: DVec2,
}

impl<'a, 's> Canvas<'a, 's> {
    /// A canvas on `surface` with no shift.
    pub fn new(surface: &'a mut Surface<'s>, pens: &'a Pens) -> Self {
        Self { surface, pens, shift: DVec2::ZERO }
    }

    /// Draws all lines of a piece and its name.
    pub fn piece(&mut self, piece: &Traced) {
        let shift = self.shift;
        let place = move |p: DVec2| DVec2::new(p.x * SCALE - shift.x, shift.y - p.y * SCALE);
        let cut = if piece.cut_line.is_empty() { &piece.outline } else { &piece.cut_line };
        for line in std::iter::once(cut).chain(&piece.holes) {
            self.stroke(path(line, line[0].start, true, place), Ink::Black, 0.35, &[]);
        }
        if !piece.cut_line.is_empty() {
            let path = path(&piece.outline, piece.outline[0].start, true, place);
            self.stroke(path, Ink::Blue, 0.25, &[4.0, 1.5]);
        }
        for line in &piece.lines {
            self.stroke(path(&line.edges, line.end, false, place), Ink::Grey, 0.25, &[2.0, 1.2]);
        }
        for &at in &piece.notches {
            let [tip, inward] = allowance::notch_tip(&piece.outline, &piece.cut_line, at);
            let end = tip + inward * NOTCH / SCALE;
            self.line(&[place(tip), place(end)], Ink::Black, 0.5);
        }
        if let Some([tail, head]) = piece.grainline {
            self.grainline(place(tail), place(head));
        }
        let [lower, upper] = piece.bounds().map(|p| p * SCALE);
        let mut middle = place((lower + upper) / 2.0 / SCALE);
        let letters = ((upper - lower).min_element() / 8.0).clamp(2.5, 9.0);
        if let Some(grain) = piece.grainline.map(|ends| ends.map(place)) {
            // Keeps the name off the grainline's arrow.
            let width = piece.name.chars().count() as f64 * letters * LETTER_WIDTH;
            let along = (grain[1] - grain[0]).normalize_or_zero();
            if along.perp_dot(middle - grain[0]).abs() < width / 2.0 && along.y.abs() > 0.5 {
                middle.x = grain[0].lerp(grain[1], 0.5).x + width / 2.0 + letters;
            }
        }
        self.centred(middle, letters, &piece.name);
        if letters > 3.0 {
            let size = upper - lower;
            let words = format!("{:.0} × {:.0} mm", size.x, size.y);
            self.centred(middle + DVec2::Y * letters * 1.1, letters * 0.6, &words);
        }
    }

    /// Draws the border of the cloth.
    pub fn cloth(&mut self, cloth: &ClothSheet) {
        let shift = self.shift;
        let corners = cloth.corners().map(|p| DVec2::new(p.x * SCALE - shift.x, shift.y - p.y * SCALE));
        self.stroke(polygon(&corners, true), Ink::Grey, 0.5, &[]);
    }

    fn grainline(&mut self, tail: DVec2, head: DVec2) {
        self.line(&[tail, head], Ink::Grey, 0.3);
        for (from, to) in [(tail, head), (head, tail)] {
            let back = (from - to).normalize_or_zero() * ARROW;
            let [a, b] = [0.35, -0.35].map(|turn: f64| to + DVec2::from_angle(turn).rotate(back));
            self.line(&[a, to, b], Ink::Grey, 0.3);
        }
    }

    /// Draws the cut line of a piece at a reduced scale, for the overview.
    pub fn miniature(&mut self, piece: &Traced, corner: DVec2, at: DVec2, scale: f64) {
        let cut = if piece.cut_line.is_empty() { &piece.outline } else { &piece.cut_line };
        let place = move |p: DVec2| at + DVec2::new(p.x * SCALE - corner.x, corner.y - p.y * SCALE) * scale;
        self.stroke(path(cut, cut[0].start, true, place), Ink::Black, 0.2, &[]);
    }

    /// Draws a square with sides of `side` mm for checking the printed scale; its upper left corner is `at`.
    pub fn test_square(&mut self, at: DVec2, side: f64) {
        let corners = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|p| at + p * side);
        self.stroke(polygon(&corners, true), Ink::Black, 0.2, &[]);
        self.centred(at + DVec2::splat(side / 2.0), 4.0, &format!("{side} × {side} mm"));
        self.centred(at + DVec2::new(side / 2.0, side / 2.0 + 6.0), 3.0, "measure before you cut");
    }

    /// Draws the marks of a page: its frame, the strips that neighbours share, diamonds to align them, and its name.
    pub fn page_marks(&mut self, tile: &Tile, tiling: &Tiling, words: &str) {
        let [lower, upper] = [DVec2::splat(MARGIN), DVec2::splat(MARGIN) + tiling.frame];
        self.frame([lower, upper]);
        let middle = (lower + upper) / 2.0;
        let half = OVERLAP / 2.0;
        let (right, below) = (tile.column + 1 < tiling.columns, tile.row + 1 < tiling.rows);
        // Diamonds lie in the middle of the strip that two pages share, so that each page shows all of them.
        let mut meet = |at: DVec2, between: String, dx: f64, dy: f64| {
            let corners = [DVec2::X, DVec2::Y, DVec2::NEG_X, DVec2::NEG_Y].map(|way| at + way * DIAMOND);
            self.stroke(polygon(&corners, true), Ink::Black, 0.2, &[]);
            self.line(&[at - DVec2::X * DIAMOND, at + DVec2::X * DIAMOND], Ink::Black, 0.1);
            self.line(&[at - DVec2::Y * DIAMOND, at + DVec2::Y * DIAMOND], Ink::Black, 0.1);
            self.grey_text(at + DVec2::new(dx, dy), 2.5, &between);
        };
        let other = |row: usize, column: usize| Tile { row, column, ..*tile }.name();
        let name = tile.name();
        if right {
            let next = other(tile.row, tile.column + 1);
            meet(DVec2::new(upper.x - half, middle.y), format!("{name}–{next}"), -OVERLAP - 6.0, -4.0);
        }
        if tile.column > 0 {
            let next = other(tile.row, tile.column - 1);
            meet(DVec2::new(lower.x + half, middle.y), format!("{next}–{name}"), half + 1.0, -4.0);
        }
        if below {
            let next = other(tile.row + 1, tile.column);
            meet(DVec2::new(middle.x, upper.y - half), format!("{name}–{next}"), half + 1.0, -4.0);
        }
        if tile.row > 0 {
            let next = other(tile.row - 1, tile.column);
            meet(DVec2::new(middle.x, lower.y + half), format!("{next}–{name}"), half + 1.0, 6.0);
        }
        let dash = [1.0, 1.5];
        if right {
            let x = upper.x - OVERLAP;
            self.stroke(
                polygon(&[DVec2::new(x, lower.y), DVec2::new(x, upper.y)], false),
                Ink::Grey,
                0.15,
                &dash,
            );
        }
        if below {
            let y = upper.y - OVERLAP;
            self.stroke(
                polygon(&[DVec2::new(lower.x, y), DVec2::new(upper.x, y)], false),
                Ink::Grey,
                0.15,
                &dash,
            );
        }
        self.grey_text(lower + DVec2::new(3.0, 9.0), 8.0, &name);
        self.grey_text(DVec2::new(lower.x, upper.y + 4.0), 3.0, words);
    }

    /// Draws a thin rectangle.
    pub fn frame(&mut self, [lower, upper]: [DVec2; 2]) {
        let corners = [lower, DVec2::new(upper.x, lower.y), upper, DVec2::new(lower.x, upper.y)];
        self.stroke(polygon(&corners, true), Ink::Grey, 0.15, &[]);
    }

    /// Clips all drawing to a rectangle until [`Canvas::unclip`].
    pub fn clip(&mut self, [lower, upper]: [DVec2; 2]) {
        let corners = [lower, DVec2::new(upper.x, lower.y), upper, DVec2::new(lower.x, upper.y)];
        if let Some(path) = polygon(&corners, true) {
            self.surface.push_clip_path(&path, &FillRule::NonZero);
        }
    }

    /// Ends the clipping that [`Canvas::clip`] began.
    pub fn unclip(&mut self) {
        self.surface.pop();
    }

    /// Draws black text that begins at `at`; `size` is the font size, millimetres.
    pub fn text(&mut self, at: DVec2, size: f64, words: &str) {
        self.words(at, size, words, Ink::Black);
    }

    /// Draws grey text that begins at `at`; `size` is the font size, millimetres.
    pub fn grey_text(&mut self, at: DVec2, size: f64, words: &str) {
        self.words(at, size, words, Ink::Grey);
    }

    /// Draws text centred on `at`; `size` is the font size, millimetres.
    fn centred(&mut self, at: DVec2, size: f64, words: &str) {
        let width = words.chars().count() as f64 * size * LETTER_WIDTH;
        self.words(at - DVec2::X * width / 2.0, size, words, Ink::Black);
    }

    /// Draws a line through `points`, millimetres; `dash` holds the lengths of dashes and gaps, none for a whole line.
    pub fn polyline(&mut self, points: &[DVec2], is_closed: bool, ink: Ink, width: f64, dash: &[f64]) {
        self.stroke(polygon(points, is_closed), ink, width, dash);
    }

    /// Fills what `points` enclose.
    pub fn fill(&mut self, points: &[DVec2], ink: Ink) {
        let Some(path) = polygon(points, true) else { return };
        self.fill_with(ink);
        self.surface.draw_path(&path);
    }

    /// Draws `picture` (straight alpha) with its upper left corner at `at`, `size` wide and high.
    pub fn picture(&mut self, picture: &RgbaImage, at: DVec2, size: DVec2) {
        let [x, y, width, height] = [at.x, at.y, size.x, size.y].map(|mm| (mm * POINTS) as f32);
        let Some(size) = Size::from_wh(width, height) else { return };
        let image = Image::from_rgba8(picture.as_raw().clone(), picture.width(), picture.height());
        self.surface.push_transform(&Transform::from_translate(x, y));
        self.surface.draw_image(image, size);
        self.surface.pop();
    }

    fn fill_with(&mut self, ink: Ink) {
        self.surface.set_stroke(None);
        self.surface.set_fill(Some(Fill {
            paint: ink.colour().into(),
            opacity: NormalizedF32::ONE,
            rule: FillRule::NonZero,
        }));
    }

    /// Draws text that begins at `at`; `size` is the font size, millimetres.
    pub fn words(&mut self, at: DVec2, size: f64, words: &str, ink: Ink) {
        let plain: String = words.chars().filter(|c| !c.is_control()).collect();
        self.fill_with(ink);
        let [x, y, size] = [at.x, at.y, size].map(|mm| (mm * POINTS) as f32);
        self.surface.draw_text(
            Point::from_xy(x, y),
            self.pens.font.clone(),
            size,
            &plain,
            false,
            TextDirection::Auto,
        );
    }

    fn line(&mut self, points: &[DVec2], ink: Ink, width: f64) {
        self.stroke(polygon(points, false), ink, width, &[]);
    }

    fn stroke(&mut self, path: Option<Path>, ink: Ink, width: f64, dash: &[f64]) {
        let Some(path) = path else { return };
        let dash: Vec<f32> = dash.iter().map(|mm| (mm * POINTS) as f32).collect();
        self.surface.set_fill(None);
        self.surface.set_stroke(Some(Stroke {
            paint: ink.colour().into(),
            width: (width * POINTS) as f32,
            dash: (!dash.is_empty()).then_some(StrokeDash { array: dash, offset: 0.0 }),
            ..Stroke::default()
        }));
        self.surface.draw_path(&path);
    }
}

fn polygon(points: &[DVec2], is_closed: bool) -> Option<Path> {
    let mut builder = PathBuilder::new();
    for (i, p) in points.iter().enumerate() {
        let [x, y] = [p.x, p.y].map(|mm| (mm * POINTS) as f32);
        if i == 0 { builder.move_to(x, y) } else { builder.line_to(x, y) }
    }
    if is_closed {
        builder.close();
    }
    builder.finish()
}

fn path(edges: &[Edge], end: DVec2, is_closed: bool, place: impl Fn(DVec2) -> DVec2) -> Option<Path> {
    let mut builder = PathBuilder::new();
    let at = |p: kurbo::Point| {
        let p = place(DVec2::new(p.x, p.y));
        [(p.x * POINTS) as f32, (p.y * POINTS) as f32]
    };
    for (i, edge) in edges.iter().enumerate() {
        let to = edges.get(i + 1).map_or(end, |e| e.start);
        if i == 0 {
            let [x, y] = at(kurbo::Point::new(edge.start.x, edge.start.y));
            builder.move_to(x, y);
        }
        for segment in curve::segments(edge.start, edge.shape, to) {
            match segment {
                PathSeg::Line(l) => {
                    let [x, y] = at(l.p1);
                    builder.line_to(x, y);
                }
                PathSeg::Quad(q) => {
                    let ([cx, cy], [x, y]) = (at(q.p1), at(q.p2));
                    builder.quad_to(cx, cy, x, y);
                }
                PathSeg::Cubic(c) => {
                    let ([ax, ay], [bx, by], [x, y]) = (at(c.p1), at(c.p2), at(c.p3));
                    builder.cubic_to(ax, ay, bx, by, x, y);
                }
            }
        }
    }
    if is_closed {
        builder.close();
    }
    builder.finish()
}
