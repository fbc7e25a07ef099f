//! Lines from marks on the pattern to their partners on the body, across both panes.

use egui::epaint::CubicBezierShape;
use egui::{Color32, Pos2, Stroke, vec2};

use crate::render::mark_colour;
use crate::ui::actions::Tool;
use crate::ui::body_pane::{ScenePane, Seen};
use crate::ui::look::theme::colour;
use crate::ui::pattern_pane::PatternPane;
use crate::wrap::{BodyMark, ClothMark};

/// Opacity of the line of a pair whose mark on the body is visible.
const FAINT: f32 = 0.45;
/// Opacity of the line of a pair whose mark is behind the body.
const HIDDEN: f32 = 0.18;
/// Opacity of the line of the selected pair.
const STRONG: f32 = 0.95;

/// Draws lines of the pairs that a wrap would join: all pairs while marks are painted and nothing is dressed, else only the
/// selected one.
pub fn pair_lines_ui(ui: &egui::Ui, seen: &Seen<'_>, table: &PatternPane, scene: &ScenePane) {
    let (Some(left), Some(right)) = (table.area, scene.area) else { return };
    let towards = (right.center().x - left.center().x).signum();
    let all = seen.cloth.is_none() && matches!(seen.tool, Tool::Mark | Tool::Erase);
    let painter = ui.ctx().layer_painter(ui.layer_id()).with_clip_rect(left.union(right));
    for ((cloth, body), number) in seen.document.marks.pairs().zip(1..) {
        let chosen = seen.selected.is_some_and(|mark| [cloth.id, body.id].contains(&mark));
        if !all && !chosen {
            continue;
        }
        let from = on_table(seen, cloth, table).filter(|at| left.contains(*at));
        let to = scene.place_of(body.points[middle(body)], right).filter(|at| right.contains(*at));
        let (Some(from), Some(to)) = (from, to) else { continue };
        let in_sight = scene.is_in_sight(seen, body.points[middle(body)]);
        let strength = match (chosen, in_sight) {
            (true, _) => STRONG,
            (false, true) => FAINT,
            (false, false) => HIDDEN,
        };
        let ink = colour(mark_colour(number)).gamma_multiply(strength);
        let width = if chosen { 2.2 } else { 1.2 };
        let reach = vec2(towards * (to.x - from.x).abs().max(60.0) * 0.4, 0.0);
        painter.add(CubicBezierShape::from_points_stroke(
            [from, from + reach, to - reach, to],
            false,
            Color32::TRANSPARENT,
            Stroke::new(width, ink),
        ));
        painter.circle_filled(from, width + 1.0, ink);
        painter.circle_filled(to, width + 1.0, ink);
    }
}

fn middle(mark: &BodyMark) -> usize {
    mark.points.len() / 2
}

/// Position on the screen of the middle of a mark on the pattern; None where its piece is hidden.
fn on_table(seen: &Seen<'_>, mark: &ClothMark, table: &PatternPane) -> Option<Pos2> {
    let piece = seen.document.pattern.pieces.get(&mark.piece).filter(|piece| !piece.hidden)?;
    let at = *mark.points.get(mark.points.len() / 2)?;
    Some(table.view.screen_from_table(table.area?, piece.pose.plane_from_piece(at)))
}
