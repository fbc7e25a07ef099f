//! A marker drawn to scale: the cloth, and on it the pieces with names and grainlines.

use egui::{
    Align2, Color32, FontId, Painter, Pos2, Rect, ScrollArea, Sense, Shape, Stroke, Vec2, pos2, vec2,
};
use glam::DVec2;

use crate::geometry::polygon::contains;
use crate::marker::{Marker, Placed};
use crate::pattern::piece::flattened_loop;
use crate::ui::language::say;
use crate::ui::look::theme::Palette;
use crate::ui::pattern_pane::shapes::{middle, trapezoids};
use crate::ui::preferences::units::LengthUnit;

/// Flattening tolerance of lines within pieces, metres.
const TOLERANCE: f64 = 1e-3;
/// Room for the figures beside the cloth: left, top, right and below, points.
const LEFT: f32 = 26.0;
const TOP: f32 = 8.0;
const RIGHT: f32 = 10.0;
const BELOW: f32 = 24.0;
/// Least width of the cloth on the screen, points: a longer marker is scrolled.
const NARROWEST: f32 = 150.0;
/// Sizes of names that are tried, points.
const SIZES: [f32; 4] = [13.5, 12.0, 11.0, 10.0];

/// A marker as it is drawn.
#[derive(Debug)]
pub struct Preview {
    /// Length and width of the cloth, metres.
    cloth: DVec2,
    pieces: Vec<PieceView>,
}

/// A piece on the cloth; everything in metres from the cloth's corner.
#[derive(Debug)]
struct PieceView {
    name: String,
    /// The cutting line, closed.
    outline: Vec<DVec2>,
    /// Its interior as trapezoids.
    fill: Vec<[DVec2; 4]>,
    /// Sewing line and holes, closed.
    inner: Vec<Vec<DVec2>>,
    grain: Option<[DVec2; 2]>,
    /// Place of the name.
    middle: DVec2,
    /// Sides of the bounding box.
    size: DVec2,
}

impl PieceView {
    fn new(placed: &Placed) -> Self {
        let piece = &placed.piece;
        let on_cloth = |p: DVec2| piece.pose.plane_from_piece(p);
        let outline = placed.outline.clone();
        let fill = trapezoids(std::iter::once(&outline));
        let lower = outline.iter().copied().reduce(DVec2::min).unwrap_or_default();
        let upper = outline.iter().copied().reduce(DVec2::max).unwrap_or_default();
        let has_allowance = piece.allowance > 0.0 || !piece.cut_line.is_empty();
        let inner = piece.loops().skip(usize::from(!has_allowance));
        Self {
            name: piece.name.clone(),
            middle: middle(&fill),
            size: upper - lower,
            inner: inner
                .map(|line| flattened_loop(line, TOLERANCE).into_iter().map(on_cloth).collect())
                .collect(),
            grain: piece.grainline.map(|ends| ends.map(on_cloth)),
            fill,
            outline,
        }
    }
}

/// Where the cloth is on the screen.
#[derive(Clone, Copy)]
struct Place {
    /// The lower left corner of the cloth.
    origin: Pos2,
    /// Points per metre.
    scale: f32,
}

impl Place {
    fn point(self, p: DVec2) -> Pos2 {
        self.origin + vec2(p.x as f32, -p.y as f32) * self.scale
    }

    fn line(self, points: &[DVec2]) -> Vec<Pos2> {
        points.iter().map(|&p| self.point(p)).collect()
    }

    fn cloth(self, p: Pos2) -> DVec2 {
        let by = (p - self.origin) / self.scale;
        DVec2::new(f64::from(by.x), f64::from(-by.y))
    }
}

impl Preview {
    /// The pieces of `marker`.
    pub fn new(marker: &Marker) -> Self {
        Self {
            cloth: DVec2::new(marker.length, marker.order.width),
            pieces: marker.placed.iter().map(PieceView::new).collect(),
        }
    }

    /// Draws the marker in `size` points: the whole cloth, or a part of a long one, to be scrolled along it.
    pub fn ui(&self, ui: &mut egui::Ui, size: Vec2, palette: &Palette, unit: LengthUnit) {
        let cloth = vec2(self.cloth.x as f32, self.cloth.y as f32).max(Vec2::splat(1e-3));
        let rim = vec2(LEFT + RIGHT, TOP + BELOW);
        let fits = ((size - rim) / cloth).min_elem();
        let scale = fits.max((NARROWEST / cloth.y).min((size.y - rim.y) / cloth.y));
        ui.allocate_ui(size, |ui| {
            ui.painter().rect_filled(Rect::from_min_size(ui.max_rect().min, size), 5.0, palette.table);
            let bar = if scale > fits { 14.0 } else { 0.0 };
            let shown = (cloth * scale + rim).max(size - vec2(0.0, bar));
            let area = ScrollArea::horizontal().id_salt("marker").auto_shrink(false);
            area.show(ui, |ui| self.on_cloth(ui, shown, scale, palette, unit));
        });
    }

    /// Draws the marker in the middle of `size`, `scale` points to a metre; the pointer tells the piece under it.
    fn on_cloth(&self, ui: &mut egui::Ui, size: Vec2, scale: f32, palette: &Palette, unit: LengthUnit) {
        let (rect, response) = ui.allocate_exact_size(size, Sense::hover());
        let rim = vec2(LEFT + RIGHT, TOP + BELOW);
        let cloth = vec2(self.cloth.x as f32, self.cloth.y as f32);
        let drawn = Rect::from_center_size(rect.center(), cloth * scale + rim);
        let place = Place { origin: drawn.left_bottom() + vec2(LEFT, -BELOW), scale };
        let [length, width] = [self.cloth.x, self.cloth.y].map(|side| unit.text(side));
        let words = say!(
            "Marker: {count} pieces on {length} of cloth {width} wide",
            count = self.pieces.len(),
            length,
            width
        );
        response.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::Image, true, &words));
        let at = response.hover_pos().map(|at| place.cloth(at));
        let pointed = at.and_then(|at| self.pieces.iter().position(|piece| contains(&piece.outline, at)));
        self.cloth(ui, place, unit);
        for (i, piece) in self.pieces.iter().enumerate() {
            piece.draw(ui.painter(), place, palette, pointed == Some(i));
        }
        if let Some(piece) = pointed.map(|i| &self.pieces[i]) {
            let [along, across] = [piece.size.x, piece.size.y].map(|side| unit.text(side));
            let name = &piece.name;
            let words = say!("{name}: {along} along the cloth, {across} across", name, along, across);
            response.on_hover_text_at_pointer(words);
        }
    }

    /// Draws the cloth with its length and width.
    fn cloth(&self, ui: &egui::Ui, place: Place, unit: LengthUnit) {
        let (painter, visuals) = (ui.painter(), ui.visuals());
        let cloth = Rect::from_two_pos(place.point(DVec2::ZERO), place.point(self.cloth));
        let edge = Stroke::new(1.0, visuals.weak_text_color());
        painter.rect(cloth, 0.0, visuals.window_fill, edge, egui::StrokeKind::Outside);
        let font = FontId::proportional(12.0);
        let ink = visuals.text_color();
        let below = cloth.center_bottom() + vec2(0.0, 5.0);
        painter.text(below, Align2::CENTER_TOP, unit.text(self.cloth.x), font.clone(), ink);
        let text = painter.layout_no_wrap(unit.text(self.cloth.y), font, ink);
        turned_text(painter, cloth.left_center() - vec2(5.0 + text.size().y / 2.0, 0.0), text, ink);
    }
}

impl PieceView {
    fn draw(&self, painter: &Painter, place: Place, palette: &Palette, is_pointed: bool) {
        let [fill, line] = palette.front;
        let mut mesh = egui::Mesh::default();
        for corners in &self.fill {
            let base = mesh.vertices.len() as u32;
            corners.iter().for_each(|&p| mesh.colored_vertex(place.point(p), fill));
            mesh.add_triangle(base, base + 1, base + 2);
            mesh.add_triangle(base, base + 2, base + 3);
        }
        painter.add(Shape::mesh(mesh));
        for inner in &self.inner {
            let mut points = place.line(inner);
            points.extend(points.first().copied());
            painter.extend(Shape::dashed_line(
                &points,
                Stroke::new(1.0, line.gamma_multiply(0.75)),
                5.0,
                3.0,
            ));
        }
        let stroke = match (is_pointed, palette.outline) {
            (true, [_, strong]) => Stroke::new(strong, palette.accent),
            (false, [plain, _]) => Stroke::new(plain, line),
        };
        closed_line(painter, place.line(&self.outline), stroke);
        if let Some(ends) = self.grain {
            arrow(painter, ends.map(|p| place.point(p)), Stroke::new(1.2, line));
        }
        self.name(painter, place, fill, palette.name_on(fill));
    }

    /// Draws the name in the largest size that has room, along the cloth or across it; where it has none, the pointer tells it.
    fn name(&self, painter: &Painter, place: Place, fill: Color32, ink: Color32) {
        let room = vec2(self.size.x as f32, self.size.y as f32) * place.scale * 0.86;
        let middle = place.point(self.middle);
        for size in SIZES {
            let text = painter.layout_no_wrap(self.name.clone(), FontId::proportional(size), ink);
            let (along, across) = (text.size(), vec2(text.size().y, text.size().x));
            let patch = |size: Vec2| Rect::from_center_size(middle, size + vec2(6.0, 4.0));
            if along.x <= room.x && along.y <= room.y {
                painter.rect_filled(patch(along), 4.0, fill);
                painter.galley(patch(along).shrink2(vec2(3.0, 2.0)).min, text, ink);
                return;
            }
            if across.x <= room.x && across.y <= room.y {
                painter.rect_filled(patch(across), 4.0, fill);
                return turned_text(painter, middle, text, ink);
            }
        }
    }
}

/// Draws a text that reads upwards, about its middle.
fn turned_text(painter: &Painter, middle: Pos2, text: std::sync::Arc<egui::Galley>, ink: Color32) {
    let half = text.size() / 2.0;
    let corner = pos2(middle.x - half.y, middle.y + half.x);
    painter.add(egui::epaint::TextShape::new(corner, text, ink).with_angle(-std::f32::consts::FRAC_PI_2));
}

/// Draws a closed line, in parts that end at very sharp corners: there egui would draw a long spike.
fn closed_line(painter: &Painter, mut points: Vec<Pos2>, stroke: Stroke) {
    points.dedup_by(|a, b| a.distance(*b) < 0.5);
    let n = points.len();
    let way = |i: usize| (points[(i + 1) % n] - points[i % n]).normalized();
    let is_sharp = |i: usize| way(i + n - 1).dot(way(i)) < -0.3;
    let Some(first) = (0..n).find(|&i| is_sharp(i)) else {
        painter.add(Shape::closed_line(points, stroke));
        return;
    };
    let mut part = vec![points[first]];
    for i in (1..=n).map(|k| (first + k) % n) {
        part.push(points[i]);
        if is_sharp(i) {
            painter.add(Shape::line(std::mem::replace(&mut part, vec![points[i]]), stroke));
        }
    }
}

fn arrow(painter: &Painter, [tail, head]: [Pos2; 2], stroke: Stroke) {
    let along = (head - tail).normalized();
    painter.line_segment([tail, head], stroke);
    for side in [1.0, -1.0] {
        painter.line_segment([head, head - along * 7.0 + along.rot90() * (3.5 * side)], stroke);
    }
}
