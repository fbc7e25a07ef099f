//! Poses of the mannequin: rotations of its joints, and the skin deformed by them.

pub mod anatomy;
mod matching;
pub mod motion;
mod named;
mod regions;
mod rig;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

pub use named::NamedPose;
pub use rig::{Posed, Rig, rig};

use crate::body::skeleton::Skeleton;
use crate::geometry::words::{Words, decimal, within_quotes, words};

/// No joint turns further, radians.
pub const FURTHEST: f64 = 2.9;

/// How each joint that is turned is turned: a rotation vector, radians, in the frame of the joint before it, which in the
/// pose that the body was built in is the world's. What hangs below the joint turns with it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Pose {
    /// By name of the joint.
    pub turns: BTreeMap<String, DVec3>,
}

impl Pose {
    /// The turn of a joint.
    pub fn turn(&self, joint: &str) -> DQuat {
        self.turns.get(joint).map_or(DQuat::IDENTITY, |&turn| DQuat::from_scaled_axis(turn))
    }

    /// Turns a joint by `turn`, after what it is turned already.
    pub fn add(&mut self, joint: &str, turn: DVec3) {
        let both = DQuat::from_scaled_axis(turn) * self.turn(joint);
        self.turns.insert(joint.to_owned(), shortest(both).to_scaled_axis());
    }

    /// Turns a joint by `turn` from how it was built, and by nothing else.
    pub fn set(&mut self, joint: &str, turn: DVec3) {
        match turn == DVec3::ZERO {
            true => self.turns.remove(joint),
            false => self.turns.insert(joint.to_owned(), turn),
        };
    }

    /// On the way to `other`, each joint turning evenly: 0 this, 1 `other`.
    pub fn towards(&self, other: &Self, share: f64) -> Self {
        let names: std::collections::BTreeSet<&String> =
            self.turns.keys().chain(other.turns.keys()).collect();
        let between = |name: &str| {
            let turn = self.turn(name).slerp(other.turn(name), share);
            shortest(turn).to_scaled_axis()
        };
        let turns = names.into_iter().map(|name| (name.clone(), between(name)));
        Self { turns: turns.filter(|(_, turn)| *turn != DVec3::ZERO).collect() }
    }

    /// What is wrong with it, in words.
    pub fn problem(&self) -> Option<Words> {
        let known = |name: &str| regions::JOINTS.iter().any(|(joint, _)| *joint == name);
        self.turns.iter().find_map(|(name, turn)| match known(name) {
            false => Some(words!(
                "the mannequin has no joint called \"{name}\" that turns",
                name = within_quotes(name)
            )),
            true if !turn.is_finite() => Some(words!("the turn of {name} is no number", name)),
            true if turn.length() > FURTHEST => Some(words!(
                "{name} is turned by {degrees}°, a joint turns {most}° at most",
                name,
                degrees = decimal(turn.length().to_degrees(), 0),
                most = decimal(FURTHEST.to_degrees(), 0)
            )),
            true => None,
        })
    }
}

/// The angle between the left arm and straight down, radians.
fn hanging(skeleton: &Skeleton) -> f64 {
    let arm = skeleton.position("elbow_left").zip(skeleton.position("shoulder_left"));
    arm.map_or(0.0, |(elbow, shoulder)| (elbow.x - shoulder.x).atan2(shoulder.y - elbow.y))
}

/// The same rotation by no more than half a turn.
fn shortest(turn: DQuat) -> DQuat {
    if turn.w < 0.0 { -turn } else { turn }
}
