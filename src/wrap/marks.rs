//! Numbered strokes on cloth and body. The n-th on the cloth meets the n-th on the body.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

use crate::geometry::ids::{MarkId, PieceId};

/// Which side of the cloth a stroke was painted on.
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
    /// Its id; its number is its place in the list, from 1.
    pub id: MarkId,
    /// The piece it lies on.
    pub piece: PieceId,
    /// The side it was painted on.
    #[serde(default)]
    pub side: ClothSide,
    /// Polyline in the piece's own plane, metres; at least one point.
    pub points: Vec<DVec2>,
}

/// A stroke on the body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodyMark {
    /// Its id; its number is its place in the list, from 1.
    pub id: MarkId,
    /// Polyline on the body's surface, metres; at least one point.
    pub points: Vec<DVec3>,
}

/// All strokes, in painting order.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Marks {
    /// On the cloth.
    pub cloth: Vec<ClothMark>,
    /// On the body.
    pub body: Vec<BodyMark>,
    /// Names people gave to strokes; one without a name is not in it.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub names: BTreeMap<MarkId, String>,
    /// How each point of a stroke on the body is tied to the body's skin. Told by the session; a stroke that came from
    /// elsewhere has none until it is needed.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub ties: BTreeMap<MarkId, Vec<Tie>>,
}

/// Where a point lies on a body, so that it can be found again when the body moves or another takes its place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tie {
    /// The body's triangle.
    pub triangle: u32,
    /// Barycentric weights of its corners.
    pub weights: DVec3,
    /// The named point it stands for, if it is near one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub landmark: Option<String>,
}

impl Marks {
    /// Only the pairs with these numbers (from 1), in their order; all of them when there is none.
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

    /// The first landmark a stroke on the body passes.
    pub fn landmark(&self, mark: MarkId) -> Option<&str> {
        self.ties.get(&mark)?.iter().find_map(|tie| tie.landmark.as_deref())
    }

    /// Where a stroke stands: whether on the cloth, its number from 1, and how many strokes that side has.
    pub fn place(&self, mark: MarkId) -> Option<MarkPlace> {
        let [cloth, body] =
            [self.cloth.iter().position(|m| m.id == mark), self.body.iter().position(|m| m.id == mark)];
        let on_cloth = cloth.is_some();
        let count = if on_cloth { self.cloth.len() } else { self.body.len() };
        Some(MarkPlace { on_cloth, number: cloth.or(body)? + 1, count })
    }

    /// Forgets what is told of strokes that are gone.
    pub fn prune(&mut self) {
        let ids: Vec<MarkId> = self.ids().collect();
        self.names.retain(|id, _| ids.contains(id));
        self.ties.retain(|id, _| ids.contains(id));
    }
}

/// Where a stroke stands among the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MarkPlace {
    /// On the cloth, not on the body.
    pub on_cloth: bool,
    /// From 1.
    pub number: usize,
    /// How many strokes its side has.
    pub count: usize,
}

impl std::fmt::Display for MarkPlace {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let side = if self.on_cloth { "cloth" } else { "body" };
        write!(f, "mark {} on the {side}", self.number)
    }
}
