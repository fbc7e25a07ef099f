//! Marks: numbered strokes on cloth and body. The n-th on the cloth is laid on the n-th on the body.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

use crate::geometry::ids::{MarkId, PieceId};

/// Side of the cloth on which a stroke was painted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ClothSide {
    /// The outer side.
    #[default]
    Front,
    /// The inner side.
    Back,
}

/// A stroke on a piece.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClothMark {
    /// Id. The number of the stroke is its position in the list, from 1.
    pub id: MarkId,
    /// The piece that the stroke is on.
    pub piece: PieceId,
    /// The side on which the stroke was painted.
    #[serde(default)]
    pub side: ClothSide,
    /// Polyline in the piece's own plane, metres; at least one point.
    pub points: Vec<DVec2>,
}

/// A stroke on the body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodyMark {
    /// Id. The number of the stroke is its position in the list, from 1.
    pub id: MarkId,
    /// Polyline on the body's surface, metres; at least one point.
    pub points: Vec<DVec3>,
}

/// All strokes, in painting order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Marks {
    /// Strokes on the cloth.
    pub cloth: Vec<ClothMark>,
    /// Strokes on the body.
    pub body: Vec<BodyMark>,
    /// Names that people gave to strokes; strokes without a name are not listed.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub names: BTreeMap<MarkId, String>,
    /// For strokes on the body how each of their points is bound to the skin. Set by the session; a stroke from
    /// elsewhere has none until it is needed.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub ties: BTreeMap<MarkId, Vec<Tie>>,
}

/// Binding of a point to the skin of a body, by which it is found again when the body moves or is replaced.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tie {
    /// Triangle of the body's mesh.
    pub triangle: u32,
    /// Barycentric coordinates in that triangle.
    pub weights: DVec3,
    /// The landmark that the point stands for, if it is near one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub landmark: Option<String>,
}

impl Marks {
    /// Only the pairs with these numbers (from 1), in their order; all strokes when `numbers` is empty.
    pub fn only(&self, numbers: &[usize]) -> Self {
        if numbers.is_empty() {
            return self.clone();
        }
        let taken = |i: usize| numbers.contains(&(i + 1));
        let (cloth, body) = self
            .pairs()
            .enumerate()
            .filter(|(i, _)| taken(*i))
            .map(|(_, (c, b))| (c.clone(), b.clone()))
            .unzip();
        Self { cloth, body, ..Self::default() }
    }

    /// Strokes that have a partner, in order of their numbers.
    pub fn pairs(&self) -> impl Iterator<Item = (&ClothMark, &BodyMark)> {
        self.cloth.iter().zip(&self.body)
    }

    /// Ids of all strokes, those on the cloth first.
    pub fn ids(&self) -> impl Iterator<Item = MarkId> {
        self.cloth.iter().map(|m| m.id).chain(self.body.iter().map(|m| m.id))
    }

    /// The name of a stroke; empty when it has none.
    pub fn name(&self, mark: MarkId) -> &str {
        self.names.get(&mark).map_or("", String::as_str)
    }

    /// The first landmark that a stroke on the body passes, if any.
    pub fn landmark(&self, mark: MarkId) -> Option<&str> {
        self.ties.get(&mark)?.iter().find_map(|tie| tie.landmark.as_deref())
    }

    /// Position of a stroke in its list: its side, its number from 1, and the number of strokes on that side.
    pub fn place(&self, mark: MarkId) -> Option<MarkPlace> {
        let [cloth, body] =
            [self.cloth.iter().position(|m| m.id == mark), self.body.iter().position(|m| m.id == mark)];
        let on_cloth = cloth.is_some();
        let count = if on_cloth { self.cloth.len() } else { self.body.len() };
        Some(MarkPlace { on_cloth, number: cloth.or(body)? + 1, count })
    }

    /// Drops names and bindings of strokes that no longer exist.
    pub fn prune(&mut self) {
        let ids: Vec<MarkId> = self.ids().collect();
        self.names.retain(|id, _| ids.contains(id));
        self.ties.retain(|id, _| ids.contains(id));
    }
}

/// Position of a stroke in its list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MarkPlace {
    /// Whether the stroke is on the cloth, not on the body.
    pub on_cloth: bool,
    /// Number of the stroke, from 1.
    pub number: usize,
    /// Number of strokes on the same side.
    pub count: usize,
}

impl std::fmt::Display for MarkPlace {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let side = if self.on_cloth { "cloth" } else { "body" };
        write!(f, "mark {} on the {side}", self.number)
    }
}
