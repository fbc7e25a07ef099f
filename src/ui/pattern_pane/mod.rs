//! The pattern pane: flat pieces on a table, which pointer and keys draw, sew, paint and move.

mod draw;
mod draw_nests;
mod draw_pieces;
mod draw_trims;
pub(in crate::ui) mod edits;
mod entry;
mod guides;
mod input;
pub(in crate::ui) mod kept;
mod labels;
pub mod line_points;
mod names;
pub(in crate::ui) mod nests;
mod options;
mod pictures;
mod rulers;
pub mod shapes;
pub(in crate::ui) mod snap;
mod strip;
mod table;
pub mod threads;
pub mod tools;
pub mod view;

use egui::accesskit::Role;
use egui::{Event, EventFilter, Key, PointerButton, Rect, Response, Sense, Stroke, WidgetInfo};
use glam::DVec2;

use crate::geometry::ids::MarkId;
use crate::session::Document;
use crate::session::samples::Sample;
use crate::sim::ClothPlace;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::actions::{Action, Tool};
use crate::ui::language::{say, tr};
use crate::ui::look::theme::Palette;
use crate::ui::maps::{ShownMap, probe_ui};
use crate::ui::pointer::mouse::{Mouse, PointerAction};
use crate::ui::preferences::units::LengthUnit;
use crate::ui::selection::{Item, Selection};
use crate::wrap::Marks;
use draw::Drawing;
pub use draw::PLACE_HEIGHT;
use draw_trims::Rows;
use entry::Entry;
use guides::Guides;
use input::Input;
pub use kept::Options;
use labels::Labels;
pub use names::seam_words;
use nests::{Nests, SizeView};
use pictures::Pictures;
use rulers::Rulers;
use shapes::Shapes;
use table::{Guide, Table};
use threads::Threads;
use tools::{PatternTool, handler};
use view::TableView;

/// Frames after the whole pattern was fitted in which it is fitted again where the pane changes.
const FRAMES_OF_CHANGE: u8 = 2;
/// Logarithm of the zoom factor per point of pointer motion.
const ZOOM: f64 = 0.008;
/// Step of the keyboard's cursor, in steps of an arrow key.
const CURSOR_STEPS: f64 = 10.0;

/// What to frame in the next frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fit {
    All,
    Selection,
    /// The selected pieces, where the middle of one is out of view.
    Added,
    TrueSize,
}

/// State of the pane: the view of the table, and the tool in use.
#[derive(Debug, Default)]
pub struct PatternPane {
    /// The part of the table that is visible.
    pub view: TableView,
    /// Whether to show the whole pattern in the next frame.
    pub fit: bool,
    /// The pane for which the whole pattern was fitted, while it may still change: the size of text acts a frame after it is set.
    fitted: Option<(Rect, u8)>,
    /// What to frame in the next frame.
    pub show: Option<Fit>,
    /// Whether the pointer was over the pane in the last frame.
    pub hovered: bool,
    /// Area of the pane on the screen in the last frame.
    pub area: Option<Rect>,
    /// Areas of the strip of tools and of the bar with options of the tool in the last frame.
    pub bars: [Option<Rect>; 2],
    /// Id of the pane's widget, for the keyboard focus.
    pub id: Option<egui::Id>,
    /// Response of the pane in this frame, for the context menu.
    pub response: Option<Response>,
    /// Item under the pointer in the last frame.
    pub under: Option<Item>,
    /// Value of the map under the pointer in the last frame.
    pub value: Option<f64>,
    /// Options of the tools.
    pub options: Options,
    guides: Guides,
    shapes: Shapes,
    threads: Threads,
    rows: Rows,
    pictures: Pictures,
    /// The pattern in all its sizes.
    pub nests: Nests,
    tool: Option<(Tool, Box<dyn PatternTool>)>,
    entry: Option<Entry>,
    /// The keyboard's cursor, in metres on the table.
    cursor: Option<DVec2>,
    /// Whether a drag was cancelled while the button is still down.
    over: bool,
}

/// The state that the pane shows, and the options of the pointer.
#[derive(Clone, Copy)]
pub struct Laid<'a> {
    /// The document.
    pub document: &'a Document,
    /// The chosen tool, which the left button uses.
    pub tool: Tool,
    /// The mapping of mouse buttons.
    pub mouse: Mouse,
    /// Laser mode: strokes go through to the pieces below.
    pub laser: bool,
    /// The emphasised mark.
    pub selected: Option<MarkId>,
    /// The selection in the pattern.
    pub selection: &'a Selection,
    /// The item under the pointer, in this pane or the other.
    pub highlight: Option<Item>,
    /// The place marked by a ring.
    pub spot: Option<ClothPlace>,
    /// Screen points per metre at true size.
    pub points_per_metre: f64,
    /// Unit in which lengths are shown.
    pub unit: LengthUnit,
    /// Which sizes are shown.
    pub sizes: SizeView,
    /// Whether the pointer snaps to points, edges, guides and the grid.
    pub snapping: bool,
    /// Proposed marks that are not accepted yet.
    pub ghosts: Option<&'a Marks>,
    /// The map that pieces are coloured by; None: their own colours.
    pub map: Option<&'a ShownMap>,
    /// Colours.
    pub palette: &'a Palette,
}

impl PatternPane {
    /// A pane that shows the whole pattern in its first frame.
    pub fn fitted() -> Self {
        Self { fit: true, ..Self::default() }
    }

    /// Draws the pane and handles pointer and keys.
    pub fn ui(&mut self, ui: &mut egui::Ui, laid: &Laid<'_>, asks: &mut Asks) {
        let pattern = &*laid.document.pattern;
        self.shapes.update(pattern);
        self.threads.update(pattern, &self.shapes);
        self.rows.update(&laid.document.pattern);
        self.pictures.update(ui.ctx(), laid.document);
        let whole = ui.available_rect_before_wrap();
        ui.allocate_rect(whole, Sense::hover());
        let (strip, rest) = strip::beside(whole);
        strip::strip_ui(ui, strip, laid, asks);
        let (rulers, pane) = Rulers::around(rest);
        let id = ui.scope_id().with("table");
        let response = ui.interact(pane, id, Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, tr("Pattern pane")));
        self.hovered = response.contains_pointer();
        (self.area, self.id) = (Some(pane), Some(id));
        self.fit_if_asked(laid, pane);
        self.move_view(ui, laid.mouse, pane, &response);
        let mut tool = self.in_hand(laid.tool, asks);
        let mut input = self.input(ui, laid, pane, &response, &mut *tool, asks);
        let free = laid.tool == Tool::Move && self.is_bare(laid, pane, &input);
        let mut guides = std::mem::take(&mut self.guides);
        let escape = ui.input(|i| i.key_pressed(Key::Escape));
        guides.step(&self.view, pane, free, &mut input, escape, |p| self.table(laid, pane).rounded(p));
        self.guides = guides;
        let table = self.table(laid, pane);
        tool.step(&table, &input, asks);
        if tool.is_dragging() && ui.input(|i| i.key_pressed(Key::Escape)) {
            tool.give_up(asks);
        }
        let at = input.hover.filter(|_| response.contains_pointer() || self.cursor.is_some());
        let under = at.filter(|_| !tool.is_dragging()).and_then(|at| tool.under(&table, table.at(at)));
        if let Some(at) = response.hover_pos() {
            let icon = self.guides.cursor().unwrap_or_else(|| tool.cursor(&table, table.at(at)));
            ui.ctx().set_cursor_icon(icon);
        }
        let drawing =
            Drawing { painter: ui.painter_at(pane), pane, view: &table.view, palette: laid.palette };
        draw_table(&drawing, &table, self.guides.new.as_ref(), at);
        tool.draw(&drawing, &table, &input);
        // A right click selects the item under the pointer, which its menu is about.
        if response.secondary_clicked()
            && let Some(item) = under.filter(|item| !laid.selection.has(*item))
        {
            asks.push(Ask::Pick(Selection::of(item)));
        }
        if let Some(p) = self.cursor {
            drawing.cross(p);
        }
        if let Some(at) = at {
            drawing.place_told(table.at(at), laid.unit);
        }
        let value = at.and_then(|at| {
            let (map, (piece, p)) = (laid.map?, table.piece_at(table.at(at))?);
            let value = map.value_on(piece, p);
            probe_ui(ui, pane, at, map, value, "", laid.palette);
            value
        });
        if response.has_focus() {
            let ring = Stroke::new(1.5, laid.palette.accent);
            drawing.painter.rect_stroke(pane, 0.0, ring, egui::StrokeKind::Inside);
        }
        names::publish(ui, &table);
        let by_keys = response.has_focus().then(|| tool.selected_by_keys(&table).or(laid.selection.only()));
        if let Some(item) = by_keys.flatten() {
            names::announce(ui, &table, item);
        }
        let mut options = self.options;
        let options_bar = options::options_ui(ui, &table, &mut options, asks);
        let dragged = rulers.ui(ui, &table.view, pane, laid.unit, laid.palette, at);
        self.take_entry(ui, laid, pane, &mut *tool, asks);
        (self.response, self.options, self.bars) = (Some(response), options, [Some(strip), options_bar]);
        (self.under, self.tool, self.value) = (under, Some((laid.tool, tool)), value);
        self.guides.take(&self.view, pane, dragged);
    }

    /// Whether a mark is being painted or something else is in progress that Esc cancels.
    pub fn is_busy(&self) -> bool {
        self.entry.is_some() || self.tool.as_ref().is_some_and(|(_, tool)| tool.is_busy())
    }

    /// Whether typed digits go to the tool and are no shortcuts.
    pub fn takes_numbers(&self) -> bool {
        self.tool.as_ref().is_some_and(|(_, tool)| tool.takes_numbers())
    }

    /// Whether the pane has the keyboard focus.
    pub fn has_focus(&self, ctx: &egui::Context) -> bool {
        self.id.is_some() && ctx.memory(|m| m.focused()) == self.id
    }

    /// Removes all guides.
    pub fn clear_guides(&mut self) {
        self.guides.all.clear();
    }

    /// Whether some seam is twisted: it joins the front of one piece to the back of another.
    pub fn has_twisted(&self) -> bool {
        self.threads.twisted().next().is_some()
    }

    /// The hint of the pane for the status bar.
    pub fn hint(&self, laid: &Laid<'_>) -> String {
        let view = say!("{view} · F: show all", view = laid.mouse.table_hint());
        if self.guides.cursor().is_some() {
            return say!("Drag the guide; back to its ruler: take it away · {view}", view);
        }
        match (&self.tool, self.area) {
            (Some((_, tool)), Some(pane)) => format!("{} · {view}", tool.hint(&self.table(laid, pane))),
            _ => view,
        }
    }

    /// The hint of the pane for the status bar while it has the keyboard and not the pointer; None: that of the pointer.
    pub fn hint_by_keys(&self, ctx: &egui::Context) -> Option<&'static str> {
        let is_by_keys = self.has_focus(ctx) && !self.hovered && !self.is_busy();
        self.tool.as_ref().filter(|_| is_by_keys).and_then(|(_, tool)| tool.hint_by_keys())
    }

    fn table<'a>(&'a self, laid: &'a Laid<'a>, pane: Rect) -> Table<'a> {
        let (view, options) = (self.view, self.options);
        Table {
            laid,
            shapes: &self.shapes,
            threads: &self.threads,
            rows: &self.rows.all,
            pictures: &self.pictures,
            nests: &self.nests,
            guides: &self.guides.all,
            view,
            pane,
            options,
        }
    }

    /// The handler of the chosen tool; when the tool changes, the old one cancels what is in progress.
    fn in_hand(&mut self, chosen: Tool, asks: &mut Asks) -> Box<dyn PatternTool> {
        match self.tool.take() {
            Some((tool, machine)) if tool == chosen => machine,
            before => {
                if let Some((_, mut tool)) = before {
                    tool.give_up(asks);
                }
                (self.entry, self.cursor) = (None, None);
                handler(chosen)
            }
        }
    }

    fn fit_if_asked(&mut self, laid: &Laid<'_>, pane: Rect) {
        let pattern = &*laid.document.pattern;
        if std::mem::take(&mut self.fit) {
            self.fitted = Some((Rect::NOTHING, FRAMES_OF_CHANGE));
        }
        let is_due = self.fitted.is_some_and(|(fitted, _)| fitted != pane);
        self.fitted = self.fitted.and_then(|(_, left)| Some((pane, left.checked_sub(1)?)));
        let show = self.show.take().or(is_due.then_some(Fit::All));
        match show {
            Some(Fit::Added) if !is_due => self.reveal_selected(laid, pane),
            Some(Fit::All | Fit::Added) => self.view.fit(pane, pattern),
            Some(Fit::Selection) => {
                let touched = laid.selection.pieces_touched();
                match self.table(laid, pane).bounds(touched.into_iter()) {
                    Some(bounds) => self.view.fit_box(pane, bounds),
                    None => self.view.fit(pane, pattern),
                }
            }
            Some(Fit::TrueSize) => self.view.true_size(laid.points_per_metre),
            None => {}
        }
    }

    /// Brings all selected pieces into view where the middle of one is out of it. A piece that is drawn half in view does not move it.
    fn reveal_selected(&mut self, laid: &Laid<'_>, pane: Rect) {
        let pieces = laid.selection.pieces_touched();
        let table = self.table(laid, pane);
        let is_out = |id| {
            let middle = table.bounds(std::iter::once(id)).map(|[lower, upper]| lower.midpoint(upper));
            middle.is_some_and(|p| !pane.contains(self.view.screen_from_table(pane, p)))
        };
        let is_any_out = pieces.iter().any(|&id| is_out(id));
        if let Some(bounds) = table.bounds(pieces.into_iter()).filter(|_| is_any_out) {
            self.view.reveal(pane, bounds);
        }
    }

    fn move_view(&mut self, ui: &egui::Ui, mouse: Mouse, pane: Rect, response: &Response) {
        let busy = self.tool.as_ref().is_some_and(|(_, tool)| tool.is_dragging());
        let space = ui.input(|i| i.key_down(Key::Space)) && !busy;
        let held = ui.input(|i| i.modifiers);
        let buttons = [PointerButton::Primary, PointerButton::Secondary, PointerButton::Middle];
        let pressed = buttons.into_iter().find(|&button| response.dragged_by(button));
        let moved = response.drag_delta();
        match pressed.and_then(|button| mouse.deed(button, held)) {
            _ if space && pressed == Some(PointerButton::Primary) => self.view.pan(moved),
            Some(PointerAction::Pan | PointerAction::Turn | PointerAction::HandOrTurn) if !busy => {
                self.view.pan(moved)
            }
            Some(PointerAction::Zoom) => {
                self.view.zoom(pane, pane.center(), (f64::from(-moved.y) * ZOOM).exp())
            }
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

    /// The input for the tool. Keys belong to the pane while it has the focus, or while nothing has it and the pointer is over
    /// the pane.
    fn input(
        &mut self,
        ui: &egui::Ui,
        laid: &Laid<'_>,
        pane: Rect,
        response: &Response,
        tool: &mut dyn PatternTool,
        asks: &mut Asks,
    ) -> Input {
        if self.entry.is_some() {
            return Input { hover: response.hover_pos(), ..Input::default() };
        }
        if self.over {
            self.over = ui.input(|i| i.pointer.primary_down());
            return Input { hover: response.hover_pos(), ..Input::default() };
        }
        let mut input =
            Input::of_pointer(ui, response, laid.mouse, tool.is_dragging() || self.guides.is_held());
        if !input.clicks.is_empty() || input.pressed.is_some() {
            response.request_focus();
        }
        let nothing_else = ui.ctx().memory(|m| m.focused()).is_none();
        if response.has_focus() || (nothing_else && self.hovered) {
            input.read_keys(ui);
            self.escape(ui, laid, tool, asks);
        }
        if response.has_focus() {
            let filter =
                EventFilter { tab: true, horizontal_arrows: true, vertical_arrows: true, escape: true };
            ui.ctx().memory_mut(|m| m.set_focus_lock_filter(response.id, filter));
            let held = input.held;
            let tabs = ui.input(|i| i.num_presses(Key::Tab) as i32);
            input.next = if held.shift { -tabs } else { tabs };
            let pressed = |key| i32::from(ui.input(|i| i.key_pressed(key)));
            input.next_kind = pressed(Key::PageDown) - pressed(Key::PageUp);
            input.keeps = !tool.draws() && held.is_none() && pressed(Key::Space) > 0;
        }
        self.move_cursor(ui, response, pane, tool, &mut input);
        input
    }

    /// Esc cancels what is in progress; then it clears the selection; then leaves the tool; then gives up the keyboard focus.
    fn escape(&mut self, ui: &egui::Ui, laid: &Laid<'_>, tool: &mut dyn PatternTool, asks: &mut Asks) {
        if !ui.input(|i| i.key_pressed(Key::Escape)) {
            return;
        }
        let painting = matches!(
            laid.tool,
            Tool::Mark
                | Tool::Erase
                | Tool::Move
                | Tool::Drag(_)
                | Tool::Pin
                | Tool::ClothLine
                | Tool::Bone
                | Tool::Place
        );
        if tool.is_busy() {
            self.over = tool.is_dragging();
            tool.give_up(asks);
        } else if !laid.selection.is_empty() {
            asks.push(Ask::Pick(Selection::default()));
        } else if !painting {
            asks.push(Ask::Act(Action::Choose(Tool::Move)));
        } else if let Some(id) = self.id {
            ui.ctx().memory_mut(|m| m.surrender_focus(id));
        }
    }

    /// While a tool draws, arrow keys move a cursor and Space clicks there. A movement of the pointer ends its use.
    fn move_cursor(
        &mut self,
        ui: &egui::Ui,
        response: &Response,
        pane: Rect,
        tool: &dyn PatternTool,
        input: &mut Input,
    ) {
        if ui.input(|i| i.pointer.is_moving()) || !tool.draws() || !response.has_focus() {
            self.cursor = None;
        }
        if !tool.draws() || !response.has_focus() {
            return;
        }
        if input.nudge != DVec2::ZERO {
            let middle = || ((self.view.centre / 0.01).round()) * 0.01;
            let from = self.cursor.unwrap_or_else(middle);
            self.cursor = Some(from + input.nudge * CURSOR_STEPS);
            input.nudge = DVec2::ZERO;
        }
        if let Some(p) = self.cursor {
            let at = self.view.screen_from_table(pane, p);
            input.hover = Some(at);
            input.held.shift = false;
            if ui.input(|i| i.key_pressed(Key::Space)) {
                input.clicks.push(at);
                input.by_keys = true;
            }
        }
    }

    /// A typed digit opens a small text field; the entered text goes to the tool.
    fn take_entry(
        &mut self,
        ui: &mut egui::Ui,
        laid: &Laid<'_>,
        pane: Rect,
        tool: &mut dyn PatternTool,
        asks: &mut Asks,
    ) {
        let active = self.hovered || self.has_focus(ui.ctx()) || tool.is_dragging();
        if self.entry.is_none() && active && tool.takes_numbers() && !ui.ctx().text_edit_focused() {
            let at = ui.input(|i| i.pointer.hover_pos()).filter(|at| pane.contains(*at));
            self.entry = Entry::opened(ui, at.unwrap_or(pane.center()));
        }
        let Some(mut entry) = self.entry.take() else { return };
        let table = self.table(laid, pane);
        let stays = entry.ui(ui, laid, |typed| tool.typed(&table, typed, asks));
        if stays {
            self.entry = Some(entry);
        } else {
            // The next digit is typed to the pane as well.
            let id = self.id.unwrap_or(egui::Id::NULL);
            ui.ctx().memory_mut(|m| m.request_focus(id));
        }
    }

    /// Whether only the empty table is under the pointer.
    fn is_bare(&self, laid: &Laid<'_>, pane: Rect, input: &Input) -> bool {
        let table = self.table(laid, pane);
        input.pressed.or(input.hover).map(|at| table.at(at)).is_some_and(|p| {
            table.piece_at(p).is_none() && table.edge_at(p).is_none() && table.thread_at(p).is_none()
        })
    }
}

fn draw_table(drawing: &Drawing<'_>, table: &Table<'_>, new_guide: Option<&Guide>, at: Option<egui::Pos2>) {
    let Laid { document, selected, ghosts, tool, .. } = *table.laid;
    let pattern = &*document.pattern;
    drawing.table(table.laid.unit);
    drawing.threads_below(table);
    drawing.pieces(table);
    drawing.nests(table);
    drawing.seams(table);
    let numbers = drawing.numbers(pattern, &document.marks);
    let mut labels = Labels::beside(numbers);
    let names = drawing.placed_names(table, &mut labels);
    drawing.trims(table, &mut labels);
    drawing.edges_standing_out(table);
    drawing.spot(table);
    let near = at.and_then(|at| table.mark_at(table.at(at)));
    drawing.marks(pattern, &document.marks, near, selected);
    if let Some(ghosts) = ghosts {
        drawing.ghosts(pattern, ghosts);
    }
    drawing.names(names);
    if tool == Tool::Sew {
        drawing.badges(table);
    }
    drawing.guides(table.guides.iter().chain(new_guide));
}

/// The text that was typed, if it begins a number.
fn begins_number(event: &Event) -> Option<String> {
    match event {
        Event::Text(text) if text.starts_with(|c: char| c.is_ascii_digit() || "@.(-".contains(c)) => {
            Some(text.clone())
        }
        _ => None,
    }
}

/// Draws suggestions for an empty table.
pub fn empty_ui(ui: &mut egui::Ui, asks: &mut Asks) {
    ui.vertical_centered(|ui| {
        ui.heading(tr("An empty table"));
        ui.label(tr("Draw a piece, open a sample, or bring a pattern of your own."));
        ui.add_space(6.0);
        if ui.button(tr("Draw a rectangle")).clicked() {
            asks.push(Ask::Act(Action::Choose(Tool::Rectangle)));
        }
        if ui.button(tr("Open the T-shirt")).clicked() {
            asks.push(Ask::Act(Action::Sample(Sample::Tshirt)));
        }
        if ui.button(tr(Action::ImportPattern.row().text)).clicked() {
            asks.push(Ask::Act(Action::ImportPattern));
        }
    });
}
