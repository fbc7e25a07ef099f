//! Draws pieces with their contents, and the threads between sewn edges.

use std::f32::consts::FRAC_PI_2;
use std::sync::Arc;

use egui::epaint::TextShape;
use egui::{Color32, FontId, Galley, Pos2, Rect, Shape, Stroke, Vec2, pos2};
use glam::DVec2;

use super::draw::Drawing;
use super::labels::Labels;
use super::shapes::PieceShape;
use super::table::Table;
use super::threads::Ends;
use crate::geometry::ids::{PieceId, SeamId};
use crate::pattern::activity::Activity;
use crate::pattern::{Piece, Stretch};
use crate::ui::actions::Tool;
use crate::ui::language::tr;
use crate::ui::look::signs::{self, Sign};
use crate::ui::look::theme::colour;
use crate::ui::maps::ShownMap;
use crate::ui::scenery::fabric_looks::outside_colour;
use crate::ui::scenery::ring::ring;
use crate::ui::selection::Item;

/// Whether `piece` shows its front.
pub fn front_is_seen(piece: &Piece, shape: &PieceShape) -> bool {
    shape.drawn_from_front != piece.pose.flipped
}

/// Radius of a seam's badge, points.
pub const BADGE: f32 = 7.5;
/// Relative difference of two lengths up to which they count as equal; a larger one is intended.
pub const EQUAL: f64 = 0.01;

/// Room round a name on its patch, both sides together, points.
const NAME_ROOM: Vec2 = Vec2::new(10.0, 3.0);

/// Length on the screen of the shortest piece that has its name, points.
const SHORTEST_NAMED: f32 = 26.0;
/// Breadth on the screen of the narrowest piece that has its name, points.
const NARROWEST_NAMED: f32 = 5.0;

/// Least distance of two threads of a seam that nothing points to, points.
const THREADS_APART: f32 = 14.0;

/// A seam on the screen.
struct Sewn<'a> {
    id: SeamId,
    ends: &'a Ends,
    /// The ends of its threads in pairs.
    sides: [Vec<Pos2>; 2],
    /// Whether it is selected or under the pointer.
    stands_out: bool,
}

/// The name of a piece, placed on the screen.
pub struct Name {
    patch: Rect,
    /// Whether it reads upwards.
    is_upright: bool,
    /// Colour of the patch.
    fill: Color32,
    text: Arc<Galley>,
}

impl Drawing<'_> {
    /// Draws all visible pieces.
    pub fn pieces(&self, table: &Table<'_>) {
        for (id, piece, shape) in table.seen() {
            if self.is_in_view(piece, shape) {
                let item = Item::Piece(id);
                let look = [table.laid.selection.has(item), table.laid.highlight == Some(item)];
                let front = front_is_seen(piece, shape);
                let fill = self.fill(table, (id, piece), front);
                let is_plain = front && piece.activity == Activity::Active && table.laid.map.is_none();
                let pictures = match is_plain {
                    true => {
                        table.pictures.on_piece(table.laid.document, (id, piece, shape), |p| self.place(p))
                    }
                    false => Vec::new(),
                };
                self.piece(piece, shape, look, fill, table.laid.map.map(|map| (map, id)), pictures);
            }
        }
    }

    /// Whether a part of the piece's bounding box is in the pane.
    pub fn is_in_view(&self, piece: &Piece, shape: &PieceShape) -> bool {
        let room = (piece.allowance * self.view.scale) as f32 + 8.0;
        self.bounds_on_screen(piece, shape).expand(room).intersects(self.pane)
    }

    /// Fill of a piece: in the colour of its cloth, or of its layer.
    fn fill(&self, table: &Table<'_>, (id, piece): (PieceId, &Piece), front: bool) -> Color32 {
        let [plain, _] = self.palette.piece(front, piece.layer, piece.activity);
        let own = outside_colour(table.laid.document, id);
        let own = own.filter(|_| front && piece.activity == Activity::Active);
        own.map_or(plain, |own| self.palette.dyed(colour(own)))
    }

    fn piece(
        &self,
        piece: &Piece,
        shape: &PieceShape,
        [selected, near]: [bool; 2],
        fill: Color32,
        map: Option<(&ShownMap, PieceId)>,
        pictures: Vec<egui::Mesh>,
    ) {
        let place = |p: DVec2| self.place(piece.pose.plane_from_piece(p));
        let front = front_is_seen(piece, shape);
        let [_, line] = self.palette.piece(front, piece.layer, piece.activity);
        let mut mesh = egui::Mesh::default();
        mesh.reserve_vertices(shape.fill.len() * 4);
        mesh.reserve_triangles(shape.fill.len() * 2);
        for t in &shape.fill {
            let base = mesh.vertices.len() as u32;
            t.iter().for_each(|&p| mesh.colored_vertex(place(p), fill));
            mesh.add_triangle(base, base + 1, base + 2);
            mesh.add_triangle(base, base + 2, base + 3);
        }
        for corners in map.into_iter().flat_map(|(map, id)| map.flat(id)) {
            let base = mesh.vertices.len() as u32;
            corners.iter().for_each(|&(p, ink)| mesh.colored_vertex(place(p), colour(ink)));
            mesh.add_triangle(base, base + 1, base + 2);
        }
        self.painter.add(Shape::mesh(mesh));
        self.painter.extend(pictures.into_iter().map(Shape::mesh));
        if !shape.cut.is_empty() {
            let mut points: Vec<DVec2> = shape.cut.iter().map(|&p| piece.pose.plane_from_piece(p)).collect();
            points.extend(points.first().copied());
            self.dashed(&points, Stroke::new(1.0, line.gamma_multiply(0.75)));
        }
        let [plain, strong] = self.palette.outline;
        let (width, ink) = match (selected, near) {
            (true, _) => (strong, self.palette.accent),
            (false, true) => (strong, line),
            _ => (plain, line),
        };
        for closed in std::iter::once(&shape.outline).chain(&shape.holes) {
            let points: Vec<Pos2> = closed.iter().map(|&p| place(p)).collect();
            self.painter.add(Shape::closed_line(points, Stroke::new(width, ink)));
        }
        for points in &shape.lines {
            let points: Vec<Pos2> = points.iter().map(|&p| place(p)).collect();
            self.painter.add(Shape::line(points, Stroke::new(1.2, line)));
        }
        for &(at, way) in &shape.notches {
            let ends = [at, at + way * 0.006].map(place);
            self.painter.line_segment(ends, Stroke::new(2.2, line));
        }
        if let Some(ends) = piece.grainline {
            self.arrow(ends.map(place), Stroke::new(1.3, line));
        }
        if piece.symmetric {
            let [lower, upper] = shape.bounds;
            let ends = [DVec2::new(0.0, lower.y), DVec2::new(0.0, upper.y)];
            let ends = ends.map(|p| piece.pose.plane_from_piece(p));
            self.dashed(&ends, Stroke::new(1.0, line.gamma_multiply(0.8)));
        }
    }

    fn arrow(&self, [tail, head]: [Pos2; 2], stroke: Stroke) {
        let along = (head - tail).normalized();
        if (head - tail).length() < 12.0 {
            return;
        }
        self.painter.line_segment([tail, head], stroke);
        for side in [1.0, -1.0] {
            let barb = head - along * 8.0 + along.rot90() * (4.0 * side);
            self.painter.line_segment([head, barb], stroke);
        }
    }

    /// The names of the pieces where they cover no other text: in the middle of the piece, else above or below. Selected pieces and
    /// the one under the pointer come first, with their whole names. Any other name is as long as its piece permits, upright on a narrow
    /// one, and covers no other piece; one without a place is left out.
    pub fn placed_names(&self, table: &Table<'_>, labels: &mut Labels) -> Vec<Name> {
        let stands_out = |id| {
            let item = Item::Piece(id);
            table.laid.selection.has(item) || table.laid.highlight == Some(item)
        };
        let in_view = table.seen().filter(|(_, piece, shape)| self.is_in_view(piece, shape));
        let (first, rest): (Vec<_>, Vec<_>) = in_view.partition(|(id, ..)| stands_out(*id));
        let boxes: Vec<(PieceId, Rect)> = first
            .iter()
            .chain(&rest)
            .map(|&(id, piece, shape)| (id, self.bounds_on_screen(piece, shape)))
            .collect();
        let name = |(id, piece, shape): (PieceId, &Piece, &PieceShape)| {
            let fill = self.fill(table, (id, piece), front_is_seen(piece, shape));
            let (text, is_upright) = self.name_text(piece, shape, fill, stands_out(id))?;
            let across = text.size().y + NAME_ROOM.y + 1.0;
            let lying = text.size() + NAME_ROOM;
            let middle = self.place(piece.pose.plane_from_piece(shape.middle));
            let size = if is_upright { lying.yx() } else { lying };
            let patch = Rect::from_center_size(middle, size);
            let is_on = |place: &Rect| {
                place == &patch || table.piece_at(table.at(place.center())).is_some_and(|(at, _)| at == id)
            };
            let steps = [0.0, -1.0, 1.0, -2.0, 2.0, -3.0, 3.0, -5.0, 5.0];
            let places: Vec<Rect> = steps
                .map(|step| patch.translate(Vec2::Y * (step * across)))
                .into_iter()
                .filter(is_on)
                .filter(|place| stands_out(id) || !covers_other(table, id, &boxes, *place))
                .collect();
            Some(Name { patch: labels.take(&places)?, is_upright, fill, text })
        };
        first.into_iter().chain(rest).filter_map(name).collect()
    }

    /// The name of a piece as long as there is room, and whether it is upright. One that stands out is whole and lies. None where the
    /// piece is too small on the screen for its name.
    fn name_text(
        &self,
        piece: &Piece,
        shape: &PieceShape,
        fill: Color32,
        stands_out: bool,
    ) -> Option<(Arc<Galley>, bool)> {
        let size = (self.view.scale * 0.028).clamp(10.5, 15.0) as f32;
        let words = words_on(piece, front_is_seen(piece, shape));
        let ink = self.palette.name_on(fill);
        let mut job = egui::text::LayoutJob::simple_singleline(words, FontId::proportional(size), ink);
        let whole = self.painter.layout_job(job.clone());
        if stands_out {
            return Some((whole, false));
        }
        let bounds = self.bounds_on_screen(piece, shape).size();
        let is_upright = whole.size().x + NAME_ROOM.x > bounds.x && bounds.y > bounds.x;
        let long = if is_upright { bounds.y } else { bounds.x };
        if long < SHORTEST_NAMED || bounds.min_elem() < NARROWEST_NAMED {
            return None;
        }
        job.wrap = egui::text::TextWrapping::truncate_at_width(long - NAME_ROOM.x);
        Some((self.painter.layout_job(job), is_upright))
    }

    /// The bounding box of a piece on the screen.
    fn bounds_on_screen(&self, piece: &Piece, shape: &PieceShape) -> Rect {
        Rect::from_points(&shape.corners().map(|p| self.place(piece.pose.plane_from_piece(p))))
    }

    /// Draws names on a patch of the piece's colour, so that marks do not run through them.
    pub fn names(&self, names: Vec<Name>) {
        for Name { patch, is_upright, fill, text } in names {
            self.painter.rect_filled(patch, 5.0, fill.gamma_multiply(0.88));
            let ink = self.palette.name_on(fill);
            if is_upright {
                let from = patch.left_bottom() + Vec2::new(NAME_ROOM.y, -NAME_ROOM.x) / 2.0;
                self.painter.add(TextShape::new(from, text, ink).with_angle(-FRAC_PI_2));
            } else {
                self.painter.galley(patch.min + NAME_ROOM / 2.0, text, ink);
            }
        }
    }

    /// Draws the threads between sewn edges that nothing points to: under the pieces, so that these can be read.
    pub fn threads_below(&self, table: &Table<'_>) {
        if table.laid.tool == Tool::Sew {
            return;
        }
        let mut mesh = egui::Mesh::default();
        for Sewn { id, ends, sides, .. } in self.sewn(table).filter(|sewn| !sewn.stands_out) {
            let strength = if ends.is_twisted { self.palette.faint.max(0.7) } else { self.palette.faint };
            let [from, to] = &sides;
            let some = apart(from, to, THREADS_APART);
            let some = [from, to].map(|side| some.iter().map(|&i| side[i]).collect());
            self.threads(&mut mesh, &some, self.seam_ink(id, ends).gamma_multiply(strength), 1.0);
        }
        self.painter.add(Shape::mesh(mesh));
    }

    /// Draws sewn edges in the colour of their seam, and the threads of seams that stand out.
    pub fn seams(&self, table: &Table<'_>) {
        let sewing = table.laid.tool == Tool::Sew;
        let mut mesh = egui::Mesh::default();
        let (loud, quiet): (Vec<_>, Vec<_>) = self.sewn(table).partition(|sewn| sewn.stands_out);
        for Sewn { id, ends, sides, .. } in &quiet {
            let ink = self.seam_ink(*id, ends);
            if sewing {
                self.threads(&mut mesh, sides, ink.gamma_multiply(self.palette.faint.max(0.7)), 1.0);
            }
            let ink = ink.gamma_multiply(if sewing { 1.0 } else { self.palette.faint.max(0.8) });
            sides.iter().for_each(|side| strip(&mut mesh, side, ink, 2.0));
        }
        for Sewn { id, ends, sides, .. } in &loud {
            let ink = self.seam_ink(*id, ends);
            self.threads(&mut mesh, sides, ink, 1.4);
            sides.iter().for_each(|side| strip(&mut mesh, side, ink, 4.0));
        }
        self.painter.add(Shape::mesh(mesh));
    }

    /// The seams that are in the pane.
    fn sewn<'t>(&'t self, table: &'t Table<'_>) -> impl Iterator<Item = Sewn<'t>> {
        let near = match table.laid.highlight {
            Some(Item::Seam(id)) => Some(id),
            _ => None,
        };
        table.threads.all().filter(|(_, ends)| ends.is_seen(table.pattern())).filter_map(move |(id, ends)| {
            let sides = ends.on_table(table.pattern())?;
            let sides = sides.map(|side| side.iter().map(|&p| self.place(p)).collect::<Vec<Pos2>>());
            let all = Rect::from_points(&[&sides[0][..], &sides[1][..]].concat());
            let stands_out = near == Some(id) || table.laid.selection.seams.contains(&id);
            all.intersects(self.pane).then_some(Sewn { id, ends, sides, stands_out })
        })
    }

    /// The colour of a seam; twisted seams have the colour of errors.
    pub fn seam_ink(&self, id: SeamId, ends: &Ends) -> Color32 {
        if ends.is_twisted { self.palette.error } else { self.palette.seam(id.0) }
    }

    fn threads(&self, mesh: &mut egui::Mesh, [from, to]: &[Vec<Pos2>; 2], ink: Color32, width: f32) {
        for (&p, &q) in from.iter().zip(to) {
            strip(mesh, &[p, q], ink, width);
        }
    }

    /// Draws a round badge in the middle of each sewn stretch; a click on it reverses the seam. A tick marks where the seam
    /// begins.
    pub fn badges(&self, table: &Table<'_>) {
        for (id, ends) in table.threads.all().filter(|(_, ends)| ends.is_seen(table.pattern())) {
            let Some(sides) = ends.on_table(table.pattern()) else { continue };
            let ink = self.seam_ink(id, ends);
            for side in &sides {
                if !has_badge(table, id, side) {
                    continue;
                }
                self.direction(side, ink);
                let Some(at) = badge_place(side).map(|p| self.place(p)) else { continue };
                if self.pane.contains(at) {
                    self.painter.circle(at, BADGE, ink, Stroke::new(1.4, self.palette.halo));
                    let inside = Rect::from_center_size(at, Vec2::splat(BADGE * 1.15));
                    signs::draw(&self.painter, inside, Sign::Turn, true, self.palette.knob);
                }
            }
        }
    }

    /// Draws a short tick near the end of `side` where the seam's threads begin.
    pub fn direction(&self, side: &[DVec2], ink: Color32) {
        let [first, second, ..] = side else { return };
        let along = (self.place(*second) - self.place(*first)).normalized();
        let at = self.place(*first) + along * 7.0;
        self.painter
            .line_segment([at - along.rot90() * 5.0, at + along.rot90() * 5.0], Stroke::new(2.0, ink));
    }

    /// Draws a seam that would be sewn by the next click.
    pub fn seam_to_be(&self, table: &Table<'_>, seam: &crate::pattern::Seam, ink: Color32) {
        let Some(sides) = super::threads::threads(table.pattern(), seam) else { return };
        let pose = |k: usize| table.pattern().pieces[&seam.sides[k].piece].pose;
        let mut mesh = egui::Mesh::default();
        let placed: Vec<Vec<DVec2>> =
            (0..2).map(|k| sides[k].iter().map(|&p| pose(k).plane_from_piece(p)).collect()).collect();
        let screen = |k: usize| placed[k].iter().map(|&p| self.place(p)).collect::<Vec<Pos2>>();
        self.threads(&mut mesh, &[screen(0), screen(1)], ink, 1.4);
        self.painter.add(Shape::mesh(mesh));
        for side in &placed {
            self.direction(side, ink);
        }
    }

    /// Draws an emphasised stretch of outline.
    pub fn stretch(&self, table: &Table<'_>, stretch: Stretch, ink: Color32, width: f32) {
        let Some(piece) = table.pattern().pieces.get(&stretch.piece) else { return };
        let at: Vec<f64> = (0..=32).map(|i| f64::from(i) / 32.0).collect();
        if let Some(points) = stretch.points(piece, &at) {
            let points: Vec<DVec2> = points.iter().map(|&p| piece.pose.plane_from_piece(p)).collect();
            self.polyline(&points, Stroke::new(width, ink));
        }
    }

    /// Draws a ring round the place that is shown.
    pub fn spot(&self, table: &Table<'_>) {
        let Some((id, ring)) = table.laid.spot.map(ring) else { return };
        let Some(piece) = table.pattern().pieces.get(&id) else { return };
        let points: Vec<DVec2> = ring.into_iter().map(|p| piece.pose.plane_from_piece(p)).collect();
        self.polyline(&points, Stroke::new(5.0, self.palette.halo));
        self.polyline(&points, Stroke::new(3.0, self.palette.accent));
    }

    /// Draws edges and lines that are selected or under the pointer.
    pub fn edges_standing_out(&self, table: &Table<'_>) {
        let near = match table.laid.highlight {
            Some(Item::Edge(edge)) => Some(edge),
            _ => None,
        };
        for &edge in table.laid.selection.edges.iter().chain(&near) {
            if let Some(points) = table.edge(edge) {
                self.polyline(&points, Stroke::new(3.4, self.palette.accent));
            }
        }
        let near = match table.laid.highlight {
            Some(Item::Line(line)) => Some(line),
            _ => None,
        };
        for &line in table.laid.selection.lines.iter().chain(&near) {
            if let Some((found, _)) = table.piece(line.piece)
                && let Some(points) = table.line_shown(line)
            {
                let points: Vec<DVec2> = points.iter().map(|&p| found.pose.plane_from_piece(p)).collect();
                self.polyline(&points, Stroke::new(3.0, self.palette.accent));
            }
        }
    }
}

/// Whether a sewn side has a badge: sides that are short on the screen have one only while their seam is emphasised.
pub fn has_badge(table: &Table<'_>, id: SeamId, side: &[DVec2]) -> bool {
    let length: f64 = side.windows(2).map(|w| w[0].distance(w[1])).sum();
    let item = Item::Seam(id);
    length > table.reach(34.0) || table.laid.highlight == Some(item) || table.laid.selection.has(item)
}

/// Position of the badge of a sewn side.
pub fn badge_place(side: &[DVec2]) -> Option<DVec2> {
    let middle = side.len() / 2;
    Some(match side.len() {
        0 => return None,
        n if n % 2 == 1 => side[middle],
        _ => side[middle - 1].midpoint(side[middle]),
    })
}

/// Whether a name of the piece `id` at `place` would cover another piece. `boxes` has the bounding boxes of all pieces in view.
fn covers_other(table: &Table<'_>, id: PieceId, boxes: &[(PieceId, Rect)], place: Rect) -> bool {
    let text = place.shrink2(NAME_ROOM / 2.0);
    let border = [0.0, 0.25, 0.5, 0.75, 1.0].into_iter().flat_map(|share| {
        let along = text.min + share * text.size();
        match text.width() > text.height() {
            true => [pos2(along.x, text.top()), pos2(along.x, text.bottom())],
            false => [pos2(text.left(), along.y), pos2(text.right(), along.y)],
        }
    });
    let border: Vec<DVec2> = border.map(|p| table.at(p)).collect();
    boxes.iter().filter(|(other, bounds)| *other != id && bounds.intersects(text)).any(|(other, _)| {
        let Some((piece, shape)) = table.piece(*other) else { return false };
        border.iter().any(|&p| shape.contains(piece.pose.piece_from_plane(p)))
    })
}

/// The text on a piece: its name and special properties.
fn words_on(piece: &Piece, front: bool) -> String {
    let mut words = piece.name.clone();
    for (is_so, sign) in [
        (!front, tr(" (back)")),
        (piece.twin.is_some(), tr(" · twin")),
        (piece.symmetric, tr(" · symmetric")),
        (piece.locked, tr(" · locked")),
        (piece.activity == Activity::Frozen, tr(" · frozen")),
        (piece.activity.is_deactivated(), tr(" · deactivated")),
    ] {
        if is_so {
            words.push_str(sign);
        }
    }
    words
}

/// The indices of the first and last of the threads between `from` and `to`, and of those between that are at least `least` apart.
fn apart(from: &[Pos2], to: &[Pos2], least: f32) -> Vec<usize> {
    let is_apart = |i: usize, j: usize| from[i].distance(from[j]).max(to[i].distance(to[j])) >= least;
    let last = from.len().saturating_sub(1);
    let mut taken: Vec<usize> = vec![0];
    for i in 1..last {
        if is_apart(i, taken[taken.len() - 1]) && is_apart(i, last) {
            taken.push(i);
        }
    }
    if last > 0 {
        taken.push(last);
    }
    taken
}

/// Adds a polyline to `mesh` as two triangles per segment, which is cheap for many lines.
fn strip(mesh: &mut egui::Mesh, points: &[Pos2], ink: Color32, width: f32) {
    for w in points.windows(2) {
        let along = (w[1] - w[0]).normalized() * (width / 2.0);
        let across = along.rot90();
        let base = mesh.vertices.len() as u32;
        for p in [w[0] + across, w[1] + across, w[1] - across, w[0] - across] {
            mesh.colored_vertex(pos2(p.x, p.y), ink);
        }
        mesh.add_triangle(base, base + 1, base + 2);
        mesh.add_triangle(base, base + 2, base + 3);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quiet_threads_keep_their_distance_and_the_ends() {
        let side = |step: f32| (0..=8).map(|i| pos2(step * i as f32, 0.0)).collect::<Vec<_>>();
        assert_eq!(apart(&side(20.0), &side(20.0), 14.0), (0..=8).collect::<Vec<_>>());
        assert_eq!(apart(&side(5.0), &side(4.0), 14.0), [0, 3, 8]);
        assert_eq!(apart(&side(1.0), &side(20.0), 14.0), (0..=8).collect::<Vec<_>>(), "one side is short");
        assert_eq!(apart(&side(0.1), &side(0.1), 14.0), [0, 8]);
    }
}
