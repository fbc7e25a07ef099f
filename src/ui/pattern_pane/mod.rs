//! The pattern pane: flat pieces on a table, painted and moved with the pointer.

mod draw;
pub mod shapes;
pub mod threads;
pub mod view;

use egui::accesskit::Role;
use egui::{CursorIcon, Event, Key, PointerButton, Pos2, Rect, Response, Sense, WidgetInfo};
use glam::DVec2;

use crate::geometry::ids::{MarkId, PieceId, SeamId};
use crate::pattern::{Pattern, PlanePose};
use crate::session::samples::Sample;
use crate::session::{Command, Document};
use crate::ui::actions::{Action, Tool};
use crate::ui::asks::{Ask, Asks, in_one_step};
use crate::ui::clicks::clicks;
use crate::ui::mouse::{Deed, Mouse};
use crate::ui::stroke;
use crate::ui::theme::Palette;
use crate::wrap::{ClothSide, Marks};
use draw::{Drawing, MarkLook, front_is_seen};
use shapes::Shapes;
use threads::{Threads, to_polyline};
use view::TableView;

/// Logarithm of the zoom for each point the pointer moves.
const ZOOM: f64 = 0.008;
/// How near to a mark or an edge a click counts, points on the screen.
const REACH: f64 = 12.0;

/// The table as it is seen, and the drag under way.
#[derive(Debug, Default)]
pub struct PatternPane {
    /// Which part of the table is seen.
    pub view: TableView,
    /// Show the whole pattern in the next frame.
    pub fit: bool,
    /// Whether the pointer was over the pane in the last frame.
    pub hovered: bool,
    /// Where it was on the screen in the last frame.
    pub area: Option<Rect>,
    shapes: Shapes,
    threads: Threads,
    drag: Option<Drag>,
}

#[derive(Debug)]
enum Drag {
    /// Strokes, each in its piece's own plane: the topmost piece's first, those of pieces under it only with the laser.
    Paint(Vec<(PieceId, Vec<DVec2>)>),
    /// A piece and where it was held.
    Piece { piece: PieceId, held: DVec2, pose: PlanePose },
    /// Given up; the button is still down.
    Over,
}

/// What the pane shows, and what the pointer does there.
#[derive(Clone, Copy)]
pub struct Laid<'a> {
    /// The document.
    pub document: &'a Document,
    /// What the left button does.
    pub tool: Tool,
    /// What all buttons do.
    pub mouse: Mouse,
    /// Strokes go through to the pieces below.
    pub laser: bool,
    /// The mark that stands out.
    pub selected: Option<MarkId>,
    /// Marks proposed and not accepted yet.
    pub ghosts: Option<&'a Marks>,
    /// Colours.
    pub palette: &'a Palette,
}

/// What lies under the pointer.
#[derive(Clone, Copy, Debug, Default)]
struct Under {
    mark: Option<MarkId>,
    piece: Option<PieceId>,
    seam: Option<SeamId>,
}

impl PatternPane {
    /// A pane that will show the whole pattern.
    pub fn fitted() -> Self {
        Self { fit: true, ..Self::default() }
    }

    /// Draws the pane and listens to the pointer.
    pub fn ui(&mut self, ui: &mut egui::Ui, laid: &Laid<'_>, asks: &mut Asks) {
        let Laid { document, tool, .. } = *laid;
        let pattern = &*document.pattern;
        self.shapes.update(pattern);
        self.threads.update(pattern, &self.shapes);
        let pane = ui.available_rect_before_wrap();
        let response = ui.allocate_rect(pane, Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Pattern pane"));
        self.hovered = response.contains_pointer();
        self.area = Some(pane);
        if std::mem::take(&mut self.fit) {
            self.view.fit(pane, pattern);
        }
        self.move_view(ui, laid.mouse, pane, &response);
        let hovered = response.hover_pos().filter(|_| self.drag.is_none());
        let under = hovered.map(|at| self.under(document, pane, at)).unwrap_or_default();
        self.listen(ui, laid, pane, &response, under, asks);
        self.set_cursor(ui, tool, under, &response);
        self.draw(ui, laid, pane, under);
        publish_marks(ui, document, &document.marks, "Mark", pane, &self.view);
        if let Some(ghosts) = laid.ghosts {
            publish_marks(ui, document, ghosts, "Proposed mark", pane, &self.view);
        }
    }

    /// The stroke under way, in its piece's plane.
    pub fn stroke(&self) -> Option<(PieceId, &[DVec2])> {
        match &self.drag {
            Some(Drag::Paint(strokes)) => strokes.first().map(|(piece, points)| (*piece, &points[..])),
            _ => None,
        }
    }

    fn move_view(&mut self, ui: &egui::Ui, mouse: Mouse, pane: Rect, response: &Response) {
        let space = ui.input(|i| i.key_down(Key::Space)) && self.drag.is_none();
        let held = ui.input(|i| i.modifiers);
        let buttons = [PointerButton::Primary, PointerButton::Secondary, PointerButton::Middle];
        let pressed = buttons.into_iter().find(|&button| response.dragged_by(button));
        let moved = response.drag_delta();
        match pressed.and_then(|button| mouse.deed(button, held)) {
            _ if space && pressed == Some(PointerButton::Primary) => self.view.pan(moved),
            Some(Deed::Pan | Deed::Turn | Deed::HandOrTurn) if self.drag.is_none() => self.view.pan(moved),
            Some(Deed::Zoom) => self.view.zoom(pane, pane.center(), (f64::from(-moved.y) * ZOOM).exp()),
            _ => {}
        }
        if let Some(at) = response.hover_pos() {
            let (wheel, pinch) = ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
            let factor = (f64::from(wheel) * 0.003).exp() * f64::from(pinch);
            if (factor - 1.0).abs() > 1e-6 {
                self.view.zoom(pane, at, factor);
            }
        }
    }

    fn under(&self, document: &Document, pane: Rect, at: Pos2) -> Under {
        let table = self.view.table_from_screen(pane, at);
        let reach = REACH / self.view.scale;
        Under {
            mark: mark_at(document, table, reach),
            piece: self.shapes.at(&document.pattern, table).map(|(id, _)| id),
            seam: self.threads.near(&document.pattern, table, reach / 2.0),
        }
    }

    fn listen(
        &mut self,
        ui: &egui::Ui,
        laid: &Laid<'_>,
        pane: Rect,
        response: &Response,
        under: Under,
        asks: &mut Asks,
    ) {
        let Laid { document, tool, .. } = *laid;
        let (space, erasing) =
            ui.input(|i| (i.key_down(Key::Space), tool == Tool::Erase || i.modifiers.command));
        let held = ui.input(|i| i.modifiers);
        let of_tool = !space && laid.mouse.deed(PointerButton::Primary, held) == Some(Deed::Tool);
        for at in clicks(ui, response, PointerButton::Primary).into_iter().filter(|_| of_tool) {
            let mark = self.under(document, pane, at).mark;
            match (mark, tool) {
                (Some(mark), _) if erasing => asks.push(Ask::Do(Command::DeleteMark { mark })),
                (Some(_), Tool::Mark | Tool::Move) => asks.push(Ask::Select(mark)),
                (None, Tool::Move) => asks.push(Ask::Select(None)),
                (None, Tool::Mark) if !erasing => self.dot(laid, pane, at, asks),
                _ => {}
            }
        }
        if tool == Tool::Move
            && response.double_clicked()
            && let Some(piece) = under.piece
        {
            asks.extend(self.turned_over(&document.pattern, piece).map(Ask::Do));
        }
        if response.drag_started_by(PointerButton::Primary) && of_tool && !erasing {
            self.start_drag(ui, laid, pane);
        }
        if self.drag.is_some() {
            self.go_on(ui, laid, pane, asks);
            let lost = ui.input(|i| {
                i.events.contains(&Event::WindowFocused(false)) || i.events.contains(&Event::PointerGone)
            });
            if ui.input(|i| i.key_pressed(Key::Escape)) {
                self.cancel(asks);
            } else if !ui.input(|i| i.pointer.primary_down()) || lost {
                self.finish(document, asks);
            }
        }
    }

    fn dot(&self, laid: &Laid<'_>, pane: Rect, at: Pos2, asks: &mut Asks) {
        let pattern = &laid.document.pattern;
        let table = self.view.table_from_screen(pane, at);
        let hit = self.shapes.all_at(pattern, table).take(if laid.laser { usize::MAX } else { 1 });
        let dots: Vec<_> = hit.map(|(piece, p)| (piece, vec![p])).collect();
        match dots.is_empty() {
            false => in_one_step(self.painted(pattern, dots), asks),
            true if pattern.pieces.is_empty() => {}
            true => asks.push(Ask::Say("Marks are painted on the pieces: press on one of them.".to_owned())),
        }
    }

    fn start_drag(&mut self, ui: &egui::Ui, laid: &Laid<'_>, pane: Rect) {
        let Laid { document, tool, laser, .. } = *laid;
        let Some(origin) = ui.input(|i| i.pointer.press_origin()) else { return };
        let table = self.view.table_from_screen(pane, origin);
        let Some((piece, p)) = self.shapes.at(&document.pattern, table) else { return };
        self.drag = match tool {
            Tool::Mark => {
                let mut strokes = vec![(piece, vec![p])];
                go_through(&mut strokes, &self.shapes, &document.pattern, table, laser);
                Some(Drag::Paint(strokes))
            }
            Tool::Move => document.pattern.pieces.get(&piece).map(|found| Drag::Piece {
                piece,
                held: table,
                pose: found.pose,
            }),
            Tool::Erase | Tool::Drag(_) | Tool::Pin => None,
        };
    }

    /// Follows the pointer through every place it was in since the last frame.
    fn go_on(&mut self, ui: &egui::Ui, laid: &Laid<'_>, pane: Rect, asks: &mut Asks) {
        let trail: Vec<Pos2> = ui.input(|i| {
            let moved = i.events.iter().filter_map(|e| match e {
                Event::PointerMoved(p) => Some(*p),
                _ => None,
            });
            moved.collect()
        });
        match &mut self.drag {
            Some(Drag::Paint(strokes)) => {
                let pattern = &laid.document.pattern;
                for at in trail {
                    let table = self.view.table_from_screen(pane, at);
                    go_through(strokes, &self.shapes, pattern, table, laid.laser);
                }
            }
            Some(Drag::Piece { piece, held, pose }) => {
                if let Some(&at) = trail.last() {
                    let moved = self.view.table_from_screen(pane, at) - *held;
                    let pose = PlanePose { offset: pose.offset + moved, ..*pose };
                    asks.push(Ask::Drag(Command::SetPiecePose { piece: *piece, pose }));
                }
            }
            Some(Drag::Over) | None => {}
        }
    }

    fn finish(&mut self, document: &Document, asks: &mut Asks) {
        match self.drag.take() {
            Some(Drag::Paint(mut strokes)) => {
                for (_, points) in &mut strokes {
                    *points = stroke::finished(points);
                }
                in_one_step(self.painted(&document.pattern, strokes), asks);
            }
            Some(Drag::Piece { .. }) => asks.push(Ask::EndDrag),
            Some(Drag::Over) | None => {}
        }
    }

    fn cancel(&mut self, asks: &mut Asks) {
        if matches!(self.drag, Some(Drag::Piece { .. })) {
            asks.push(Ask::CancelDrag);
        }
        self.drag = Some(Drag::Over);
    }

    /// The commands that paint `strokes`: the first on the side that is seen, the others on the outer side of their
    /// pieces, however they lie: nobody means to turn half a garment inside out.
    fn painted(&self, pattern: &Pattern, strokes: Vec<(PieceId, Vec<DVec2>)>) -> Vec<Command> {
        let seen = |piece: PieceId| Some(front_is_seen(pattern.pieces.get(&piece)?, self.shapes.of(piece)?));
        let command = |(i, (piece, points)): (usize, (PieceId, Vec<DVec2>))| {
            let front = seen(piece)? || i > 0;
            let side = if front { ClothSide::Front } else { ClothSide::Back };
            Some(Command::AddClothMark { piece, side, points })
        };
        strokes.into_iter().enumerate().filter_map(command).collect()
    }

    /// Mirrors a piece about the upright line through its middle.
    fn turned_over(&self, pattern: &Pattern, id: PieceId) -> Option<Command> {
        let (piece, shape) = (pattern.pieces.get(&id)?, self.shapes.of(id)?);
        let middle = piece.pose.plane_from_piece(shape.middle);
        let turned =
            PlanePose { offset: DVec2::ZERO, rotation: -piece.pose.rotation, flipped: !piece.pose.flipped };
        let offset = middle - turned.plane_from_piece(shape.middle);
        Some(Command::SetPiecePose { piece: id, pose: PlanePose { offset, ..turned } })
    }

    fn set_cursor(&self, ui: &egui::Ui, tool: Tool, under: Under, response: &Response) {
        if !response.contains_pointer() {
            return;
        }
        let erasing = tool == Tool::Erase || ui.input(|i| i.modifiers.command);
        ui.ctx().set_cursor_icon(match (tool, &self.drag) {
            (_, Some(Drag::Piece { .. })) => CursorIcon::Grabbing,
            _ if erasing && under.mark.is_some() => CursorIcon::PointingHand,
            (Tool::Move, _) if under.piece.is_some() => CursorIcon::Grab,
            (Tool::Mark, _) if under.piece.is_some() || self.drag.is_some() => CursorIcon::Crosshair,
            _ => CursorIcon::Default,
        });
    }

    fn draw(&self, ui: &egui::Ui, laid: &Laid<'_>, pane: Rect, under: Under) {
        let Laid { document, palette, selected, .. } = *laid;
        let pattern = &*document.pattern;
        let drawing = Drawing { painter: ui.painter_at(pane), pane, view: &self.view, palette };
        drawing.table();
        drawing.pieces(pattern, &self.shapes, under.piece);
        drawing.seams(pattern, &self.threads, under.seam);
        drawing.marks(pattern, &document.marks, under.mark, selected);
        if let Some(ghosts) = laid.ghosts {
            drawing.ghosts(pattern, ghosts);
        }
        if let Some((id, points)) = self.stroke()
            && let Some(piece) = pattern.pieces.get(&id)
        {
            let points: Vec<DVec2> = points.iter().map(|&p| piece.pose.plane_from_piece(p)).collect();
            let number = document.marks.cloth.len() + 1;
            let paired = number <= document.marks.body.len();
            drawing.mark(&points, number, MarkLook { paired, ..MarkLook::default() });
        }
        drawing.names(pattern, &self.shapes);
        drawing.scale_bar();
    }
}

/// Takes the strokes on to a point of the table. Off the first piece nothing is painted; with the laser every piece below
/// gets its own stroke as soon as the pointer is over it.
fn go_through(
    strokes: &mut Vec<(PieceId, Vec<DVec2>)>,
    shapes: &Shapes,
    pattern: &Pattern,
    table: DVec2,
    laser: bool,
) {
    let Some(&(first, _)) = strokes.first() else { return };
    let below = shapes.all_at(pattern, table).skip_while(|(piece, _)| *piece != first);
    for (piece, p) in below.take(if laser { usize::MAX } else { 1 }) {
        match strokes.iter_mut().find(|(painted, _)| *painted == piece) {
            Some((_, points)) if points.last().is_none_or(|l| l.distance(p) > 1e-4) => points.push(p),
            Some(_) => {}
            None => strokes.push((piece, vec![p])),
        }
    }
}

/// What the pointer does here, for the status bar.
pub fn hint(tool: Tool, mouse: Mouse, laser: bool, next: usize) -> String {
    let view = format!("{} · F: show all", mouse.table_hint());
    match tool {
        Tool::Mark if laser => {
            format!("Drag: paint marks {next}… on every piece that lies here · L: only the topmost · {view}")
        }
        Tool::Mark => {
            format!(
                "Drag: paint mark {next} on the cloth · Click: a dot, or select a mark · Ctrl+click: erase · {view}"
            )
        }
        Tool::Erase => format!("Click a mark: take it away · {view}"),
        Tool::Drag(_) | Tool::Pin => format!("The cloth is dragged and pinned on the body · {view}"),
        Tool::Move => format!("Drag a piece: move it · Double-click: turn it over · {view}"),
    }
}

fn mark_at(document: &Document, table: DVec2, reach: f64) -> Option<MarkId> {
    let distance = |mark: &crate::wrap::ClothMark| {
        let pose = document.pattern.pieces.get(&mark.piece)?.pose;
        let points: Vec<DVec2> = mark.points.iter().map(|&p| pose.plane_from_piece(p)).collect();
        Some((mark.id, to_polyline(table, &points)))
    };
    document
        .marks
        .cloth
        .iter()
        .filter_map(distance)
        .filter(|(_, d)| *d <= reach)
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(id, _)| id)
}

/// Tells screen readers and tests where each mark is.
fn publish_marks(
    ui: &egui::Ui,
    document: &Document,
    marks: &Marks,
    what: &str,
    pane: Rect,
    view: &TableView,
) {
    for (i, mark) in marks.cloth.iter().enumerate() {
        if let (Some(piece), Some(&first)) = (document.pattern.pieces.get(&mark.piece), mark.points.first()) {
            let at = view.screen_from_table(pane, piece.pose.plane_from_piece(first));
            let rect = Rect::from_center_size(at, egui::vec2(12.0, 12.0));
            let node = ui.interact(rect, ui.scope_id().with((what, "on the cloth", i)), Sense::hover());
            node.widget_info(|| {
                WidgetInfo::labeled(Role::Label, true, format!("{what} {} on the cloth", i + 1))
            });
        }
    }
}

/// What to offer when the table is empty.
pub fn empty_ui(ui: &mut egui::Ui, asks: &mut Asks) {
    ui.vertical_centered(|ui| {
        ui.heading("An empty table");
        ui.label("Open a sample, or bring a pattern of your own.");
        ui.add_space(6.0);
        if ui.button("Open the T-shirt").clicked() {
            asks.push(Ask::Act(Action::Sample(Sample::Tshirt)));
        }
        if ui.button(Action::ImportPattern.entry().text).clicked() {
            asks.push(Ask::Act(Action::ImportPattern));
        }
    });
}
