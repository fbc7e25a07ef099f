//! The tour: from an empty table to a dressed body in five steps, which the user carries out.

use std::sync::Arc;

use egui::{Align2, Area, Frame, Id, Order, RichText, Stroke};

use crate::body::mannequin;
use crate::session::samples::Sample;
use crate::session::{Command, Project};
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::actions::context::FrameContext;
use crate::ui::actions::{Action, Tool};
use crate::ui::app::App;
use crate::ui::language::{say, tr, translated};
use crate::ui::look::theme::Palette;
use crate::wrap::{Marks, Phase};

/// Number of steps.
const STEPS: usize = 5;

/// Progress of the tour.
#[derive(Debug, Default)]
pub struct Tour {
    /// Current step, from 0.
    step: usize,
    /// Length of the undo history when the last step began.
    steps_before: usize,
}

/// The texts of one step.
struct Step {
    title: &'static str,
    words: &'static str,
    /// Label of the button that carries the step out for the user.
    help: Option<&'static str>,
}

fn step(i: usize) -> Step {
    match i {
        0 => Step {
            title: tr("Flat pieces"),
            words: tr(
                "On the left is the table for flat pieces. Take those of a T-shirt, or draw your own with Pattern › Tools.",
            ),
            help: Some(tr("Take the T-shirt's pieces")),
        },
        1 => Step {
            title: tr("A mark on the cloth"),
            words: tr(
                "Drag with the left button over the middle of the front piece, from the neck down: that paints mark 1.",
            ),
            help: None,
        },
        2 => Step {
            title: tr("Its partner on the body"),
            words: tr(
                "Drag over the body where the mark is to lie: down the middle of the chest. Marks with the same number will meet.",
            ),
            help: None,
        },
        3 => Step {
            title: tr("Wrap"),
            words: tr(
                "A T-shirt wants a mark on each shoulder and sleeve, too: have them painted for you. Then press Wrap, or Enter.",
            ),
            help: Some(tr("Paint all the marks")),
        },
        _ => Step {
            title: tr("Put it right"),
            words: tr(
                "Drag the cloth over the skin with the right button. A click with the tool Pin (P) holds it fast where it is.",
            ),
            help: None,
        },
    }
}

impl Tour {
    /// Whether the user has done what the step asks for. `steps` is the length of the undo history.
    fn is_done(&self, now: &FrameContext, steps: usize) -> bool {
        match self.step {
            0 => now.pieces > 0,
            1 => now.marks[0] > 0,
            2 => now.marks[0].min(now.marks[1]) > 0,
            3 => now.dressed && now.phase.is_some_and(|phase| phase != Phase::Growing),
            _ => steps > self.steps_before && now.dressed && !now.dragging,
        }
    }
}

impl App {
    /// Begins the tour on an empty table; the caller has asked about unsaved changes.
    pub(in crate::ui) fn begin_tour(&mut self) {
        self.replace(Project::default(), None);
        self.leave_start_page();
        self.tool = Tool::Mark;
        self.shell.tour = Some(Tour::default());
    }

    /// Draws the card of the current step over the body pane.
    pub(in crate::ui) fn tour_ui(
        &mut self,
        ctx: &egui::Context,
        now: &FrameContext,
        palette: &Palette,
        asks: &mut Asks,
    ) {
        let Some(mut tour) = self.shell.tour.take() else { return };
        let Some(pane) = self.scene_pane.area.filter(|_| !now.demo) else {
            self.shell.tour = Some(tour);
            return;
        };
        let steps = self.session.step_labels().count();
        let done = tour.is_done(now, steps);
        let mut stays = true;
        let area = Area::new(Id::unique("tour")).order(Order::Middle).pivot(Align2::LEFT_BOTTOM);
        area.fixed_pos(pane.left_bottom() + egui::vec2(12.0, -12.0)).show(ctx, |ui| {
            Frame::popup(ui.style()).stroke(Stroke::new(1.5, palette.accent)).inner_margin(12).show(
                ui,
                |ui| {
                    ui.set_width((pane.width() * 0.5).clamp(180.0, 300.0));
                    let Step { title, words, help } = step(tour.step);
                    ui.horizontal(|ui| {
                        ui.label(RichText::new(format!("{}  {title}", tour.step + 1)).strong().size(15.0));
                        ui.label(RichText::new(say!("of {count}", count = STEPS)).color(palette.weak));
                    });
                    ui.label(words);
                    if let Some(help) = help.filter(|_| tour.step != 0 || now.pieces == 0)
                        && ui.button(help).clicked()
                    {
                        asks.extend(self.help_in_tour(tour.step));
                    }
                    if done {
                        ui.label(RichText::new(tr("This step is done")).color(palette.accent).strong());
                    }
                    ui.add_space(4.0);
                    ui.horizontal(|ui| {
                        let last = tour.step + 1 == STEPS;
                        let text = if last {
                            tr("Finish")
                        } else if done {
                            tr("Next")
                        } else {
                            tr("Skip this step")
                        };
                        let mut label = RichText::new(text);
                        let mut fill = ui.visuals().widgets.inactive.weak_bg_fill;
                        if done {
                            (label, fill) = (label.color(palette.on_accent), palette.accent);
                        }
                        if ui.add(egui::Button::new(label).fill(fill)).clicked() {
                            stays = !last;
                            (tour.step, tour.steps_before) = (tour.step + 1, steps);
                        }
                        // In tables "Back" is the view from behind.
                        let back = translated("Back to the step before").unwrap_or("Back");
                        if tour.step > 0 && tour.step < STEPS && ui.button(back).clicked() {
                            tour.step -= 1;
                        }
                        let leave = ui.button(tr("Leave the tour"));
                        let leave = leave.on_hover_text(tr("Help › Tour begins it again"));
                        stays &= !leave.clicked();
                    });
                },
            );
        });
        if stays {
            self.shell.tour = Some(tour);
        }
    }

    /// Requests that carry out the current step for the user.
    fn help_in_tour(&self, step: usize) -> Vec<Ask> {
        let sample = Sample::Tshirt.project(&mannequin::default()).document;
        match step {
            0 => vec![Ask::Do(Command::ReplacePattern {
                name: Sample::Tshirt.name().to_owned(),
                pattern: sample.pattern,
                marks: Arc::new(Marks::default()),
            })],
            _ if self.session.document().pattern == sample.pattern => {
                vec![Ask::Do(Command::SetMarks { marks: sample.marks })]
            }
            _ => vec![Ask::Act(Action::SuggestMarks)],
        }
    }
}
