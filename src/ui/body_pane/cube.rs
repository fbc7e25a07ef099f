//! The view cube: it turns with the view, and a click on a side chooses that view.

use egui::accesskit::Role;
use egui::{Align2, FontId, Pos2, Rect, Sense, Shape, Stroke, WidgetInfo};
use glam::{Quat, Vec3};

use crate::render::{Camera, View};
use crate::ui::actions::Action;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::{say, tr};
use crate::ui::look::theme::Palette;

/// Half the length of an edge, points.
const HALF: f32 = 21.0;
/// Distance of the cube's centre from the pane's edges, points.
const FROM_CORNER: f32 = 50.0;

/// A side of the cube: its outward normal, the directions of its letter's right and up, and the letter.
struct Side {
    view: View,
    out: Vec3,
    right: Vec3,
    up: Vec3,
    letter: &'static str,
}

const SIDES: [Side; 6] = [
    Side { view: View::Front, out: Vec3::Z, right: Vec3::X, up: Vec3::Y, letter: "F" },
    Side { view: View::Back, out: Vec3::NEG_Z, right: Vec3::NEG_X, up: Vec3::Y, letter: "B" },
    Side { view: View::Left, out: Vec3::X, right: Vec3::NEG_Z, up: Vec3::Y, letter: "L" },
    Side { view: View::Right, out: Vec3::NEG_X, right: Vec3::Z, up: Vec3::Y, letter: "R" },
    Side { view: View::Top, out: Vec3::Y, right: Vec3::X, up: Vec3::NEG_Z, letter: "T" },
    Side { view: View::Below, out: Vec3::NEG_Y, right: Vec3::X, up: Vec3::Z, letter: "U" },
];

/// Draws the cube in the upper right corner of `pane`.
pub(super) fn view_cube(ui: &mut egui::Ui, pane: Rect, camera: &Camera, palette: &Palette, asks: &mut Asks) {
    let middle = pane.right_top() + egui::vec2(-FROM_CORNER, FROM_CORNER);
    let turn = camera.rotation.inverse();
    let whole = Rect::from_center_size(middle, egui::Vec2::splat(HALF * 3.6));
    let area = ui.interact(whole, ui.scope_id().with("view cube"), Sense::click());
    area.widget_info(|| WidgetInfo::labeled(Role::Group, true, tr("Orientation cube")));
    let under = area.hover_pos().and_then(|at| side_under(at, middle, turn));
    let painter = ui.painter_at(pane);
    for (i, side) in SIDES.iter().enumerate() {
        let facing = (turn * side.out).z;
        let corners = corners(side, middle, turn);
        let centre = on_screen(side.out, middle, turn);
        // Each side is a button for the keyboard and screen readers, even if it faces away.
        let spot = Rect::from_center_size(centre, egui::Vec2::splat(if facing > 0.3 { 12.0 } else { 1.0 }));
        let button = ui.interact(spot, ui.scope_id().with(("side of the view cube", i)), Sense::click());
        let entry = Action::Look(side.view).row();
        button.widget_info(|| {
            WidgetInfo::labeled(
                Role::Button,
                true,
                say!("Orientation cube: {side}", side = tr(entry.text).to_lowercase()),
            )
        });
        let hot = under == Some(i) || button.hovered() || button.has_focus();
        let clicked = button.clicked() || (area.clicked() && under == Some(i));
        if clicked {
            asks.push(Ask::Act(Action::Look(side.view)));
        }
        if facing > 0.02 {
            let fill = if hot { palette.accent } else { palette.overlay };
            let ink = if hot { palette.on_accent } else { palette.weak };
            painter.add(Shape::convex_polygon(
                corners.to_vec(),
                fill,
                Stroke::new(1.2, palette.weak.gamma_multiply(0.7)),
            ));
            if facing > 0.35 {
                let font = FontId::proportional(8.0 + 7.0 * facing);
                painter.text(centre, Align2::CENTER_CENTER, tr(side.letter), font, ink);
            }
        }
    }
    if let Some(i) = under {
        area.on_hover_text(SIDES[i].view_tip()).on_hover_cursor(egui::CursorIcon::PointingHand);
    }
}

impl Side {
    fn view_tip(&self) -> &'static str {
        tr(Action::Look(self.view).row().tip)
    }
}

fn on_screen(p: Vec3, middle: Pos2, turn: Quat) -> Pos2 {
    let p = turn * p * HALF;
    middle + egui::vec2(p.x, -p.y)
}

fn corners(side: &Side, middle: Pos2, turn: Quat) -> [Pos2; 4] {
    let at = |x: f32, y: f32| on_screen(side.out + side.right * x + side.up * y, middle, turn);
    [at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)]
}

/// The side under a point of the screen.
fn side_under(at: Pos2, middle: Pos2, turn: Quat) -> Option<usize> {
    SIDES.iter().position(|side| {
        let corners = corners(side, middle, turn);
        let left_of = |i: usize| {
            let (a, b) = (corners[i], corners[(i + 1) % 4]);
            let (along, to) = (b - a, at - a);
            // y points down on the screen, so a side that faces the eye has the opposite orientation.
            along.x * to.y - along.y * to.x < 0.0
        };
        (turn * side.out).z > 0.02 && (0..4).all(left_of)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_side_is_hit_from_where_it_is_seen() {
        let middle = Pos2::new(100.0, 50.0);
        for (i, side) in SIDES.iter().enumerate() {
            let mut camera = Camera::default();
            camera.look(side.view);
            let turn = camera.rotation.inverse();
            assert_eq!(side_under(middle, middle, turn), Some(i), "{:?}", side.view);
            let up = turn * side.up;
            assert!((up - Vec3::Y).length() < 1e-5, "the letter stands upright: {up}");
            assert_eq!(side_under(middle + egui::vec2(HALF * 1.2, 0.0), middle, turn), None);
        }
        let mut camera = Camera::default();
        camera.look(View::Angles { yaw: 45.0, pitch: 20.0 });
        let turn = camera.rotation.inverse();
        for (offset, letter) in
            [(egui::vec2(-12.0, 4.0), "F"), (egui::vec2(12.0, 4.0), "L"), (egui::vec2(0.0, -20.0), "T")]
        {
            let side = side_under(middle + offset, middle, turn).expect("a side");
            assert_eq!(SIDES[side].letter, letter);
        }
    }
}
