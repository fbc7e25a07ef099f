//! Retargeting: motions of other skeletons applied to the mannequin.
//!
//! Each joint of the mannequin takes the global rotation, from the rest pose on, of the matching joint, so that it does not
//! matter how many joints the other skeleton has in between. Limbs with different rest directions (arms level in one, half
//! up in the other) are first aligned by the shortest rotation. The pelvis keeps its path, scaled by the length of the legs.

use std::collections::BTreeMap;

use glam::{DQuat, DVec3};

use crate::body::UpAxis;
use crate::body::pose::matching::matched;
use crate::body::pose::regions::JOINTS;
use crate::body::pose::{FURTHEST, Pose, shortest};
use crate::body::skeleton::Skeleton;
use crate::geometry::words::{Words, words};

/// What one value of a frame does to its joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Channel {
    /// Moves the joint along x, y or z (0..=2) of its parent, in the clip's unit, replacing that coordinate of its offset.
    Position(usize),
    /// Rotates the joint about x, y or z (0..=2), degrees, after the channels before it.
    Rotation(usize),
}

/// A joint of a clip.
#[derive(Clone, Debug, PartialEq)]
pub struct ClipJoint {
    /// Name in the file.
    pub name: String,
    /// Index of the parent; lower than the joint's own. None for the root.
    pub parent: Option<usize>,
    /// Offset from the parent in the rest pose, in the clip's unit.
    pub offset: DVec3,
    /// Channels, in the order of the values of a frame.
    pub channels: Vec<Channel>,
    /// End points of bones that begin at the joint and have no joint at their end, in the joint's frame.
    pub ends: Vec<DVec3>,
}

/// A motion clip: a skeleton with values for each frame. In a file any axis may be up; the mannequin needs y up. In
/// the rest pose all rotations are zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// The joints, parents first; the root is the first.
    pub joints: Vec<ClipJoint>,
    /// Time between frames, seconds, above zero.
    pub seconds_per_frame: f64,
    /// Values of all frames, one frame after the other; in each the channels of all joints.
    pub values: Vec<f64>,
}

impl Clip {
    /// Number of values in a frame.
    pub fn channels(&self) -> usize {
        self.joints.iter().map(|joint| joint.channels.len()).sum()
    }

    /// Number of frames.
    pub fn frames(&self) -> usize {
        self.values.len().checked_div(self.channels()).unwrap_or(0)
    }

    /// Global rotation (against the rest pose) and position of each joint in a frame.
    fn places(&self, frame: usize) -> Vec<(DQuat, DVec3)> {
        let channels = self.channels();
        let mut values = self.values[frame * channels..(frame + 1) * channels].iter();
        let mut places: Vec<(DQuat, DVec3)> = Vec::with_capacity(self.joints.len());
        for joint in &self.joints {
            let (mut turn, mut at) = (DQuat::IDENTITY, joint.offset);
            for (channel, &value) in joint.channels.iter().zip(&mut values) {
                match *channel {
                    Channel::Position(axis) => at[axis] = value,
                    Channel::Rotation(axis) => {
                        turn *= DQuat::from_axis_angle(DVec3::AXES[axis], value.to_radians());
                    }
                }
            }
            let (before, from) = joint.parent.map_or((DQuat::IDENTITY, DVec3::ZERO), |p| places[p]);
            places.push(((before * turn).normalize(), from + before * at));
        }
        places
    }

    /// The likely up axis, judged by the rest pose.
    pub fn likely_up(&self) -> UpAxis {
        let (mut lower, mut upper) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for (at, joint) in self.resting().into_iter().zip(&self.joints) {
            for p in std::iter::once(at).chain(joint.ends.iter().map(|end| at + *end)) {
                (lower, upper) = (lower.min(p), upper.max(p));
            }
        }
        UpAxis::guess(upper - lower)
    }

    /// Rotates the whole clip so that `up` becomes y.
    pub fn set_upright(&mut self, up: UpAxis) {
        // Sign of each value afterwards: a rotation about -y is one by the negative angle.
        let signs: Vec<f64> = self
            .joints
            .iter_mut()
            .flat_map(|joint| {
                joint.offset = up.upright(joint.offset);
                joint.ends.iter_mut().for_each(|end| *end = up.upright(*end));
                joint.channels.iter_mut().map(|channel| {
                    let (Channel::Position(axis) | Channel::Rotation(axis)) = channel;
                    let along = up.upright(DVec3::AXES[*axis]);
                    *axis = along.abs().max_position();
                    along[*axis]
                })
            })
            .collect();
        self.values.iter_mut().zip(signs.iter().cycle()).for_each(|(value, sign)| *value *= sign);
    }

    /// Positions of the joints in the rest pose; the root is at its offset.
    fn resting(&self) -> Vec<DVec3> {
        let mut places: Vec<DVec3> = Vec::with_capacity(self.joints.len());
        for joint in &self.joints {
            places.push(joint.parent.map_or(DVec3::ZERO, |p| places[p]) + joint.offset);
        }
        places
    }
}

/// Position and rotation of the mannequin's pelvis, relative to the built pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// Rotation about the pelvis.
    pub turn: DQuat,
    /// Translation, metres.
    pub shift: DVec3,
}

/// Swaps spine and chest where the clip numbers its spine downwards: the chest must be above.
fn upright(found: &mut BTreeMap<String, usize>, clip: &Clip) {
    let Some((spine, chest)) = found.get("spine").copied().zip(found.get("chest").copied()) else { return };
    let mut above = clip.joints[spine].parent;
    while let Some(joint) = above {
        if joint == chest {
            found.insert("spine".to_owned(), chest);
            found.insert("chest".to_owned(), spine);
            return;
        }
        above = clip.joints[joint].parent;
    }
}

/// Bones whose rest directions are aligned, from joint to joint.
const LIMBS: [(&str, &str); 4] =
    [("shoulder", "elbow"), ("elbow", "wrist"), ("hip", "knee"), ("knee", "ankle")];

/// Which joints of a clip drive which of the mannequin's, and how.
#[derive(Clone, Debug)]
pub struct Retarget {
    /// For each of `JOINTS` the joint of the clip that drives it.
    sources: Vec<Option<usize>>,
    /// For each of `JOINTS` the rotation that aligns its limb with the clip's in the rest pose.
    along: Vec<DQuat>,
    /// For each of `JOINTS` its parent among them; None: the pelvis.
    parents: Vec<Option<usize>>,
    pelvis: usize,
    /// Metres per unit of the clip, chosen so that the legs get the length of the mannequin's.
    scale: f64,
    /// Height of the pelvis above the lowest point in the rest pose, in the clip's unit.
    standing: f64,
    /// Joints of the clip that drive nothing, in its order.
    pub unused: Vec<String>,
    /// Joints of the mannequin that nothing drives.
    pub unmoved: Vec<&'static str>,
}

impl Retarget {
    /// Matches `clip` to the mannequin with this `skeleton`. Err: a message, when no joint is known by name.
    pub fn new(clip: &Clip, skeleton: &Skeleton) -> Result<Self, Words> {
        let names: Vec<&str> = clip.joints.iter().map(|joint| joint.name.as_str()).collect();
        let mut found = matched(&names);
        upright(&mut found, clip);
        let sources: Vec<Option<usize>> = JOINTS.iter().map(|(name, _)| found.get(*name).copied()).collect();
        if sources.iter().all(Option::is_none) {
            let first: Vec<&str> = names.iter().copied().take(12).collect();
            return Err(words!("none of its joints is known by name: {names}", names = first.join(", ")));
        }
        let rest = clip.resting();
        let index = |name: &str| JOINTS.iter().position(|(joint, _)| *joint == name);
        let parents = JOINTS.iter().map(|(name, _)| {
            let joint = skeleton.index(name).map(|i| &skeleton.joints[i])?;
            index(&skeleton.joints[joint.parent?].name)
        });
        let mut along = vec![DQuat::IDENTITY; JOINTS.len()];
        let (mut own_legs, mut clip_legs) = (0.0, 0.0);
        for side in ["left", "right"] {
            for (from, to) in LIMBS {
                let [from, to] = [from, to].map(|part| format!("{part}_{side}"));
                let (Some(k), Some(own)) =
                    (index(&from), skeleton.position(&to).zip(skeleton.position(&from)))
                else {
                    continue;
                };
                let there = sources[k].zip(found.get(to.as_str()).copied());
                let Some((a, b)) = there else { continue };
                let (own, theirs) = (own.0 - own.1, rest[b] - rest[a]);
                if let (Some(own), Some(theirs)) = (own.try_normalize(), theirs.try_normalize()) {
                    along[k] = DQuat::from_rotation_arc(own, theirs);
                }
                if from.starts_with("hip") || from.starts_with("knee") {
                    own_legs += own.length();
                    clip_legs += theirs.length();
                }
            }
            // The hand is aligned like the forearm.
            if let (Some(elbow), Some(wrist)) =
                (index(&format!("elbow_{side}")), index(&format!("wrist_{side}")))
            {
                along[wrist] = along[elbow];
            }
        }
        let pelvis = found.get("pelvis").copied().unwrap_or(0);
        let lowest = rest.iter().zip(&clip.joints).flat_map(|(&at, joint)| {
            std::iter::once(at.y).chain(joint.ends.iter().map(move |end| at.y + end.y))
        });
        let standing = rest[pelvis].y - lowest.fold(f64::INFINITY, f64::min);
        let own_standing = skeleton.position("pelvis").map_or(1.0, |pelvis| pelvis.y);
        let scale = match (clip_legs > 0.0, standing > 0.0) {
            (true, _) => own_legs / clip_legs,
            (false, true) => own_standing / standing,
            (false, false) => 1.0,
        };
        let used = |i: &usize| *i == pelvis || sources.contains(&Some(*i));
        let unused = (0..names.len()).filter(|i| !used(i)).map(|i| names[i].to_owned()).collect();
        let unmoved = JOINTS.iter().zip(&sources).filter(|(_, source)| source.is_none());
        let unmoved = unmoved.map(|((name, _), _)| *name).collect();
        Ok(Self { parents: parents.collect(), along, pelvis, scale, standing, unused, unmoved, sources })
    }

    /// Pose and placement of the mannequin in a frame of `clip`; horizontally the placement is relative to frame `first`.
    pub fn frame(&self, clip: &Clip, first: usize, frame: usize) -> (Pose, Placement) {
        let places = clip.places(frame);
        let pelvis = places[self.pelvis];
        let mut whole: Vec<DQuat> = Vec::with_capacity(JOINTS.len());
        let mut pose = Pose::default();
        for (k, (name, _)) in JOINTS.iter().enumerate() {
            let before = self.parents[k].map_or(pelvis.0, |parent| whole[parent]);
            let own = self.sources[k].map_or(before, |source| places[source].0 * self.along[k]);
            whole.push(own);
            let turn = shortest((before.inverse() * own).normalize()).to_scaled_axis();
            if self.sources[k].is_some() {
                // Stay below the limit in spite of rounding.
                pose.set(name, turn.clamp_length_max(FURTHEST * (1.0 - 1e-12)));
            }
        }
        let begun = clip.places(first)[self.pelvis].1;
        let moved = pelvis.1 - DVec3::new(begun.x, self.standing, begun.z);
        (pose, Placement { turn: pelvis.0, shift: moved * self.scale })
    }
}

#[cfg(test)]
#[path = "motion_tests.rs"]
mod tests;
