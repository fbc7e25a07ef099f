//! Joints and bones of a body.

use glam::DVec3;

/// A joint. The bone from its parent to it moves with the parent.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Name, with `_left` (x > 0) or `_right` where there are two.
    pub name: String,
    /// Index of the parent; lower than the joint's own. None for the root.
    pub parent: Option<usize>,
    /// Position in the pose the body was built in, metres.
    pub position: DVec3,
}

/// A skeleton: a tree of joints, parents first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skeleton {
    /// The joints.
    pub joints: Vec<Joint>,
}

impl Skeleton {
    /// Adds a joint under `parent` (its index) and returns its index.
    pub fn add(&mut self, name: impl Into<String>, parent: Option<usize>, position: DVec3) -> usize {
        self.joints.push(Joint { name: name.into(), parent, position });
        self.joints.len() - 1
    }

    /// The index of the joint called `name`.
    pub fn index(&self, name: &str) -> Option<usize> {
        self.joints.iter().position(|j| j.name == name)
    }

    /// Position of the joint called `name`, metres.
    pub fn position(&self, name: &str) -> Option<DVec3> {
        self.index(name).map(|i| self.joints[i].position)
    }

    /// Bones as (parent, child) indices, in order of the child.
    pub fn bones(&self) -> impl Iterator<Item = (usize, usize)> {
        self.joints.iter().enumerate().filter_map(|(i, j)| j.parent.map(|p| (p, i)))
    }

    /// The six segments past which paper A keeps cloth from slipping on a human: trunk, head, both arms, both legs,
    /// each from its first to its last joint. Empty when a joint is missing.
    pub fn six_segments(&self) -> Vec<[DVec3; 2]> {
        const ENDS: [[&str; 2]; 6] = [
            ["pelvis", "neck"],
            ["neck", "head"],
            ["shoulder_left", "wrist_left"],
            ["shoulder_right", "wrist_right"],
            ["hip_left", "ankle_left"],
            ["hip_right", "ankle_right"],
        ];
        ENDS.iter()
            .map(|[a, b]| Some([self.position(a)?, self.position(b)?]))
            .collect::<Option<_>>()
            .unwrap_or_default()
    }
}
