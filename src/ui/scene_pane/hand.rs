//! Dragging and pinning dressed cloth with the pointer.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::cloth::FlatPiece;
use crate::drag::{DragMode, Ray};
use crate::geometry::ids::{PieceId, PinId};
use crate::session::{Command, Pin};
use crate::sim::ClothPlace;
use crate::ui::actions::Tool;
use crate::ui::asks::Ask;
use crate::ui::pick::{ClothHit, cloth_under};
use crate::ui::scene_pane::Seen;

/// Pins of a row stand this far apart, metres on a body 1.5 m large.
const ROW_STEP: f64 = 0.03;

/// The cloth under a ray, if the body is not before it.
pub fn cloth_at(seen: &Seen<'_>, ray: Ray) -> Option<ClothHit> {
    let (garment, state) = seen.cloth?;
    let hit = cloth_under(garment, state, &ray)?;
    let skin = seen.body.and_then(|b| b.ray(ray.origin, ray.direction));
    skin.is_none_or(|skin| skin.distance > hit.distance - 1e-3).then_some(hit)
}

/// What begins when the button goes down on cloth with one of the tools of the hand.
pub fn begun(seen: &Seen<'_>, hit: &ClothHit) -> Ask {
    let (piece, at) = (hit.place.piece, hit.place.at);
    Ask::Drag(match seen.tool {
        Tool::Pin => Command::AddPin { piece, at },
        Tool::Drag(mode) => Command::Grab { piece, at, mode },
        _ => Command::Grab { piece, at, mode: DragMode::Surface },
    })
}

/// The next pin of a row whose last one is at `last`, when the pointer has come far enough.
pub fn next_in_row(seen: &Seen<'_>, last: DVec3, hit: &ClothHit) -> Option<Ask> {
    let scale = seen.body.map_or(1.0, |b| b.scale());
    (hit.point.distance(last) > ROW_STEP * scale)
        .then_some(Ask::Drag(Command::AddPin { piece: hit.place.piece, at: hit.place.at }))
}

/// The pins of the document with the places of the cloth they hold. Where the simulation has found them may be of pins
/// there were before: their own places count.
pub fn pins(seen: &Seen<'_>) -> Vec<(PinId, DVec3)> {
    let Some((garment, state)) = seen.cloth else { return Vec::new() };
    let mut pieces: BTreeMap<PieceId, FlatPiece> = BTreeMap::new();
    let mut place = |pin: &Pin| {
        let ClothPlace { piece, at } = pin.place;
        let flat = pieces.entry(piece).or_insert_with(|| FlatPiece::new(garment, piece));
        Some((pin.id, flat.nearest(garment, at)?.point(garment, state)?))
    };
    seen.document.pins.iter().filter_map(&mut place).collect()
}
