//! Names the bones of a body: trunk, head, arms, legs.

use std::fmt;

use glam::DVec3;

use crate::contact::Bone;

/// Distance from the plane between left and right within which a bone's ends must be for it to belong to the middle, as a fraction
/// of the body's height. Chosen by trial.
const MIDDLE: f64 = 0.05;

/// The part of the body that a bone carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    Trunk,
    Head,
    Arm {
        left: bool,
    },
    Leg {
        left: bool,
    },
    /// Another part, by the number of its bone, from 1.
    Other(usize),
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let side = |left| if left { "left" } else { "right" };
        match *self {
            Self::Trunk => write!(f, "trunk"),
            Self::Head => write!(f, "head"),
            Self::Arm { left } => write!(f, "{} arm", side(left)),
            Self::Leg { left } => write!(f, "{} leg", side(left)),
            Self::Other(number) => write!(f, "bone {number}"),
        }
    }
}

/// A bone and the part of the body that it carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limb {
    pub part: Part,
    /// The bone from the end nearer to the trunk to the other, metres; the trunk's own from its lower end.
    pub bone: Bone,
}

impl Limb {
    /// Direction of the bone from its first end to its second, a unit vector.
    pub fn along(&self) -> DVec3 {
        (self.bone[1] - self.bone[0]).normalize_or_zero()
    }
}

/// Names the bones of a body that is `tall` metres high. Two that run up the middle are trunk and head; the others
/// begin on the upper (arms) or lower part (legs) of the trunk. Without a trunk all parts are [`Part::Other`].
pub fn limbs(bones: &[Bone], tall: f64) -> Vec<Limb> {
    let centre = |[a, b]: &Bone| (*a + *b) / 2.0;
    let middle = bones.iter().map(|bone| centre(bone).x).sum::<f64>() / bones.len().max(1) as f64;
    let is_middle = |bone: &&Bone| bone.iter().all(|end| (end.x - middle).abs() < MIDDLE * tall);
    let low = |a: &&Bone, b: &&Bone| centre(a).y.total_cmp(&centre(b).y);
    let trunk = bones.iter().filter(is_middle).min_by(low).copied();
    let number = |(k, &bone): (usize, &Bone)| {
        let Some([hips, neck]) = trunk.map(sorted) else { return Limb { part: Part::Other(k + 1), bone } };
        if trunk == Some(bone) {
            return Limb { part: Part::Trunk, bone: [hips, neck] };
        }
        let up = |p: DVec3| (p - hips).dot(neck - hips) / (neck - hips).length_squared();
        let away = |p: DVec3| p.distance(hips.lerp(neck, up(p).clamp(0.0, 1.0)));
        let bone = if away(bone[1]) < away(bone[0]) { [bone[1], bone[0]] } else { bone };
        let left = centre(&bone).x > middle;
        // Legs begin at the lower end of the trunk, arms and head near the upper one.
        let part = match up(bone[0]) > 0.3 {
            true if is_middle(&&bone) => Part::Head,
            true => Part::Arm { left },
            false if is_middle(&&bone) => Part::Other(k + 1),
            false => Part::Leg { left },
        };
        Limb { part, bone }
    };
    bones.iter().enumerate().map(number).collect()
}

fn sorted([a, b]: Bone) -> Bone {
    if a.y > b.y { [b, a] } else { [a, b] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Surface, bones, landmarks, mannequin};

    #[test]
    fn the_bones_of_the_mannequin_have_their_names() {
        let figure = mannequin::default();
        let own = limbs(&figure.skeleton.six_segments(), 1.7);
        let names: Vec<String> = own.iter().map(|l| l.part.to_string()).collect();
        assert_eq!(names, ["trunk", "head", "left arm", "right arm", "left leg", "right leg"]);
        for limb in &own[2..] {
            assert!(limb.bone[0].x.abs() < limb.bone[1].x.abs() + 0.05, "{limb:?}");
        }
        let surface = Surface::new(figure.mesh.clone()).expect("a body");
        let marks = landmarks::found(&figure.mesh).expect("a human");
        let found = limbs(&bones::extracted(&surface, &marks), 1.7);
        let names: Vec<String> = found.iter().map(|l| l.part.to_string()).collect();
        let left = ["left leg", "left leg", "left arm"];
        let right = ["right leg", "right leg", "right arm"];
        assert_eq!(names, [&["trunk", "head"][..], &left, &right].concat());
    }

    #[test]
    fn bones_of_something_else_are_numbered() {
        let bones = [[DVec3::X, DVec3::X * 2.0], [DVec3::Z, DVec3::new(-1.0, 0.0, 2.0)]];
        let names: Vec<String> = limbs(&bones, 1.0).iter().map(|l| l.part.to_string()).collect();
        assert_eq!(names, ["bone 1", "bone 2"]);
        assert!(limbs(&[], 1.0).is_empty());
    }
}
