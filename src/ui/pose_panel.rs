//! The section of the side panel that poses the mannequin.

use egui::{Button, Slider};

use crate::body::NamedPose;
use crate::session::{BodyChoice, Command};
use crate::ui::asks::{Ask, Asks};
use crate::ui::joint_panel::JointPanel;
use crate::ui::side_panel::Told;

/// Which pose was chosen last, and how far the mannequin has gone to it.
#[derive(Debug)]
pub struct PosePanel {
    to: NamedPose,
    share: f64,
    joints: JointPanel,
}

impl Default for PosePanel {
    fn default() -> Self {
        Self { to: NamedPose::Standing, share: 0.0, joints: JointPanel::default() }
    }
}

impl PosePanel {
    /// Draws the section.
    pub fn ui(&mut self, ui: &mut egui::Ui, told: &Told<'_>, asks: &mut Asks) {
        let body = &told.document.body;
        if body.measurements().is_none() {
            let words =
                "The body is from a file: it takes the poses that other files of it have (toile repose).";
            ui.add(egui::Label::new(egui::RichText::new(words).color(told.palette.weak)).wrap());
            return;
        }
        let enabled = !told.now.wrapping && !told.now.demo;
        ui.add_enabled_ui(enabled, |ui| {
            self.names_ui(ui, body, asks);
            self.way_ui(ui, told, asks);
            self.joints.ui(ui, told, asks);
        });
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
                let button = ui.add(Button::selectable(is_taken, pose.title()).min_size(size));
                let words = format!("Pose {}", pose.title());
                button.widget_info(|| {
                    egui::WidgetInfo::selected(egui::accesskit::Role::Button, true, is_taken, words.clone())
                });
                if button.clicked() {
                    (self.to, self.share) = (pose, 1.0);
                    asks.extend(whole(body, pose).map(|body| Ask::Do(posed(body, false))));
                }
                if i % 2 == 1 {
                    ui.end_row();
                }
            }
        });
    }

    /// A slider from the built pose to the chosen one.
    fn way_ui(&mut self, ui: &mut egui::Ui, told: &Told<'_>, asks: &mut Asks) {
        if self.to == NamedPose::A {
            return;
        }
        let text = format!("On the way to {}", self.to.title());
        ui.label(egui::RichText::new(&text).color(told.palette.weak).size(12.5));
        let mut percent = (self.share * 100.0).round();
        let response = ui.add(Slider::new(&mut percent, 0.0..=100.0).suffix(" %").step_by(1.0));
        response.widget_info(|| egui::WidgetInfo::slider(true, percent, "On the way to the pose"));
        if response.changed() {
            self.share = percent / 100.0;
        }
        follow_ui(&response, told, || part(&told.document.body, self.to, self.share), asks);
    }
}

/// The body goes along with a slider. While it is dragged the cloth follows as quickly as it can; where it is let go, it
/// follows exactly.
pub fn follow_ui(
    slider: &egui::Response,
    told: &Told<'_>,
    body: impl FnOnce() -> Option<BodyChoice>,
    asks: &mut Asks,
) {
    let done = slider.drag_stopped() || (slider.changed() && !slider.dragged());
    let follow = slider.dragged() && slider.changed() && told.now.caught_up;
    if !done && !follow {
        return;
    }
    let Some(body) = body() else { return };
    // What was shown as a draft is done again with care.
    if body != told.document.body || done {
        asks.push(Ask::Drag(posed(body, !done)));
    }
    if done {
        asks.push(Ask::EndDrag);
    }
}

/// Asks for the dressed body in another pose.
pub fn posed(body: BodyChoice, draft: bool) -> Command {
    Command::Repose { body, settle: false, draft }
}

/// The body in a pose with a name, unless it is in it.
fn whole(body: &BodyChoice, pose: NamedPose) -> Option<BodyChoice> {
    body.in_named_pose(pose).filter(|posed| posed != body)
}

/// The body between the built pose and another.
fn part(body: &BodyChoice, to: NamedPose, share: f64) -> Option<BodyChoice> {
    let built = body.posed(crate::body::Pose::default())?;
    let whole = built.in_named_pose(to)?.pose()?;
    body.posed(built.pose()?.towards(&whole, share))
}
