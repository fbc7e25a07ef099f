//! Draws the picture of the scene in its pane.

use std::sync::Arc;

use egui::{Align2, Color32, FontId, Pos2, Rect};
use glam::{DVec2, UVec2};

use super::outlines::outlines;
use super::{Key, ScenePane, Seen};
use crate::geometry::ids::{MarkId, PieceId};
use crate::pattern::activity::Activity;
use crate::render::{Look, Quality};
use crate::session::Pin;
use crate::ui::language::pictures::reason;
use crate::ui::language::tr;
use crate::ui::scenery::fabric_looks::looks_of;
use crate::ui::scenery::ring::ring;
use crate::ui::scenery::scene::{PinLook, Shown};

/// The look of each pin.
fn pin_looks(seen: &Seen<'_>) -> Vec<PinLook> {
    let look = |pin: &Pin| PinLook { locked: pin.locked, selected: seen.selected_pins.contains(&pin.id) };
    seen.document.pins.iter().map(look).collect()
}

/// Scale of pictures while things move, with software rendering.
const DRAFT: f32 = 0.8;

/// Draws a text in the middle of the pane.
fn tell(painter: &egui::Painter, words: &str, ink: Color32) {
    let font = FontId::proportional(14.0);
    painter.text(painter.clip_rect().center(), Align2::CENTER_CENTER, words, font, ink);
}

impl ScenePane {
    /// Emphasised lines on the cloth: those of the pattern, the ring round a place, and the line being drawn.
    fn emphasised(&self, seen: &Seen<'_>) -> Vec<(PieceId, Vec<DVec2>)> {
        if seen.cloth.is_none() {
            return Vec::new();
        }
        let pattern = &seen.document.pattern;
        let lines = outlines(pattern, seen.stand_out).into_iter().chain(seen.spot.map(ring));
        lines.chain(self.line_shown(pattern)).collect()
    }

    pub(super) fn draw(&mut self, ui: &egui::Ui, seen: &Seen<'_>, near: Option<MarkId>, pane: Rect) {
        let painter = ui.painter_at(pane);
        let [stroke, far_stroke] = self.strokes().cloned().unwrap_or_default();
        let bones = self.shown_bones(seen);
        let emphasised = self.emphasised(seen);
        // While a line follows the pointer over the cloth, each motion needs another picture.
        let follows = self.is_drawing_line() && ui.input(|i| i.pointer.is_moving());
        let Some(graphics) = &mut self.graphics else {
            let words = tr("No graphics adapter: the body cannot be shown.");
            return tell(&painter, words, seen.palette.weak);
        };
        let draft = graphics.is_slow() && (self.moving || seen.working || follows || !stroke.is_empty());
        let scale = ui.ctx().pixels_per_point() * if draft { DRAFT } else { 1.0 };
        let pixels = (pane.size() * scale).round();
        let key = Key {
            camera: self.camera,
            look: Look { pixels_per_point: scale, ..seen.look },
            quality: if draft { Quality::Draft } else { Quality::Finished },
            size: UVec2::new(pixels.x.max(1.0) as u32, pixels.y.max(1.0) as u32),
            body: seen.body.cloned(),
            body_look: seen.body_look,
            plain_seams: seen.plain_seams,
            cloth: seen.cloth.map(|(_, state)| Arc::clone(state)),
            marks: Some(Arc::clone(&seen.document.marks)),
            stroke: stroke.len() + far_stroke.len(),
            near,
            pinned: Some(Arc::clone(seen.pinned)),
            pins: pin_looks(seen),
            bones,
            pattern: Arc::clone(&seen.document.pattern),
            activities: seen.document.pattern.activities(),
            looks: Arc::new(looks_of(seen.document)),
            dragged: seen.dragged.cloned(),
            map: seen.map.map(|map| Arc::clone(&map.colours)),
            beside: seen.beside.cloned(),
            selected: seen.selected,
            ghosts: seen.ghosts.cloned(),
            outlines: emphasised,
        };
        let (pins, bones, activities) = (key.pins.clone(), key.bones.clone(), key.activities.clone());
        let looks = Arc::clone(&key.looks);
        let outlines = key.outlines.clone();
        let shown = Shown {
            body: seen.body,
            body_look: seen.body_look,
            plain_seams: seen.plain_seams,
            cloth: seen.cloth,
            pattern: Some(&seen.document.pattern),
            marks: Some(&seen.document.marks),
            stroke: &stroke,
            far_stroke: &far_stroke,
            near,
            pinned: seen.pinned,
            pins: &pins,
            bones: &bones,
            activities: Some(&activities),
            looks: Some(&looks),
            whole: seen.whole.filter(|_| activities.values().any(Activity::is_deactivated)),
            dragged: seen.dragged,
            map: seen.map.map(|map| &map.colours),
            beside: seen.beside.map_or(&[], |meshes| meshes),
            selected: seen.selected,
            ghosts: seen.ghosts.map(|g| &**g),
            outlines: &outlines,
        };
        match graphics.picture(key, || self.scenery.scene(&shown)) {
            Ok(texture) => {
                let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
                painter.image(texture, pane, whole, Color32::WHITE);
            }
            Err(error) => tell(&painter, &reason(&error), seen.palette.error),
        }
        if draft {
            // The finished picture follows as soon as nothing moves.
            ui.ctx().request_repaint_after(std::time::Duration::from_millis(120));
        }
    }
}
