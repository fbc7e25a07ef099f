//! Numbered strokes on cloth and body. The n-th on the cloth meets the n-th on the body.

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
}

impl Marks {
    /// Strokes that have a partner, in order of their numbers.
    pub fn pairs(&self) -> impl Iterator<Item = (&ClothMark, &BodyMark)> {
        self.cloth.iter().zip(&self.body)
    }
}
