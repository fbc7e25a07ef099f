//! The section for animations of a body from a file: a list, a slider for the time, and buttons that play.

use egui::{Button, ComboBox, RichText};

use crate::session::{Animations, Command, Document, Moment};
use crate::ui::actions::asks::Asks;
use crate::ui::actions::context::FrameContext;
use crate::ui::language::fields::slider;
use crate::ui::language::{number, tr};
use crate::ui::list::list_ui;
use crate::ui::panels::context::PanelContext;
use crate::ui::panels::pose_slider::{follow, let_go};

/// Width of the list, points.
const WIDTH: f32 = 150.0;

/// The chosen animation and time, and whether it is playing.
#[derive(Debug, Default)]
pub struct AnimationPanel {
    animation: usize,
    seconds: f64,
    playing: Option<Play>,
}

/// An animation that is playing.
#[derive(Debug)]
struct Play {
    /// Time of the window's clock in the last frame, seconds.
    looked: f64,
    /// The moment that the body was last set to; a different one means that something else has moved the body.
    expected: Option<Moment>,
}

impl AnimationPanel {
    /// Draws list, slider and buttons; nothing for a body without animations.
    pub fn ui(&mut self, ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
        let Some(animations) = &told.document.animations else { return };
        ui.add_space(4.0);
        ui.label(RichText::new(animations.name()).color(told.palette.weak).size(12.5));
        self.list_ui(ui, animations, asks);
        let length = animations.seconds(self.animation).unwrap_or(0.0);
        // The slider must not round the value itself: it would report a change while the animation plays.
        let field = slider(&mut self.seconds, 0.0..=length).suffix(" s");
        let field = field.custom_formatter(|seconds, _| number(seconds, 2));
        let tip = tr("Leads the body through its animation, the cloth follows");
        let response = ui.add(field).on_hover_text(tip);
        let seconds = self.seconds;
        response.widget_info(|| egui::WidgetInfo::slider(true, seconds, tr("Time of the animation")));
        if let Some(done) = let_go(&response, told) {
            self.playing = None;
            self.go(!done, asks);
        }
        if ui.ctx().dragged_id().is_none() && self.playing.is_none() {
            self.as_document(told);
        }
        ui.horizontal(|ui| self.buttons_ui(ui, told, asks));
    }

    /// Takes the moment of the document, which undo may have changed.
    fn as_document(&mut self, told: &PanelContext<'_>) {
        match told.document.moment {
            Some(Moment { animation, seconds }) => (self.animation, self.seconds) = (animation, seconds),
            None => self.seconds = 0.0,
        }
    }

    fn list_ui(&mut self, ui: &mut egui::Ui, animations: &Animations, asks: &mut Asks) {
        let names: Vec<String> = animations.names().collect();
        self.animation = self.animation.min(names.len().saturating_sub(1));
        let chosen = names.get(self.animation).cloned().unwrap_or_default();
        let combo = ComboBox::from_label(tr("Animation")).selected_text(chosen).width(WIDTH);
        list_ui(ui, combo, |entries| {
            for (i, name) in names.iter().enumerate() {
                if entries.add(i == self.animation, name).clicked() {
                    (self.animation, self.seconds, self.playing) = (i, 0.0, None);
                    self.go(false, asks);
                }
            }
        });
    }

    fn buttons_ui(&mut self, ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
        let plays = self.playing.is_some();
        let words = if plays { tr("Stop") } else { tr("Play") };
        let tip = tr("Plays the animation over and over; the cloth follows as quickly as it can");
        if ui.button(words).on_hover_text(tip).clicked() {
            match plays {
                true => {
                    self.playing = None;
                    self.go(false, asks);
                }
                false => {
                    let (looked, expected) = (ui.input(|i| i.time), told.document.moment);
                    self.playing = Some(Play { looked, expected });
                }
            }
        }
        let is_off = told.document.moment.is_some() || plays;
        let rest = ui.add_enabled(is_off, Button::new(tr("Rest pose")));
        if rest.on_hover_text(tr("As the body stands in the file without animation")).clicked() {
            self.playing = None;
            follow(Command::Animate { at: None, draft: false }, true, asks);
        }
    }

    /// Advances a playing animation once per frame, whether or not the section is drawn. It stops when something else moves the
    /// body.
    pub fn play(&mut self, ctx: &egui::Context, document: &Document, now: &FrameContext, asks: &mut Asks) {
        let Some(play) = &mut self.playing else { return };
        let length = document.animations.as_ref().and_then(|all| all.seconds(self.animation));
        let is_moved = play.expected != document.moment;
        let Some(length) = length.filter(|_| !now.wrapping && !now.demo && !is_moved) else {
            self.playing = None;
            return;
        };
        ctx.request_repaint();
        // Requests of the user come first: they may stop the animation.
        if !now.caught_up || !asks.is_empty() {
            return;
        }
        let time = ctx.input(|i| i.time);
        self.seconds += time - play.looked;
        if self.seconds > length {
            self.seconds = 0.0;
        }
        play.looked = time;
        play.expected = Some(Moment { animation: self.animation, seconds: self.seconds });
        self.go(true, asks);
    }

    fn go(&self, draft: bool, asks: &mut Asks) {
        let at = Some(Moment { animation: self.animation, seconds: self.seconds });
        follow(Command::Animate { at, draft }, !draft, asks);
    }
}
