//! The section for the joints of the mannequin: a list, and a slider for each axis of the chosen joint.

use egui::{Button, ComboBox, RichText};
use glam::DVec3;

use crate::body::Pose;
use crate::body::pose::anatomy::{Anatomy, Limb, mirrored_to_the_right};
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::fields::slider;
use crate::ui::language::tr;
use crate::ui::list::list_ui;
use crate::ui::panels::context::PanelContext;
use crate::ui::panels::pose_slider::{follow, let_go, posed};

/// Width of the list, points.
const WIDTH: f32 = 150.0;

/// The chosen joint, and the angles set last.
#[derive(Debug)]
pub struct JointPanel {
    limb: Limb,
    /// The last rotation that was set with its angles, in degrees: where two axes of a joint coincide, the rotation alone does
    /// not determine the angles.
    given: Option<(DVec3, [f64; 3])>,
    /// Whether a slider is being dragged; the body may lag behind it.
    dragged: bool,
}

impl Default for JointPanel {
    fn default() -> Self {
        let elbow = Limb::all().find(|limb| limb.joint == "elbow_left");
        let limb = elbow.unwrap_or(Limb { joint: "elbow_left", movements: &[] });
        Self { limb, given: None, dragged: false }
    }
}

impl JointPanel {
    /// Draws list, sliders and buttons; nothing for a body without joints.
    pub fn ui(&mut self, ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
        let body = &told.document.body;
        let (Some(anatomy), Some(pose)) = (body.anatomy(), body.pose()) else { return };
        ui.add_space(4.0);
        self.list_ui(ui);
        self.sliders_ui(ui, told, (&anatomy, &pose), asks);
        ui.horizontal(|ui| {
            let mut button = |text: &str, tip: &str, new: Pose| {
                let button = ui.add_enabled(new != pose, Button::new(text).small()).on_hover_text(tip);
                if button.clicked() {
                    asks.extend(body.posed(new).map(|body| Ask::Do(posed(body, false))));
                }
            };
            let mut reset = pose.clone();
            reset.set(self.limb.joint, DVec3::ZERO);
            button(tr("Reset joint"), tr("As the mannequin was built"), reset);
            let tip = tr("Turns every joint of the right side as that of the left");
            button(tr("Mirror left to right"), tip, mirrored_to_the_right(&pose));
        });
    }

    fn list_ui(&mut self, ui: &mut egui::Ui) {
        let chosen = self.limb.title();
        let combo = ComboBox::from_label(tr("Joint")).selected_text(tr(&chosen)).width(WIDTH);
        list_ui(ui, combo.height(360.0), |entries| {
            for limb in Limb::all() {
                if entries.add(limb == self.limb, tr(&limb.title())).clicked() {
                    (self.limb, self.given) = (limb, None);
                }
            }
        });
    }

    fn sliders_ui(
        &mut self,
        ui: &mut egui::Ui,
        told: &PanelContext<'_>,
        (anatomy, pose): (&Anatomy, &Pose),
        asks: &mut Asks,
    ) {
        let limb = self.limb;
        let turn = pose.turns.get(limb.joint).copied().unwrap_or_default();
        let given = self.given.filter(|(given, _)| self.dragged || *given == turn);
        let angles = given.map_or_else(|| anatomy.angles(pose, limb), |(_, angles)| angles);
        self.dragged = false;
        for movement in limb.movements {
            ui.label(RichText::new(tr(movement.title)).color(told.palette.weak).size(12.5));
            let [least, largest] = movement.range;
            let mut degrees = angles[movement.axis as usize];
            let field = slider(&mut degrees, least..=largest).suffix("°").max_decimals(0);
            let response = ui.add(field);
            let words = format!("{}: {}", tr(&limb.title()), tr(movement.title));
            response.widget_info(|| egui::WidgetInfo::slider(true, degrees, words.clone()));
            self.dragged |= response.dragged();
            let mut new = angles;
            new[movement.axis as usize] = degrees;
            let mut turned = pose.clone();
            anatomy.set(&mut turned, limb, new);
            // Angles that are each in range may together exceed what the joint allows.
            if turned.problem().is_some() {
                continue;
            }
            if response.changed() {
                self.given = Some((anatomy.turn(limb, new), new));
            }
            let body = &told.document.body;
            if let (Some(done), Some(new)) = (let_go(&response, told), body.posed(turned))
                && (done || new != *body)
            {
                follow(posed(new, !done), done, asks);
            }
        }
    }
}
