//! Matching the joints of another skeleton to the mannequin's, by name.
//!
//! Known are the names of the CMU motion library and of Mixamo (both after MotionBuilder), of Poser and Daz, of 3ds
//! Max bipeds, of Unreal and MakeHuman, and plain words. Case, separators and everything before a colon are ignored.

use std::collections::BTreeMap;

/// Names for joints of the two sides, without the side, the surest first. Some names mean different joints in different
/// skeletons ("LeftShoulder" is Mixamo's collar, and elsewhere the shoulder): joints higher in this list choose first.
const LIMBS: [(&str, &[&str]); 7] = [
    ("shoulder", &["arm", "upperarm", "upperarm01", "uparm", "shldr", "shldrbend", "shoulder"]),
    ("collar", &["collar", "clavicle", "shoulder"]),
    ("elbow", &["forearm", "lowerarm", "lowerarm01", "lowarm", "forearmbend", "elbow"]),
    ("wrist", &["hand", "wrist"]),
    ("hip", &["upleg", "upperleg", "upperleg01", "thigh", "thighbend", "hip"]),
    ("knee", &["leg", "lowerleg", "lowerleg01", "lowleg", "shin", "calf", "knee"]),
    ("ankle", &["foot", "ankle"]),
];
/// Names for joints in the middle, the surest first; joints higher in this list choose first.
const MIDDLE: [(&str, &[&str]); 5] = [
    ("pelvis", &["hips", "pelvis", "hip", "root"]),
    ("chest", &["upperchest", "chest", "spine3", "spine03", "spine2", "spine02", "spine1", "thorax"]),
    ("spine", &["spine", "abdomen", "spine01", "spine1", "lowerback", "torso"]),
    ("neck", &["neck", "neck1", "neck01", "lowerneck", "necklower"]),
    ("head", &["head"]),
];
/// Prefixes of all names in some skeletons.
const PREFIXES: [&str; 4] = ["mixamorig", "bip001", "bip01", "def"];

/// For joints of the mannequin (and "pelvis") the index in `names` of the matching joint.
pub fn matched(names: &[&str]) -> BTreeMap<String, usize> {
    let plain: Vec<String> = names.iter().map(|name| plain(name)).collect();
    let mut found: BTreeMap<String, usize> = BTreeMap::new();
    let mut take = |joint: String, wanted: &[String]| {
        let free = |name: &String| {
            let at = plain.iter().position(|known| known == name)?;
            (!found.values().any(|&taken| taken == at)).then_some(at)
        };
        if let Some(at) = wanted.iter().find_map(free) {
            found.insert(joint, at);
        }
    };
    for (joint, parts) in MIDDLE {
        take(joint.to_owned(), &parts.iter().map(|part| (*part).to_owned()).collect::<Vec<_>>());
    }
    for (side, letter) in [("left", "l"), ("right", "r")] {
        for (joint, parts) in LIMBS {
            let ways = |part: &&str| {
                [
                    format!("{side}{part}"),
                    format!("{part}{side}"),
                    format!("{letter}{part}"),
                    format!("{part}{letter}"),
                ]
            };
            take(format!("{joint}_{side}"), &parts.iter().flat_map(ways).collect::<Vec<_>>());
        }
    }
    found
}

/// A name reduced to lower case letters and digits, without prefix.
fn plain(name: &str) -> String {
    let own = name.rsplit(':').next().unwrap_or(name);
    let plain: String = own.chars().filter(|c| c.is_alphanumeric()).collect::<String>().to_lowercase();
    let shorter =
        PREFIXES.iter().find_map(|prefix| plain.strip_prefix(prefix).filter(|rest| !rest.is_empty()));
    shorter.map_or(plain.clone(), str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(names: &[&str], expected: &[(&str, &str)]) {
        let found = matched(names);
        for (joint, name) in expected {
            assert_eq!(found.get(*joint).map(|&i| names[i]), Some(*name), "{joint}");
        }
        let mut used: Vec<usize> = found.values().copied().collect();
        used.sort_unstable();
        used.dedup();
        assert_eq!(used.len(), found.len(), "no joint moves two");
    }

    #[test]
    fn the_names_of_known_skeletons_are_understood() {
        let mixamo = [
            "mixamorig:Hips",
            "mixamorig:Spine",
            "mixamorig:Spine1",
            "mixamorig:Spine2",
            "mixamorig:Neck",
            "mixamorig:Head",
            "mixamorig:LeftShoulder",
            "mixamorig:LeftArm",
            "mixamorig:LeftForeArm",
            "mixamorig:LeftHand",
            "mixamorig:LeftUpLeg",
            "mixamorig:LeftLeg",
            "mixamorig:LeftFoot",
        ];
        check(
            &mixamo,
            &[
                ("pelvis", "mixamorig:Hips"),
                ("spine", "mixamorig:Spine"),
                ("chest", "mixamorig:Spine2"),
                ("collar_left", "mixamorig:LeftShoulder"),
                ("shoulder_left", "mixamorig:LeftArm"),
                ("elbow_left", "mixamorig:LeftForeArm"),
                ("wrist_left", "mixamorig:LeftHand"),
                ("hip_left", "mixamorig:LeftUpLeg"),
                ("knee_left", "mixamorig:LeftLeg"),
                ("ankle_left", "mixamorig:LeftFoot"),
            ],
        );
        let cmu = [
            "Hips",
            "LHipJoint",
            "RightUpLeg",
            "RightLeg",
            "LowerBack",
            "Spine",
            "Spine1",
            "Neck",
            "Neck1",
            "Head",
        ];
        check(
            &cmu,
            &[("spine", "Spine"), ("chest", "Spine1"), ("hip_right", "RightUpLeg"), ("neck", "Neck")],
        );
        let poser = [
            "hip", "abdomen", "chest", "neck", "head", "lCollar", "lShldr", "lForeArm", "lHand", "rThigh",
            "rShin", "rFoot",
        ];
        check(
            &poser,
            &[
                ("pelvis", "hip"),
                ("spine", "abdomen"),
                ("chest", "chest"),
                ("collar_left", "lCollar"),
                ("shoulder_left", "lShldr"),
                ("hip_right", "rThigh"),
                ("knee_right", "rShin"),
                ("ankle_right", "rFoot"),
            ],
        );
        let words = [
            "Hips",
            "Chest",
            "LeftCollar",
            "LeftShoulder",
            "LeftElbow",
            "LeftWrist",
            "LeftHip",
            "LeftKnee",
            "LeftAnkle",
        ];
        check(
            &words,
            &[
                ("collar_left", "LeftCollar"),
                ("shoulder_left", "LeftShoulder"),
                ("elbow_left", "LeftElbow"),
                ("wrist_left", "LeftWrist"),
                ("hip_left", "LeftHip"),
                ("knee_left", "LeftKnee"),
            ],
        );
        let unreal = [
            "root",
            "pelvis",
            "spine_01",
            "spine_02",
            "spine_03",
            "clavicle_l",
            "upperarm_l",
            "lowerarm_l",
            "thigh_r",
            "calf_r",
        ];
        check(
            &unreal,
            &[
                ("pelvis", "pelvis"),
                ("spine", "spine_01"),
                ("chest", "spine_03"),
                ("collar_left", "clavicle_l"),
                ("shoulder_left", "upperarm_l"),
                ("elbow_left", "lowerarm_l"),
                ("knee_right", "calf_r"),
            ],
        );
        let biped = ["Bip01 Pelvis", "Bip01 Spine", "Bip01 L UpperArm", "Bip01 R Calf"];
        check(&biped, &[("shoulder_left", "Bip01 L UpperArm"), ("knee_right", "Bip01 R Calf")]);
        assert!(matched(&["tail", "fin"]).is_empty());
    }
}
