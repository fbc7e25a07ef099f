//! The start page: new project, recent files, samples, tour.

use egui::{
    Align2, CentralPanel, FontId, Frame, Key, Margin, Modifiers, Pos2, Rect, RichText, ScrollArea, Sense,
};
use egui::{Panel, WidgetInfo};

use crate::session::samples::Sample;
use crate::ui::actions::Action;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::actions::context::FrameContext;
use crate::ui::app::App;
use crate::ui::files::recent::RecentFile;
use crate::ui::files::thumbnails::Subject;
use crate::ui::language::keys::shortcut_text;
use crate::ui::language::{say, tr};
use crate::ui::look::theme::Palette;
use crate::ui::shell::menu;

/// Width of a sample's card, points; within it the cards fill one row if possible.
const CARD: std::ops::RangeInclusive<f32> = 130.0..=210.0;
/// Cards in a row, where there is room.
const CARDS: f32 = 6.0;
/// Width of the column with new and recent projects, points.
const COLUMN: f32 = 300.0;

/// The open start page.
#[derive(Debug, Default)]
pub struct StartPage {}

impl App {
    /// Draws the start page instead of the panes.
    pub(in crate::ui) fn start_page(
        &mut self,
        ui: &mut egui::Ui,
        now: &FrameContext,
        palette: &Palette,
        asks: &mut Asks,
    ) {
        let frame = Frame::new().fill(ui.visuals().panel_fill);
        let thin = frame.inner_margin(Margin::symmetric(10, 3));
        Panel::top("menu").frame(thin).show_separator_line(false).show(ui, |ui| {
            menu::menu_bar_ui(ui, now, asks);
        });
        CentralPanel::default().frame(frame.inner_margin(Margin::symmetric(36, 20))).show(ui, |ui| {
            ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
                ui.label(RichText::new("Toile").size(30.0).strong());
                ui.label(
                    RichText::new(tr("Lay out flat pieces, paint marks on cloth and body, press Wrap."))
                        .color(palette.weak),
                );
                ui.add_space(18.0);
                ui.horizontal_top(|ui| {
                    ui.vertical(|ui| {
                        ui.set_width(COLUMN);
                        self.begin_ui(ui, now, palette, asks);
                    });
                    ui.add_space(28.0);
                    ui.vertical(|ui| self.gallery_ui(ui, palette, asks));
                });
            });
        });
        self.start_keys(ui.ctx(), now, asks);
    }

    fn begin_ui(&mut self, ui: &mut egui::Ui, now: &FrameContext, palette: &Palette, asks: &mut Asks) {
        ui.label(RichText::new(tr("Begin")).strong().size(15.0));
        ui.add_space(4.0);
        let wide = egui::vec2(COLUMN, 34.0);
        let choices = [
            (Action::Tour, tr("Tour: dressed in five steps")),
            (Action::New, tr("New: an empty table")),
            (Action::Open, tr("Open…")),
        ];
        for (action, text) in choices {
            let mut label = RichText::new(text).size(14.5);
            let mut fill = ui.visuals().widgets.inactive.weak_bg_fill;
            if action == Action::Tour {
                label = label.color(palette.on_accent);
                fill = palette.accent;
            }
            let keys = now.keymap.keys(action);
            let keys = keys.first().map(|k| shortcut_text(ui.ctx(), k)).unwrap_or_default();
            let button = egui::Button::new(label).fill(fill).shortcut_text(keys).min_size(wide);
            let response = ui.add(button).on_hover_text(tr(action.row().tip));
            response.widget_info(|| WidgetInfo::labeled(egui::accesskit::Role::Button, true, text));
            if response.clicked() {
                asks.push(Ask::Act(action));
            }
        }
        ui.add_space(16.0);
        ui.horizontal(|ui| {
            ui.label(RichText::new(tr("Open before")).strong().size(15.0));
            if !now.recent.is_empty() {
                ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                    let clear = ui.small_button(tr("Clear"));
                    let clear = clear.on_hover_text(tr(Action::ClearRecent.row().tip));
                    if clear.clicked() {
                        asks.push(Ask::Act(Action::ClearRecent));
                    }
                });
            }
        });
        if now.recent.is_empty() {
            let words = tr("Projects you save or open are found here again.");
            ui.label(RichText::new(words).color(palette.weak));
        }
        for (i, file) in now.recent.iter().enumerate() {
            self.recent_row(ui, i, file, palette, asks);
        }
    }

    fn recent_row(
        &mut self,
        ui: &mut egui::Ui,
        i: usize,
        file: &RecentFile,
        palette: &Palette,
        asks: &mut Asks,
    ) {
        let (name, folder) = file.name();
        let sense = if file.is_there { Sense::click() } else { Sense::hover() };
        let (rect, response) = ui.allocate_exact_size(egui::vec2(COLUMN, 44.0), sense);
        response.widget_info(|| {
            let words = match file.is_there {
                true => say!("Open {name} in {folder}", name, folder),
                false => say!("Open {name} in {folder}, no longer there", name, folder),
            };
            WidgetInfo::labeled(egui::accesskit::Role::Button, file.is_there, words)
        });
        card_frame(ui, rect, &response);
        let picture = Rect::from_min_size(rect.min + egui::vec2(24.0, 3.0), egui::vec2(30.4, 38.0));
        if file.is_there
            && let Some(texture) = self.shell.thumbnails.get(ui.ctx(), &Subject::Project(file.path.clone()))
        {
            ui.painter().image(texture.id(), picture, WHOLE, egui::Color32::WHITE);
        }
        let ink = if file.is_there { ui.visuals().text_color() } else { palette.weak };
        let painter = ui.painter_at(rect);
        let number = if i < 9 { (i + 1).to_string() } else { String::new() };
        let font = |size| FontId::proportional(size);
        painter.text(
            rect.left_center() + egui::vec2(8.0, 0.0),
            Align2::LEFT_CENTER,
            number,
            font(12.0),
            palette.weak,
        );
        painter.text(rect.min + egui::vec2(62.0, 5.0), Align2::LEFT_TOP, &name, font(14.0), ink);
        let under = if file.is_there { folder.clone() } else { tr("no longer there").to_owned() };
        painter.text(rect.min + egui::vec2(62.0, 24.0), Align2::LEFT_TOP, under, font(11.5), palette.weak);
        if response.on_hover_text(file.path.display().to_string()).clicked() {
            asks.push(Ask::Act(Action::OpenRecent(i as u8)));
        }
    }

    fn gallery_ui(&mut self, ui: &mut egui::Ui, palette: &Palette, asks: &mut Asks) {
        let is_marked = |sample: &Sample| Sample::MARKED.contains(sample);
        let (marked, placed): (Vec<Sample>, Vec<Sample>) = Sample::ALL.into_iter().partition(is_marked);
        let width = (ui.available_width() / CARDS - 12.0).clamp(*CARD.start(), *CARD.end());
        let card = egui::vec2(width, width * 1.25 + 30.0);
        for (title, then, samples) in [
            (tr("Samples"), tr("with marks: press Wrap"), marked),
            (tr("Gallery"), tr("placed round the body: press Dress"), placed),
        ] {
            ui.horizontal(|ui| {
                ui.label(RichText::new(title).strong().size(15.0));
                ui.label(RichText::new(then).color(palette.weak));
            });
            ui.add_space(4.0);
            ui.horizontal_wrapped(|ui| {
                ui.spacing_mut().item_spacing = egui::vec2(12.0, 12.0);
                samples.into_iter().for_each(|sample| self.sample_card(ui, sample, card, palette, asks));
            });
            ui.add_space(14.0);
        }
    }

    fn sample_card(
        &mut self,
        ui: &mut egui::Ui,
        sample: Sample,
        card: egui::Vec2,
        palette: &Palette,
        asks: &mut Asks,
    ) {
        let (rect, response) = ui.allocate_exact_size(card, Sense::click());
        let name = Action::Sample(sample).row().label();
        response.widget_info(|| {
            WidgetInfo::labeled(egui::accesskit::Role::Button, true, say!("Sample {name}", name))
        });
        card_frame(ui, rect, &response);
        let area = Rect::from_min_max(rect.min, rect.max - egui::vec2(0.0, 30.0)).shrink(4.0);
        let subject = Subject::Sample(sample);
        match self.shell.thumbnails.get(ui.ctx(), &subject) {
            Some(texture) => {
                let size = texture.size_vec2();
                let scale = (area.width() / size.x).min(area.height() / size.y);
                let place = Rect::from_center_size(area.center(), size * scale);
                ui.painter().image(texture.id(), place, WHOLE, egui::Color32::WHITE);
            }
            None => {
                let initial: String = name.chars().take(1).collect();
                let font = FontId::proportional(54.0);
                let ink = palette.weak.gamma_multiply(0.35);
                ui.painter().text(area.center(), Align2::CENTER_CENTER, initial, font, ink);
            }
        }
        let at = Pos2::new(rect.center().x, rect.bottom() - 16.0);
        let ink = ui.visuals().text_color();
        ui.painter().text(at, Align2::CENTER_CENTER, name, FontId::proportional(14.0), ink);
        if response.on_hover_text(tr(Action::Sample(sample).row().tip)).clicked() {
            asks.push(Ask::Act(Action::Sample(sample)));
        }
    }

    /// A digit key opens the file with that number; Esc goes to the panes.
    fn start_keys(&mut self, ctx: &egui::Context, now: &FrameContext, asks: &mut Asks) {
        if self.dialog.is_some() || self.shell.is_asking() || egui::Popup::is_any_open(ctx) {
            return;
        }
        const FIGURES: [Key; 9] = [
            Key::Num1,
            Key::Num2,
            Key::Num3,
            Key::Num4,
            Key::Num5,
            Key::Num6,
            Key::Num7,
            Key::Num8,
            Key::Num9,
        ];
        for (i, key) in FIGURES.into_iter().enumerate() {
            let action = Action::OpenRecent(i as u8);
            if now.why_not(action).is_none() && ctx.input_mut(|i| i.consume_key(Modifiers::NONE, key)) {
                asks.push(Ask::Act(action));
            }
        }
        if ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape)) {
            self.leave_start_page();
        }
    }

    /// Closes the start page.
    pub(in crate::ui) fn leave_start_page(&mut self) {
        self.shell.start = None;
        self.shell.thumbnails.rest();
    }
}

const WHOLE: Rect = Rect { min: Pos2::ZERO, max: Pos2::new(1.0, 1.0) };

fn card_frame(ui: &egui::Ui, rect: Rect, response: &egui::Response) {
    let visuals = ui.visuals();
    let hot = response.enabled() && (response.hovered() || response.has_focus());
    let fill = if hot { visuals.widgets.hovered.weak_bg_fill } else { visuals.window_fill };
    let line = if response.has_focus() { visuals.selection.stroke } else { visuals.window_stroke };
    ui.painter().rect(rect, 8.0, fill, line, egui::StrokeKind::Inside);
}
