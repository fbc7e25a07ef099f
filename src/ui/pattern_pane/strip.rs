//! The strip of tool buttons beside the table.

use egui::{Painter, Pos2, Rect, Sense, Shape, Stroke, UiBuilder, Vec2, WidgetInfo, pos2, vec2};

use super::Laid;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::actions::{Action, PATTERN_TOOLS, Tool};
use crate::ui::language::keys::shortcut_text;
use crate::ui::language::tr;

/// Width of the strip, points.
const BREADTH: f32 = 36.0;
/// Size of a button, points.
const SIZE: f32 = 28.0;

/// Divides `whole` into strip and remaining area.
pub fn beside(whole: Rect) -> (Rect, Rect) {
    whole.split_left_right_at_x(whole.left() + BREADTH)
}

/// Draws the strip.
pub fn strip_ui(ui: &mut egui::Ui, strip: Rect, laid: &Laid<'_>, asks: &mut Asks) {
    ui.painter().rect_filled(strip, 0.0, ui.visuals().panel_fill);
    let room = strip.shrink2(vec2((BREADTH - SIZE) / 2.0, 6.0));
    ui.scope_builder(
        UiBuilder::new().max_rect(room).layout(egui::Layout::top_down(egui::Align::Center)),
        |ui| {
            ui.spacing_mut().item_spacing.y = 2.0;
            for (i, group) in PATTERN_TOOLS.iter().enumerate() {
                if i > 0 {
                    ui.add_space(3.0);
                    let line = ui.allocate_space(vec2(SIZE - 8.0, 1.0)).1;
                    ui.painter().rect_filled(line, 0.0, ui.visuals().widgets.noninteractive.bg_stroke.color);
                    ui.add_space(3.0);
                }
                for &tool in *group {
                    button(ui, laid, tool, asks);
                }
            }
        },
    );
}

fn button(ui: &mut egui::Ui, laid: &Laid<'_>, tool: Tool, asks: &mut Asks) {
    let action = Action::Choose(tool);
    let entry = action.row();
    let (rect, response) = ui.allocate_exact_size(Vec2::splat(SIZE), Sense::click());
    let chosen = laid.tool == tool;
    let name = tr(entry.text);
    response.widget_info(|| WidgetInfo::selected(egui::accesskit::Role::Button, true, chosen, name));
    let visuals = ui.style().interact_selectable(&response, chosen);
    if chosen || response.hovered() || response.has_focus() {
        ui.painter().rect(rect, 5.0, visuals.weak_bg_fill, visuals.bg_stroke, egui::StrokeKind::Inside);
    }
    sign(ui.painter(), rect.shrink(6.0), tool, Stroke::new(1.5, visuals.text_color()));
    let keys = entry.keys.first().map(|k| format!("  ({})", shortcut_text(ui.ctx(), k)));
    let response = response.on_hover_text(format!("{name}: {}{}", tr(entry.tip), keys.unwrap_or_default()));
    if response.clicked() {
        asks.push(Ask::Act(action));
    }
}

/// Draws the icon of a tool, in coordinates from (0, 0), upper left, to (1, 1).
fn sign(painter: &Painter, area: Rect, tool: Tool, stroke: Stroke) {
    let at = |x: f32, y: f32| area.min + vec2(x, y) * area.size();
    let line = |points: &[[f32; 2]]| {
        let points: Vec<Pos2> = points.iter().map(|p| at(p[0], p[1])).collect();
        painter.add(Shape::line(points, stroke));
    };
    let knob = |x: f32, y: f32| {
        painter.rect_filled(Rect::from_center_size(at(x, y), Vec2::splat(5.0)), 1.0, stroke.color);
    };
    let curve = |points: [[f32; 2]; 4]| {
        let points = points.map(|p| at(p[0], p[1]));
        let none = egui::Color32::TRANSPARENT;
        painter.add(egui::epaint::CubicBezierShape::from_points_stroke(points, false, none, stroke));
    };
    match tool {
        Tool::Move => line(&[
            [0.2, 0.0],
            [0.2, 0.85],
            [0.42, 0.64],
            [0.58, 1.0],
            [0.72, 0.93],
            [0.57, 0.6],
            [0.85, 0.58],
            [0.2, 0.0],
        ]),
        Tool::Points => {
            curve([[0.05, 0.9], [0.1, 0.3], [0.5, 0.1], [0.95, 0.1]]);
            knob(0.05, 0.9);
            knob(0.95, 0.1);
            line(&[[0.05, 0.9], [0.1, 0.25]]);
            painter.circle_filled(at(0.1, 0.25), 2.2, stroke.color);
        }
        Tool::Pen => {
            line(&[[0.0, 1.0], [0.12, 0.6], [0.68, 0.04], [0.96, 0.32], [0.4, 0.88], [0.0, 1.0]]);
            line(&[[0.55, 0.17], [0.83, 0.45]]);
        }
        Tool::Rectangle => line(&[[0.0, 0.15], [1.0, 0.15], [1.0, 0.85], [0.0, 0.85], [0.0, 0.13]]),
        Tool::Ellipse => {
            painter.add(egui::epaint::EllipseShape::stroke(
                area.center(),
                area.size() * vec2(0.52, 0.4),
                stroke,
            ));
        }
        Tool::Sew => {
            curve([[0.0, 0.3], [0.3, 0.05], [0.7, 0.05], [1.0, 0.3]]);
            curve([[0.0, 0.75], [0.3, 1.0], [0.7, 1.0], [1.0, 0.75]]);
            for x in [0.18, 0.5, 0.82] {
                line(&[[x, 0.2], [x, 0.86]]);
            }
        }
        Tool::Line => {
            painter.extend(Shape::dashed_line(&[at(0.05, 0.95), at(0.95, 0.05)], stroke, 3.0, 2.5));
            knob(0.05, 0.95);
            knob(0.95, 0.05);
        }
        Tool::Hole => {
            line(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0]]);
            painter.circle_stroke(area.center(), area.width() * 0.24, stroke);
        }
        Tool::Cut => {
            painter.circle_stroke(at(0.2, 0.84), area.width() * 0.15, stroke);
            painter.circle_stroke(at(0.8, 0.84), area.width() * 0.15, stroke);
            line(&[[0.28, 0.7], [0.78, 0.0]]);
            line(&[[0.72, 0.7], [0.22, 0.0]]);
        }
        Tool::Dart => line(&[[0.0, 0.95], [0.3, 0.95], [0.5, 0.1], [0.7, 0.95], [1.0, 0.95]]),
        Tool::Notch => {
            line(&[[0.0, 0.75], [1.0, 0.75]]);
            line(&[[0.5, 0.75], [0.5, 0.25]]);
        }
        Tool::Grain => line(&[[0.25, 0.28], [0.5, 0.0], [0.5, 1.0], [0.5, 0.0], [0.75, 0.28]]),
        Tool::Graphic => picture_sign(painter, area, stroke),
        Tool::Mark | Tool::Erase | Tool::Drag(_) | Tool::Pin | Tool::ClothLine | Tool::Bone | Tool::Place => {
            painter.circle_filled(pos2(area.center().x, area.center().y), 3.0, stroke.color);
        }
    }
}

/// Draws a framed picture of hills and a sun.
fn picture_sign(painter: &Painter, area: Rect, stroke: Stroke) {
    let at = |x: f32, y: f32| area.min + vec2(x, y) * area.size();
    let frame = [[0.0, 0.1], [1.0, 0.1], [1.0, 0.9], [0.0, 0.9], [0.0, 0.1]];
    let hills = [[0.1, 0.8], [0.4, 0.4], [0.6, 0.65], [0.72, 0.52], [0.9, 0.8]];
    for line in [frame, hills] {
        painter.add(Shape::line(line.map(|[x, y]| at(x, y)).to_vec(), stroke));
    }
    painter.circle_filled(at(0.7, 0.3), 2.0, stroke.color);
}
