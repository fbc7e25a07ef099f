//! The drawer below the panes: history, messages, or the map as a table.

use egui::{Frame, Margin, Panel, RichText, ScrollArea};

use crate::ui::actions::Action;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::actions::context::FrameContext;
use crate::ui::actions::drawer::Drawer;
use crate::ui::app::App;
use crate::ui::app::focus_round::Bar;
use crate::ui::language::{said, say, tr};
use crate::ui::look::theme::Palette;
use crate::ui::maps;

impl App {
    /// Draws the drawer if it is open.
    pub(in crate::ui) fn drawer_panel(
        &mut self,
        ui: &mut egui::Ui,
        now: &FrameContext,
        palette: &Palette,
        asks: &mut Asks,
    ) {
        let Some(drawer) = self.shell.drawer else { return };
        let frame = Frame::new().fill(ui.visuals().panel_fill).inner_margin(Margin::symmetric(10, 6));
        let shown = Panel::bottom("drawer")
            .frame(frame)
            .resizable(true)
            .default_size(150.0)
            .size_range(90.0..=360.0)
            .show(ui, |ui| {
                ui.horizontal(|ui| {
                    for action in [Action::ToggleHistory, Action::ToggleLog, Action::ToggleMapTable] {
                        let tab = egui::Button::selectable(now.is_on(action), tr(action.row().text));
                        if ui.add(tab).clicked() && !now.is_on(action) {
                            asks.push(Ask::Act(action));
                        }
                    }
                    ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                        if ui.small_button("×").on_hover_text(tr("Close")).clicked() {
                            asks.push(Ask::Act(match drawer {
                                Drawer::History => Action::ToggleHistory,
                                Drawer::Log => Action::ToggleLog,
                                Drawer::Map => Action::ToggleMapTable,
                            }));
                        }
                        let text = match drawer {
                            Drawer::History => None,
                            Drawer::Log => Some(self.messages.text()),
                            Drawer::Map => self.shell.maps.shown().map(maps::table_text),
                        };
                        if let Some(text) = text
                            && ui.button(tr("Copy all")).clicked()
                        {
                            ui.ctx().copy_text(text);
                        }
                    });
                });
                ScrollArea::both().auto_shrink([false, false]).stick_to_bottom(drawer != Drawer::Map).show(
                    ui,
                    |ui| match drawer {
                        Drawer::History => self.history_ui(ui, palette, asks),
                        Drawer::Log => self.messages.log_ui(ui, palette),
                        Drawer::Map => maps::table_ui(ui, self.shell.maps.shown(), palette),
                    },
                );
            });
        self.shell.round.show(Bar::Drawer, shown.response.rect);
    }

    /// The undo history, oldest step first; undone steps are fainter. A click goes to a step.
    fn history_ui(&self, ui: &mut egui::Ui, palette: &Palette, asks: &mut Asks) {
        let session = self.shown();
        let steps = session.step_labels().chain(session.undone_labels()).map(said);
        let labels: Vec<String> = std::iter::once(tr("As it was opened").to_owned()).chain(steps).collect();
        let done = session.step_labels().count();
        ui.spacing_mut().item_spacing.y = 1.0;
        for (i, label) in labels.iter().enumerate() {
            let words = if i == 0 { label.clone() } else { format!("{i}  {label}") };
            let text =
                if i > done { RichText::new(&words).color(palette.weak) } else { RichText::new(&words) };
            let row =
                egui::Button::selectable(i == done, text).min_size(egui::vec2(ui.available_width(), 0.0));
            let row = ui.add(row);
            row.widget_info(|| {
                egui::WidgetInfo::selected(
                    egui::accesskit::Role::ListBoxOption,
                    true,
                    i == done,
                    say!("Step {words}", words),
                )
            });
            if row.clicked() && i != done {
                asks.push(Ask::Jump(i as i32 - done as i32));
            }
        }
    }
}
