//! The section of marks: the pairs with their stretch; name and number of the selected mark.

use std::sync::Arc;

use egui::accesskit::Role;
use egui::{Align, Button, Layout, RichText, TextEdit, WidgetInfo};

use crate::body::Surface;
use crate::geometry::ids::MarkId;
use crate::render::mark_colour;
use crate::session::Command;
use crate::ui::actions::Action;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::fields::drag_value;
use crate::ui::language::keys::shortcut_text;
use crate::ui::language::{self, counted, say, signed, tr};
use crate::ui::look::theme::colour;
use crate::ui::panels::context::PanelContext;
use crate::wrap::{MarkPlace, Marks, PairStretch, stretches};

/// State of the section between frames.
#[derive(Debug, Default)]
pub struct MarksPanel {
    lengths: Option<Lengths>,
    /// The name being typed, and its mark.
    typed: Option<(MarkId, String)>,
}

/// Cache of the lengths of the pairs.
#[derive(Debug)]
struct Lengths {
    marks: Arc<Marks>,
    surface: Arc<Surface>,
    offset: f64,
    pairs: Vec<PairStretch>,
}

impl MarksPanel {
    /// Draws the section.
    pub fn ui(&mut self, ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
        if told.now.proposed > 0 {
            proposal_ui(ui, told, asks);
        }
        let [cloth, body] = told.now.marks;
        if cloth + body == 0 {
            let words = tr(
                "Paint a mark on a piece, then one on the body where it should lie. Marks with the same number meet.",
            );
            ui.add(egui::Label::new(RichText::new(words).color(told.palette.weak)).wrap());
            return;
        }
        self.measure(told);
        for number in 1..=cloth.max(body) {
            let pairs = self.lengths.iter().flat_map(|l| &l.pairs);
            let pair = pairs.copied().find(|pair| pair.number == number);
            pair_row(ui, told, number, pair, asks);
        }
        match told.now.selected {
            Some((mark, place)) => self.selected_ui(ui, told, mark, place, asks),
            None => self.typed = None,
        }
        ui.add_space(2.0);
        if ui.small_button(tr(Action::ClearMarks.row().text)).clicked() {
            asks.push(Ask::Act(Action::ClearMarks));
        }
    }

    /// Measures the lengths again if something has changed.
    fn measure(&mut self, told: &PanelContext<'_>) {
        let Some(surface) = told.surface else {
            self.lengths = None;
            return;
        };
        let marks = &told.document.marks;
        let offset = told.document.settings.relax.offset * surface.scale();
        let known = self.lengths.as_ref().is_some_and(|l| {
            Arc::ptr_eq(&l.marks, marks) && Arc::ptr_eq(&l.surface, surface) && l.offset == offset
        });
        if !known {
            let pairs = stretches(marks, surface, offset);
            self.lengths =
                Some(Lengths { marks: Arc::clone(marks), surface: Arc::clone(surface), offset, pairs });
        }
    }

    fn selected_ui(
        &mut self,
        ui: &mut egui::Ui,
        told: &PanelContext<'_>,
        mark: MarkId,
        place: MarkPlace,
        asks: &mut Asks,
    ) {
        ui.separator();
        ui.horizontal(|ui| {
            let words = match place.on_cloth {
                true => say!("Selected: mark {number} on the cloth", number = place.number),
                false => say!("Selected: mark {number} on the body", number = place.number),
            };
            ui.label(RichText::new(words).strong());
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                action_ui(ui, told, Action::DeleteMark, tr("Delete"), asks);
            });
        });
        if let Some(landmark) = told.document.marks.landmark(mark) {
            let words = say!("near {place}", place = tr(&landmark.replace('_', " ")));
            ui.label(RichText::new(words).color(told.palette.weak).size(12.5));
        }
        ui.horizontal(|ui| {
            let label = ui.label(RichText::new(tr("Name")).color(told.palette.weak));
            self.name_ui(ui, told, mark, asks, label.id);
        });
        ui.horizontal(|ui| {
            let label = ui.label(RichText::new(tr("Number")).color(told.palette.weak));
            let mut to = place.number;
            let value = ui.add(drag_value(&mut to).range(1..=place.count).speed(0.05));
            let value = value.labelled_by(label.id);
            if to != place.number {
                asks.push(Ask::Drag(Command::MoveMark { mark, to }));
            }
            if value.drag_stopped() || (value.changed() && !value.dragged()) {
                asks.push(Ask::EndDrag);
            }
            for (action, text) in [(Action::RaiseMark, "Up"), (Action::LowerMark, "Down")] {
                action_ui(ui, told, action, tr(text), asks);
            }
        });
    }

    fn name_ui(
        &mut self,
        ui: &mut egui::Ui,
        told: &PanelContext<'_>,
        mark: MarkId,
        asks: &mut Asks,
        label: egui::Id,
    ) {
        let known = told.document.marks.name(mark);
        let (whose, text) = self.typed.get_or_insert_with(|| (mark, known.to_owned()));
        if *whose != mark {
            (*whose, *text) = (mark, known.to_owned());
        }
        let field = TextEdit::singleline(text).hint_text(tr("none")).desired_width(f32::INFINITY);
        let field = ui.add(field).labelled_by(label);
        if field.lost_focus() && text.trim() != known && !ui.input(|i| i.key_pressed(egui::Key::Escape)) {
            asks.push(Ask::Do(Command::RenameMark { mark, name: text.trim().to_owned() }));
        } else if !field.has_focus() && text != known {
            known.clone_into(text);
        }
    }
}

/// A small button for `action` with a label of its own.
fn action_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, action: Action, text: &str, asks: &mut Asks) {
    let why_not = told.now.why_not(action);
    let button = ui.add_enabled(why_not.is_none(), Button::new(text).small());
    name(&button, tr(action.row().text));
    let button = button.on_disabled_hover_text(why_not.unwrap_or_default());
    if button.on_hover_text(tr(action.row().tip)).clicked() {
        asks.push(Ask::Act(action));
    }
}

/// Draws the buttons for proposed marks.
fn proposal_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
    let count = told.now.proposed;
    let words = match told.now.marks {
        [0, 0] => counted(count, "1 pair of marks is proposed.", "{n} pairs of marks are proposed."),
        _ => counted(
            count,
            "1 pair of marks is proposed. They would take the place of those below.",
            "{n} pairs of marks are proposed. They would take the place of those below.",
        ),
    };
    ui.add(egui::Label::new(words).wrap());
    ui.horizontal(|ui| {
        for (action, fill) in [(Action::AcceptMarks, Some(told.palette.accent)), (Action::DismissMarks, None)]
        {
            let entry = action.row();
            let button = match fill {
                Some(fill) => {
                    Button::new(RichText::new(tr(entry.text)).color(told.palette.on_accent)).fill(fill)
                }
                None => Button::new(tr(entry.text)),
            };
            let keys = entry.keys.first().map(|k| shortcut_text(ui.ctx(), k)).unwrap_or_default();
            if ui.add(button).on_hover_text(format!("{}  ({keys})", tr(entry.tip))).clicked() {
                asks.push(Ask::Act(action));
            }
        }
    });
    ui.separator();
}

/// Draws the row of a pair: number, both strokes, stretch.
fn pair_row(
    ui: &mut egui::Ui,
    told: &PanelContext<'_>,
    number: usize,
    pair: Option<PairStretch>,
    asks: &mut Asks,
) {
    ui.horizontal(|ui| {
        let (dot, _) = ui.allocate_exact_size(egui::vec2(18.0, 18.0), egui::Sense::hover());
        let hue = colour(mark_colour(number));
        let [paper, ink] = told.palette.label(hue, egui::Color32::WHITE);
        ui.painter().circle(dot.center(), 7.5, paper, egui::Stroke::new(1.0, hue));
        let font = egui::FontId::proportional(11.5);
        ui.painter().text(dot.center(), egui::Align2::CENTER_CENTER, number, font, ink);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let close = ui.small_button("×").on_hover_text(say!("Take the marks {number} away", number));
            name(&close, &say!("Delete marks {number}", number));
            if close.clicked() {
                asks.push(Ask::Do(Command::DeletePair { number }));
            }
            if let Some(pair) = pair {
                stretch_ui(ui, told, &pair);
            }
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| strokes_ui(ui, told, number, asks));
        });
    });
}

fn stretch_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, pair: &PairStretch) {
    let PairStretch { number, cloth, body } = *pair;
    if cloth == 0.0 {
        ui.label(RichText::new(tr("point")).color(told.palette.weak).size(12.5));
        return;
    }
    let percent = format!("{} %", signed(pair.stretch() * 100.0, 1));
    let text = RichText::new(language::unbroken(&percent)).size(12.5);
    let ink = if pair.is_large() { told.palette.error } else { told.palette.weak };
    let text = if pair.is_large() { text.strong().color(ink) } else { text.color(ink) };
    let shown = ui.label(text).on_hover_text(say!(
        "{cloth} cm on the cloth, {body} cm on the body: the cloth has to stretch by so much there",
        cloth = language::number(cloth * 100.0, 1),
        body = language::number(body * 100.0, 1)
    ));
    let words = say!("Stretch of pair {number}: {percent}", number, percent);
    shown.widget_info(|| WidgetInfo::labeled(Role::Label, true, &words));
}

/// Draws a button for each stroke of a number, which selects it.
fn strokes_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, number: usize, asks: &mut Asks) {
    let marks = &told.document.marks;
    ui.spacing_mut().item_spacing.x = 2.0;
    ui.spacing_mut().button_padding.x = 4.0;
    let mut stroke = |ui: &mut egui::Ui, mark: MarkId, otherwise: &str, on_cloth: bool| {
        let given = marks.name(mark);
        let is_selected = told.now.selected.is_some_and(|(selected, _)| selected == mark);
        let text = if given.is_empty() { otherwise } else { given };
        let button = ui.add(Button::selectable(is_selected, text).truncate());
        let words = match on_cloth {
            true => say!("{text}: select mark {number} on the cloth", text, number),
            false => say!("{text}: select mark {number} on the body", text, number),
        };
        button.widget_info(|| WidgetInfo::selected(Role::Button, true, is_selected, &words));
        if button.clicked() {
            asks.push(Ask::Select((!is_selected).then_some(mark)));
        }
    };
    let lacks = |ui: &mut egui::Ui, words: &str| {
        ui.add(egui::Label::new(RichText::new(words).color(told.palette.warning)).truncate());
    };
    let cloth = marks.cloth.get(number - 1);
    let body = marks.body.get(number - 1);
    if let Some(mark) = cloth {
        let piece = told.document.pattern.pieces.get(&mark.piece).map_or(tr("a piece"), |p| &p.name);
        stroke(ui, mark.id, piece, true);
    }
    match (cloth, body) {
        (Some(_), Some(mark)) => stroke(ui, mark.id, tr("body"), false),
        (None, Some(mark)) => {
            stroke(ui, mark.id, tr("body"), false);
            lacks(ui, tr("not on the cloth yet"));
        }
        _ => lacks(ui, tr("not on the body yet")),
    }
}

/// Gives a widget a name of its own for screen readers and tests.
fn name(response: &egui::Response, name: &str) {
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, name));
}
