//! The section for the pose of the body.

use std::sync::Arc;

use egui::{Button, RichText};

use crate::body::NamedPose;
use crate::session::{Aim, BodyChoice, Command};
use crate::ui::actions::Action;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::files::posed_motion::PosedMotion;
use crate::ui::language::fields::slider;
use crate::ui::language::{say, tr};
use crate::ui::panels::animation::AnimationPanel;
use crate::ui::panels::context::PanelContext;
use crate::ui::panels::joint::JointPanel;
use crate::ui::panels::pose_slider::{follow, let_go, posed};

/// The pose chosen last, and the fraction of the way to it.
#[derive(Debug)]
pub struct PosePanel {
    to: NamedPose,
    share: f64,
    joints: JointPanel,
    /// Animations of a body from a file.
    pub animation: AnimationPanel,
    /// A pose from a file that the body can be moved to, and the fraction of the way to it.
    aim: Option<(Arc<Aim>, f64)>,
    /// A captured motion, and its current frame, from 1.
    motion: Option<(PosedMotion, usize)>,
}

impl Default for PosePanel {
    fn default() -> Self {
        Self {
            to: NamedPose::Standing,
            share: 0.0,
            joints: JointPanel::default(),
            animation: AnimationPanel::default(),
            aim: None,
            motion: None,
        }
    }
}

impl PosePanel {
    /// Draws the section.
    pub fn ui(&mut self, ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
        let body = &told.document.body;
        let has_joints = body.measurements().is_some();
        let enabled = !told.now.wrapping && !told.now.demo;
        ui.add_enabled_ui(enabled, |ui| {
            // It comes first: while an animation is shown the mannequin is treated like a body from a file, and the widgets below
            // disappear under the pointer.
            self.animation.ui(ui, told, asks);
            if has_joints {
                self.names_ui(ui, body, asks);
                self.way_ui(ui, told, asks);
                self.joints.ui(ui, told, asks);
            } else if told.document.animations.is_none() {
                let words =
                    tr("The body is from a file: it takes the poses that other files of the same mesh have.");
                ui.add(egui::Label::new(RichText::new(words).color(told.palette.weak)).wrap());
            }
            self.files_ui(ui, told, asks);
        });
    }

    /// Chooses `pose`: the command that puts `body` in it, unless it is in it already or has no joints.
    pub fn take(&mut self, pose: NamedPose, body: &BodyChoice) -> Option<Command> {
        (self.to, self.share) = (pose, 1.0);
        whole(body, pose).map(|body| posed(body, false))
    }

    fn names_ui(&mut self, ui: &mut egui::Ui, body: &BodyChoice, asks: &mut Asks) {
        egui::Grid::new("poses").num_columns(2).spacing([6.0, 4.0]).show(ui, |ui| {
            for (i, pose) in NamedPose::ALL.into_iter().enumerate() {
                let is_taken = if pose == NamedPose::A {
                    matches!(body, BodyChoice::Mannequin(_))
                } else {
                    self.to == pose && self.share == 1.0 && matches!(body, BodyChoice::Posed { .. })
                };
                let size = egui::vec2(ui.available_width().min(112.0), 0.0);
                let button = ui.add(Button::selectable(is_taken, tr(pose.title())).min_size(size));
                let words = say!("Pose {name}", name = tr(pose.title()));
                button.widget_info(|| {
                    egui::WidgetInfo::selected(egui::accesskit::Role::Button, true, is_taken, words.clone())
                });
                if button.clicked() {
                    asks.extend(self.take(pose, body).map(Ask::Do));
                }
                if i % 2 == 1 {
                    ui.end_row();
                }
            }
        });
    }

    /// Draws a slider from the built pose to the chosen one.
    fn way_ui(&mut self, ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
        if self.to == NamedPose::A {
            return;
        }
        let text = say!("On the way to {pose}", pose = tr(self.to.title()));
        let done = percent_ui(ui, told, &text, tr("On the way to the pose"), &mut self.share);
        let body = &told.document.body;
        if let (Some(done), Some(new)) = (done, part(body, self.to, self.share))
            && (done || new != *body)
        {
            follow(posed(new, !done), done, asks);
        }
    }

    /// Draws sliders to a pose from a file and through a motion.
    fn files_ui(&mut self, ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
        ui.add_space(4.0);
        if ui.button(tr("From a file…")).on_hover_text(tr(Action::PoseFromFile.row().tip)).clicked() {
            asks.push(Ask::Act(Action::PoseFromFile));
        }
        if let Some(aim) = &told.document.aim {
            if self.aim.as_ref().is_none_or(|(of, _)| !Arc::ptr_eq(of, aim)) {
                self.aim = Some((Arc::clone(aim), 0.0));
            }
            if let Some((_, share)) = &mut self.aim {
                if ui.ctx().dragged_id().is_none() {
                    // Takes the state of the document, which undo may have changed.
                    let at = |end: &BodyChoice| told.document.body == *end;
                    *share = if at(&aim.from) {
                        0.0
                    } else if at(&aim.to) {
                        1.0
                    } else {
                        *share
                    };
                }
                let text = say!("On the way to {pose}", pose = tr(aim.to.name()));
                let name = tr("On the way to the pose of the file");
                if let Some(done) = percent_ui(ui, told, &text, name, share) {
                    follow(Command::PoseTowards { share: *share, draft: !done }, done, asks);
                }
            }
        }
        if let Some((motion, frame)) = &mut self.motion
            && told.document.body.measurements().is_some()
        {
            ui.label(RichText::new(&motion.name).color(told.palette.weak).size(12.5));
            let field = slider(frame, 1..=motion.frames()).prefix(format!("{} ", tr("frame")));
            let response = ui.add(field);
            response.widget_info(|| egui::WidgetInfo::slider(true, *frame as f64, tr("Frame of the motion")));
            let body = &told.document.body;
            if let (Some(done), Some(new)) = (let_go(&response, told), motion.body(body, *frame - 1))
                && (done || new != *body)
            {
                follow(posed(new, !done), done, asks);
            }
        }
    }

    /// Takes a motion that was read.
    pub fn take_motion(&mut self, motion: PosedMotion) {
        self.motion = Some((motion, 1));
    }
}

/// Draws a slider of a fraction in percent. Returns Some when it was moved, with whether it was released.
fn percent_ui(
    ui: &mut egui::Ui,
    told: &PanelContext<'_>,
    text: &str,
    name: &str,
    share: &mut f64,
) -> Option<bool> {
    ui.label(RichText::new(text).color(told.palette.weak).size(12.5));
    let mut percent = (*share * 100.0).round();
    let response = ui.add(slider(&mut percent, 0.0..=100.0).suffix(" %").step_by(1.0));
    response.widget_info(|| egui::WidgetInfo::slider(true, percent, name));
    if response.changed() {
        *share = percent / 100.0;
    }
    let_go(&response, told)
}

/// The body in a named pose; None if it is in that pose already.
fn whole(body: &BodyChoice, pose: NamedPose) -> Option<BodyChoice> {
    body.in_named_pose(pose).filter(|posed| posed != body)
}

/// The body between the built pose and another, at the fraction `share`.
fn part(body: &BodyChoice, to: NamedPose, share: f64) -> Option<BodyChoice> {
    let built = body.posed(crate::body::Pose::default())?;
    let whole = built.in_named_pose(to)?.pose()?;
    body.posed(built.pose()?.towards(&whole, share))
}
