//! The command palette: finds actions by a few of their letters.

use egui::{Align2, Area, Frame, Id, Key, Modifiers, Order, ScrollArea, TextEdit};
use nucleo_matcher::pattern::{CaseMatching, Normalization, Pattern};
use nucleo_matcher::{Config, Matcher, Utf32Str};

use crate::ui::actions::Action;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::actions::context::FrameContext;
use crate::ui::actions::rows::all;
use crate::ui::language::keys::shortcut_text;
use crate::ui::language::{say, tr, translated};
use crate::ui::look::theme::Palette;

/// Width of the list, points.
const WIDTH: f32 = 520.0;

/// The open palette: the typed text, and the chosen one of the actions found.
#[derive(Debug, Default)]
pub struct CommandPalette {
    text: String,
    chosen: usize,
    /// Whether to scroll to the chosen row.
    moved: bool,
}

impl CommandPalette {
    /// Draws the palette; false when it is to be closed.
    pub fn ui(
        &mut self,
        ctx: &egui::Context,
        now: &FrameContext,
        palette: &Palette,
        asks: &mut Asks,
    ) -> bool {
        let found = found(&self.text, now);
        let mut open = self.keys(ctx, now, &found, asks);
        let room = ctx.content_rect();
        let area = Area::new(Id::unique("command palette"))
            .order(Order::Foreground)
            .pivot(Align2::CENTER_TOP)
            .fixed_pos(room.center_top() + egui::vec2(0.0, 70.0));
        let shown = area.show(ctx, |ui| {
            Frame::popup(ui.style()).inner_margin(10).show(ui, |ui| {
                ui.set_width(WIDTH.min(room.width() - 60.0));
                self.field_ui(ui);
                ui.add_space(4.0);
                if found.is_empty() {
                    ui.label(egui::RichText::new(tr("No command is called so")).color(palette.weak));
                }
                ScrollArea::vertical().max_height(room.height() * 0.55).show(ui, |ui| {
                    for (i, &action) in found.iter().enumerate() {
                        let row = row_ui(ui, action, now, i == self.chosen, palette);
                        if i == self.chosen && self.moved {
                            row.scroll_to_me(None);
                        }
                        if row.clicked() {
                            choose(action, now, asks);
                            open = false;
                        }
                    }
                });
            });
        });
        self.moved = false;
        let beside = ctx.input(|i| i.pointer.any_pressed() && i.pointer.interact_pos().is_some())
            && !shown.response.contains_pointer();
        open && !beside
    }

    fn field_ui(&mut self, ui: &mut egui::Ui) {
        let field = TextEdit::singleline(&mut self.text)
            .desired_width(f32::INFINITY)
            .hint_text(tr("What do you want to do?"))
            .font(egui::FontId::proportional(16.0));
        let response = ui.add(field);
        response.widget_info(|| {
            egui::WidgetInfo::labeled(egui::accesskit::Role::SearchInput, true, tr("Find a command"))
        });
        if !response.has_focus() {
            response.request_focus();
        }
        if response.changed() {
            (self.chosen, self.moved) = (0, true);
        }
    }

    fn keys(&mut self, ctx: &egui::Context, now: &FrameContext, found: &[Action], asks: &mut Asks) -> bool {
        let pressed = |key| ctx.input_mut(|i| i.consume_key(Modifiers::NONE, key));
        let last = found.len().saturating_sub(1);
        let step = i64::from(pressed(Key::ArrowDown)) - i64::from(pressed(Key::ArrowUp))
            + 10 * (i64::from(pressed(Key::PageDown)) - i64::from(pressed(Key::PageUp)));
        if step != 0 {
            self.chosen = (self.chosen as i64 + step).clamp(0, last as i64) as usize;
            self.moved = true;
        }
        self.chosen = self.chosen.min(last);
        if pressed(Key::Enter)
            && let Some(&action) = found.get(self.chosen)
        {
            choose(action, now, asks);
            return false;
        }
        !pressed(Key::Escape)
    }
}

/// Carries out an action, or shows why it is disabled.
fn choose(action: Action, now: &FrameContext, asks: &mut Asks) {
    asks.push(now.refusal(action).map_or(Ask::Act(action), Ask::Say));
}

fn row_ui(
    ui: &mut egui::Ui,
    action: Action,
    now: &FrameContext,
    chosen: bool,
    palette: &Palette,
) -> egui::Response {
    let why_not = now.why_not(action);
    let keys: Vec<String> = now.keymap.keys(action).iter().map(|k| shortcut_text(ui.ctx(), k)).collect();
    let right = why_not.map_or_else(|| keys.join("   "), str::to_owned);
    let ink = if why_not.is_some() { palette.weak } else { ui.visuals().text_color() };
    let mut text = egui::text::LayoutJob::default();
    let font = egui::TextStyle::Button.resolve(ui.style());
    let format = |color| egui::TextFormat { font_id: font.clone(), color, ..Default::default() };
    text.append(&format!("{} › ", action.row().place()), 0.0, format(palette.weak));
    text.append(&now.text(action), 0.0, format(ink));
    // The name is always whole; what is beside it ends where there is no more room.
    let (name, padding) = (ui.painter().layout_job(text.clone()), ui.spacing().button_padding.x);
    // Between them is a space that grows, with a gap on either side; one point less, since widths are rounded.
    let room = ui.available_width() - name.size().x - 2.0 * (padding + ui.spacing().icon_spacing);
    let mut beside = egui::text::LayoutJob::single_section(right, format(palette.weak));
    beside.wrap = egui::text::TextWrapping::truncate_at_width((room - 1.0).max(0.0));
    let button = egui::Button::selectable(chosen, text)
        .shortcut_text(ui.painter().layout_job(beside))
        .truncate()
        .min_size(egui::vec2(ui.available_width(), 0.0));
    let response = ui.add(button);
    let name = match why_not {
        Some(why) => format!("{}: {why}", now.text(action)),
        None => say!("Command {name}", name = now.text(action)),
    };
    response.widget_info(|| {
        egui::WidgetInfo::selected(egui::accesskit::Role::ListBoxOption, why_not.is_none(), chosen, &name)
    });
    response.on_hover_text(tr(action.row().tip))
}

/// The actions that match `text` by the names shown or the English ones, best match first; all of them for an empty text.
pub fn found(text: &str, now: &FrameContext) -> Vec<Action> {
    let pattern = Pattern::parse(text, CaseMatching::Ignore, Normalization::Smart);
    let mut matcher = Matcher::new(Config::DEFAULT);
    let mut buffer = Vec::new();
    let recent = (0..now.recent.len() as u8).map(Action::OpenRecent);
    let mut all: Vec<(u32, Action)> = all()
        .chain(recent)
        .filter(|action| *action != Action::CommandPalette)
        .filter_map(|action| {
            // A match in the label counts more than one in the menu or the tooltip.
            let mut score = |words: &str| {
                buffer.clear();
                pattern.score(Utf32Str::new(words, &mut buffer), &mut matcher)
            };
            let row = action.row();
            let mut names = vec![(row.place(), now.text(action))];
            if translated(row.text).is_some() {
                names.push((row.menu.to_owned(), row.text.to_owned()));
            }
            // What was typed in one piece counts more than its letters here and there.
            let typed = text.trim().to_lowercase();
            let whole = |words: &str| u32::from(words.to_lowercase().contains(&typed)) * 1000;
            let scores = names.iter().filter_map(|(menu, name)| {
                let both = format!("{menu} {name}");
                let place = score(&both).map(|s| s * 2 + whole(&both));
                score(name).map(|s| s * 4 + 2 * whole(name)).max(place)
            });
            scores.max().map(|score| (score, action))
        })
        .collect();
    all.sort_by_key(|(score, _)| std::cmp::Reverse(*score));
    all.into_iter().map(|(_, action)| action).collect()
}
