//! The tool that draws bones inside the body.

use egui::{Pos2, Rect};
use glam::DVec3;

use super::sight::REACH;
use super::{Drag, ScenePane, Seen};
use crate::contact::Bone;
use crate::session::Command;
use crate::ui::actions::asks::{Ask, Asks};

/// Shortest bone, metres on a body 1.5 m tall; a shorter one was drawn by accident.
const SHORTEST: f64 = 0.01;

impl ScenePane {
    /// The point halfway through the body under a point of the screen: the middle between where a ray enters and where it first
    /// leaves.
    pub(super) fn within_body(&self, seen: &Seen<'_>, pane: Rect, at: Pos2) -> Option<DVec3> {
        let (body, ray) = (seen.body?, self.ray(pane, at));
        let direction = ray.direction.normalize_or_zero();
        let entry = body.ray(ray.origin, direction)?.point;
        let inside = entry + direction * (1e-4 * body.scale());
        Some(entry.midpoint(body.ray(inside, direction)?.point))
    }

    /// Moves the end of the bone being drawn to the pointer.
    pub(super) fn draw_bone(&mut self, seen: &Seen<'_>, pane: Rect, at: Option<Pos2>) {
        let end = at.and_then(|at| self.within_body(seen, pane, at));
        if let (Some(Drag::Bone(bone)), Some(end)) = (&mut self.drag, end) {
            bone[1] = end;
        }
    }

    /// Adds the drawn bone to the document.
    pub(super) fn end_bone(&mut self, seen: &Seen<'_>, bone: Bone, asks: &mut Asks) {
        let scale = seen.body.map_or(1.0, |body| body.scale());
        if bone[0].distance(bone[1]) >= SHORTEST * scale {
            let bones = seen.bones.iter().copied().chain([bone]).collect();
            asks.push(Ask::Do(Command::SetBones { bones: Some(bones) }));
        }
    }

    /// Deletes the bone under the pointer, on a Ctrl+click.
    pub(super) fn delete_bone(&self, seen: &Seen<'_>, pane: Rect, at: Pos2) -> Option<Ask> {
        let away = |bone: &Bone| {
            let [a, b] = bone.map(|p| self.place_of(p, pane));
            let (a, b) = (a?, b?);
            let along = b - a;
            let t = ((at - a).dot(along) / along.length_sq().max(1e-6)).clamp(0.0, 1.0);
            Some((a + along * t).distance(at))
        };
        let distances = seen.bones.iter().enumerate().filter_map(|(i, bone)| Some((i, away(bone)?)));
        let (near, _) = distances.filter(|(_, d)| *d <= REACH).min_by(|a, b| a.1.total_cmp(&b.1))?;
        let others = seen.bones.iter().enumerate().filter(|(i, _)| *i != near).map(|(_, bone)| *bone);
        Some(Ask::Do(Command::SetBones { bones: Some(others.collect()) }))
    }

    /// The bones of the document and the one being drawn.
    pub(super) fn shown_bones(&self, seen: &Seen<'_>) -> Vec<Bone> {
        let drawn = match self.drag {
            Some(Drag::Bone(bone)) => Some(bone),
            _ => None,
        };
        seen.bones.iter().copied().chain(drawn).collect()
    }
}
