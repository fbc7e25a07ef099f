//! Small drawn icons for buttons, which the fonts lack.

use egui::accesskit::Role;
use egui::{Color32, Painter, Pos2, Rect, Sense, Shape, Stroke, Vec2, WidgetInfo, vec2};

/// An icon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    Eye,
    Lock,
    Turn,
    Cross,
}

/// A button that shows only an icon. `on` is the state of the option; the icon is fainter when it is off.
pub fn sign_button(ui: &mut egui::Ui, sign: Sign, on: bool, name: &str, tip: &str) -> bool {
    let (rect, response) = ui.allocate_exact_size(Vec2::new(20.0, 20.0), Sense::click());
    response.widget_info(|| match sign {
        Sign::Eye | Sign::Lock => WidgetInfo::selected(Role::Button, true, on, name),
        Sign::Turn | Sign::Cross => WidgetInfo::labeled(Role::Button, true, name),
    });
    let visuals = ui.style().interact(&response);
    if response.hovered() || response.has_focus() {
        ui.painter().rect_filled(rect, 4.0, visuals.weak_bg_fill);
    }
    let ink = visuals.fg_stroke.color.gamma_multiply(if on { 0.95 } else { 0.4 });
    draw(ui.painter(), rect.shrink(4.0), sign, on, ink);
    response.on_hover_text(tip).clicked()
}

/// Draws an icon into `area`.
pub fn draw(painter: &Painter, area: Rect, sign: Sign, on: bool, ink: Color32) {
    let stroke = Stroke::new(1.4, ink);
    let at = |x: f32, y: f32| area.min + vec2(x, y) * area.size();
    let line = |points: &[[f32; 2]]| {
        let points: Vec<Pos2> = points.iter().map(|p| at(p[0], p[1])).collect();
        painter.add(Shape::line(points, stroke));
    };
    let curve = |points: [[f32; 2]; 4]| {
        let points = points.map(|p| at(p[0], p[1]));
        painter.add(egui::epaint::CubicBezierShape::from_points_stroke(
            points,
            false,
            Color32::TRANSPARENT,
            stroke,
        ));
    };
    match sign {
        Sign::Eye => {
            curve([[0.0, 0.5], [0.28, 0.05], [0.72, 0.05], [1.0, 0.5]]);
            curve([[0.0, 0.5], [0.28, 0.95], [0.72, 0.95], [1.0, 0.5]]);
            if on {
                painter.circle_filled(at(0.5, 0.5), area.width() * 0.17, ink);
            } else {
                line(&[[0.1, 0.95], [0.9, 0.05]]);
            }
        }
        Sign::Lock => {
            let body = Rect::from_min_max(at(0.14, 0.45), at(0.86, 1.0));
            painter.rect(
                body,
                1.5,
                if on { ink } else { Color32::TRANSPARENT },
                stroke,
                egui::StrokeKind::Inside,
            );
            let right = if on { 0.45 } else { 0.2 };
            curve([[0.28, 0.45], [0.26, -0.15], [0.74, -0.15], [0.72, right]]);
        }
        Sign::Turn => {
            line(&[[0.05, 0.3], [0.95, 0.3], [0.7, 0.08]]);
            line(&[[0.95, 0.7], [0.05, 0.7], [0.3, 0.92]]);
        }
        Sign::Cross => {
            line(&[[0.15, 0.15], [0.85, 0.85]]);
            line(&[[0.85, 0.15], [0.15, 0.85]]);
        }
    }
}
