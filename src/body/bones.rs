//! Bones of a human mesh that comes without a skeleton: straight segments inside trunk, head and limbs, between landmarks.

use glam::DVec3;

use crate::body::{Landmarks, Surface};

/// Number of intervals on a bone at whose ends it is tested to be inside the body.
const LOOKED_AT: u32 = 24;

/// Bones of trunk, head, thighs, shins and arms of the body with these landmarks, as segments between two ends,
/// metres. Those not wholly inside the body are left out. Empty for a body that does not look human.
pub fn extracted(surface: &Surface, marks: &Landmarks) -> Vec<[DVec3; 2]> {
    let mut bones = Vec::new();
    let mut add = |a: Option<DVec3>, b: Option<DVec3>| bones.extend(a.zip(b).map(|(a, b)| [a, b]));
    let around = |name: &str| centre(marks, name, "");
    let (hip, throat) = (around("hip"), around("throat"));
    add(hip, throat);
    add(throat, throat.zip(marks.get("crown")).map(|(throat, crown)| throat.lerp(crown, 0.85)));
    for side in ["left", "right"] {
        let limb = |name: &str| centre(marks, &format!("{name}_{side}"), "");
        let ring = |name: &str| centre(marks, name, side);
        let top = hip.zip(marks.get(&format!("hip_side_{side}"))).map(|(hip, rim)| hip.lerp(rim, 0.5));
        add(top, limb("knee"));
        add(limb("knee"), limb("ankle"));
        add(ring("arm_upper").or(limb("upper_arm")), ring("arm_lower").or(limb("forearm")));
    }
    bones.retain(|bone| is_inside(surface, bone));
    bones
}

/// The mean of the four landmarks round a part of the body: of "waist" or "knee_left" when `side` is empty, else of
/// an arm ring such as "arm_upper" on `side`. None when one of them is missing.
fn centre(marks: &Landmarks, name: &str, side: &str) -> Option<DVec3> {
    let four = if side.is_empty() {
        let trunk = ["front", "back", "side_left", "side_right"].map(|end| format!("{name}_{end}"));
        let limb = ["front", "back", "high_x", "low_x"].map(|end| format!("{name}_{end}"));
        if marks.get(&trunk[2]).is_some() { trunk } else { limb }
    } else {
        ["above", "below", "front", "back"].map(|end| format!("{name}_{end}_{side}"))
    };
    let points: Option<Vec<DVec3>> = four.iter().map(|name| marks.get(name)).collect();
    points.map(|points| points.iter().sum::<DVec3>() / points.len() as f64)
}

fn is_inside(surface: &Surface, [a, b]: &[DVec3; 2]) -> bool {
    (0..=LOOKED_AT).all(|i| surface.contains(a.lerp(*b, f64::from(i) / f64::from(LOOKED_AT))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{landmarks, mannequin};

    #[test]
    fn the_mannequin_without_its_skeleton_gets_one_like_it() {
        let figure = mannequin::default();
        let marks = landmarks::found(&figure.mesh).expect("a human");
        let surface = Surface::new(figure.mesh.clone()).expect("a body");
        let bones = extracted(&surface, &marks);
        assert_eq!(bones.len(), 8, "trunk, head, two arms, four halves of legs");
        let own = figure.skeleton.six_segments();
        // Its own bone of the head ends below the face.
        let apart = |p: DVec3, [a, b]: [DVec3; 2]| {
            let t = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 2.0);
            p.distance(a.lerp(b, t))
        };
        for bone in &bones {
            for p in [bone[0].lerp(bone[1], 0.2), bone[0].lerp(bone[1], 0.8)] {
                let nearest = own.iter().map(|segment| apart(p, *segment)).fold(f64::INFINITY, f64::min);
                assert!(nearest < 0.06, "{bone:?} is {nearest} m off at {p}");
            }
        }
    }
}
