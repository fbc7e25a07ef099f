//! Reads joint angles of the mannequin from JSON, in degrees:
//! `{"left_elbow": 60, "right_hip": {"flexion": 30, "abduction": 20}}`.

use crate::body::pose::anatomy::JointAngle;
use crate::io::json::{At, JsonError, Node, parse};

/// Reads the joint angles in the order of the file.
///
/// # Errors
/// An unknown joint, an axis that the joint does not have, or an angle out of its range, each with its JSON pointer.
pub fn read(bytes: &[u8]) -> Result<Vec<JointAngle>, JsonError> {
    let root = parse(bytes)?;
    let mut angles = Vec::new();
    for (name, at) in At::root(&root).entries()? {
        match at.node {
            Node::Map(_) => {
                for (axis, degrees) in at.entries()? {
                    angles.push(angle(&format!("{name}.{axis}"), &degrees)?);
                }
            }
            _ => angles.push(angle(name, &at)?),
        }
    }
    Ok(angles)
}

fn angle(name: &str, degrees: &At<'_>) -> Result<JointAngle, JsonError> {
    JointAngle::new(name, degrees.number()?).map_err(|why| degrees.error(why))
}

#[cfg(test)]
mod tests {
    #[test]
    fn joints_are_read_and_faults_are_placed() {
        let read = |text: &str| super::read(text.as_bytes());
        let found = read(r#"{"left_elbow": 60, "right_hip": {"flexion": 30, "abduction": -5.5}}"#);
        let found: Vec<String> = found
            .expect("joints")
            .iter()
            .map(|a| format!("{} {} {}", a.limb.joint, a.axis.name(), a.degrees))
            .collect();
        assert_eq!(found, ["elbow_left flexion 60", "hip_right flexion 30", "hip_right abduction -5.5"]);
        for (text, place, words) in [
            (r#"{"left_elbow": 200}"#, "/left_elbow", "out of its range"),
            (r#"{"right_hip": {"twist": "far"}}"#, "/right_hip/twist", "number"),
            (r#"{"tail": 3}"#, "/tail", "no joint called"),
            ("[1, 2]", "/", ""),
            (r#"{"left_elbow": 1,}"#, "line 1", ""),
        ] {
            let why = read(text).expect_err(text).to_string();
            assert!(why.contains(place) && why.contains(words), "{text}: {why}");
        }
    }
}
