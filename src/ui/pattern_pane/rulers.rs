//! Rulers along the edges of the pane, in the shown unit; guides are dragged out of them.

use egui::accesskit::Role;
use egui::{
    Align2, CursorIcon, FontId, Painter, Pos2, Rect, Response, Sense, Stroke, WidgetInfo, pos2, vec2,
};
use glam::DVec2;

use super::table::Guide;
use super::view::TableView;
use crate::ui::language::tr;
use crate::ui::look::theme::Palette;
use crate::ui::preferences::units::LengthUnit;

/// Width of a ruler, points.
pub const BREADTH: f32 = 18.0;
/// Smallest distance between numbers, points.
const BETWEEN_FIGURES: f64 = 56.0;
/// Smallest distance between lines, points.
const BETWEEN_LINES: f64 = 5.0;

/// The areas of the rulers around a pane.
#[derive(Clone, Copy, Debug)]
pub struct Rulers {
    above: Rect,
    beside: Rect,
}

impl Rulers {
    /// Divides `whole` into rulers and pane.
    pub fn around(whole: Rect) -> (Self, Rect) {
        let pane = Rect::from_min_max(whole.min + vec2(BREADTH, BREADTH), whole.max);
        let above = Rect::from_min_max(pos2(pane.left(), whole.top()), pos2(pane.right(), pane.top()));
        let beside = Rect::from_min_max(pos2(whole.left(), pane.top()), pos2(pane.left(), pane.bottom()));
        (Self { above, beside }, pane)
    }

    /// Draws the rulers. While a guide is dragged out of one, returns it, and whether it was released.
    pub fn ui(
        &self,
        ui: &mut egui::Ui,
        view: &TableView,
        pane: Rect,
        unit: LengthUnit,
        palette: &Palette,
        pointer: Option<Pos2>,
    ) -> Option<(Guide, bool)> {
        let corner = Rect::from_min_max(self.above.left_top() - vec2(BREADTH, 0.0), self.beside.right_top());
        let paper = ui.visuals().panel_fill;
        for rect in [self.above, self.beside, corner] {
            ui.painter().rect_filled(rect, 0.0, paper);
        }
        let font = FontId::proportional(9.5);
        ui.painter().text(corner.center(), Align2::CENTER_CENTER, unit.sign(), font, palette.weak);
        self.figures(ui, view, pane, unit, palette);
        if let Some(at) = pointer {
            let stroke = Stroke::new(1.0, palette.accent);
            ui.painter().vline(at.x, self.above.y_range(), stroke);
            ui.painter().hline(self.beside.x_range(), at.y, stroke);
        }
        let sense = |ui: &mut egui::Ui, rect, (salt, words): (&str, &str), icon| {
            let id = ui.scope_id().with(salt);
            let ruler = ui.interact(rect, id, Sense::drag()).on_hover_cursor(icon);
            ruler.widget_info(|| WidgetInfo::labeled(Role::Group, true, words));
            ruler
        };
        let above =
            sense(ui, self.above, ("above", tr("Ruler above the pattern")), CursorIcon::ResizeVertical);
        let beside =
            sense(ui, self.beside, ("beside", tr("Ruler beside the pattern")), CursorIcon::ResizeHorizontal);
        let dragged = |ruler: &Response| {
            let at = ruler.interact_pointer_pos().map(|at| view.table_from_screen(pane, at));
            at.filter(|_| ruler.dragged() || ruler.drag_stopped())
        };
        let level = dragged(&above).map(|at| (Guide::Level(at.y), above.drag_stopped()));
        level.or_else(|| dragged(&beside).map(|at| (Guide::Upright(at.x), beside.drag_stopped())))
    }

    fn figures(&self, ui: &egui::Ui, view: &TableView, pane: Rect, unit: LengthUnit, palette: &Palette) {
        let (lower, upper) = view.seen(pane);
        let steps = unit.steps();
        let step_for = |least: f64| steps.iter().copied().find(|step| step * view.scale >= least);
        let largest = steps[steps.len() - 1];
        let figures = step_for(BETWEEN_FIGURES).unwrap_or(largest);
        let lines = step_for(BETWEEN_LINES).unwrap_or(largest);
        let font = FontId::proportional(9.5);
        let stroke = Stroke::new(1.0, palette.weak.gamma_multiply(0.55));
        let (across, along) = (ui.painter_at(self.above), ui.painter_at(self.beside));
        each(lower.x, upper.x, lines, |x| {
            let at = view.screen_from_table(pane, DVec2::new(x, 0.0)).x;
            let is_figure = is_multiple(x, figures);
            tick(&across, [pos2(at, self.above.bottom()), vec2(0.0, -1.0).to_pos2()], is_figure, stroke);
            if is_figure {
                let place = pos2(at + 3.0, self.above.top() + 1.0);
                across.text(place, Align2::LEFT_TOP, unit.number(x), font.clone(), palette.weak);
            }
        });
        each(lower.y, upper.y, lines, |y| {
            let at = view.screen_from_table(pane, DVec2::new(0.0, y)).y;
            let is_figure = is_multiple(y, figures);
            tick(&along, [pos2(self.beside.right(), at), vec2(-1.0, 0.0).to_pos2()], is_figure, stroke);
            if is_figure {
                // The text runs upwards, as the ruler is narrow.
                let text = along.layout_no_wrap(unit.number(y), font.clone(), palette.weak);
                let place = pos2(self.beside.left() + 1.0, at - 3.0);
                let shape = egui::epaint::TextShape::new(place, text, palette.weak);
                along.add(shape.with_angle(-std::f32::consts::FRAC_PI_2));
            }
        });
    }
}

fn tick(painter: &Painter, [at, way]: [Pos2; 2], is_figure: bool, stroke: Stroke) {
    let length = if is_figure { BREADTH } else { 5.0 };
    painter.line_segment([at, at + way.to_vec2() * length], stroke);
}

fn each(lower: f64, upper: f64, step: f64, mut at: impl FnMut(f64)) {
    for i in (lower / step).ceil() as i64..=(upper / step).floor() as i64 {
        at(i as f64 * step);
    }
}

fn is_multiple(x: f64, step: f64) -> bool {
    (x / step - (x / step).round()).abs() < 1e-6
}
