//! Finds a view of places on the body. Skin in an armpit or between the legs faces other skin and must be seen past it.

use glam::DVec3;

use crate::body::Surface;

/// Pitches to try, degrees above the horizon; earlier ones are preferred.
const PITCHES: [f64; 3] = [10.0, -25.0, 45.0];
/// Yaws to try, degrees to either side of the direction that the skin faces; earlier ones are preferred.
const YAWS: [f64; 7] = [0.0, 30.0, -30.0, 60.0, -60.0, 80.0, -80.0];
/// Smallest cosine between normal and view direction at which skin counts as visible.
const GRAZING: f64 = 0.15;
/// Height above the skin at which rays of sight begin, metres on a body 1.5 m tall.
const ABOVE: f64 = 0.005;

/// Yaw and pitch (degrees) from which most of `points` near `body` are visible, with as little deviation as possible from the
/// direction that their skin faces; None where the skin faces up, down or all ways.
pub(super) fn facing(points: &[DVec3], body: &Surface) -> Option<(f64, f64)> {
    let skin: Vec<(DVec3, DVec3)> = points
        .iter()
        .map(|&p| {
            let near = body.nearest(p);
            (near.point + near.normal * near.distance.max(ABOVE * body.scale()), near.normal)
        })
        .collect();
    let out: DVec3 = skin.iter().map(|(_, normal)| *normal).sum();
    if out.x.hypot(out.z) <= 0.2 * points.len() as f64 {
        return None;
    }
    let straight = out.x.atan2(out.z).to_degrees();
    let seen = |&(yaw, pitch): &(f64, f64)| {
        let way = towards(yaw, pitch);
        let is_seen =
            |(from, normal): &&(DVec3, DVec3)| normal.dot(way) > GRAZING && body.ray(*from, way).is_none();
        skin.iter().filter(is_seen).count()
    };
    let all = PITCHES.iter().flat_map(|&pitch| YAWS.iter().map(move |yaw| (straight + yaw, pitch)));
    // `max_by_key` takes the last of equal ones, so the order is reversed to take the first.
    all.rev().max_by_key(seen)
}

/// Unit vector towards the eye; angles in degrees.
fn towards(yaw: f64, pitch: f64) -> DVec3 {
    let ((sin, cos), (up, along)) = (yaw.to_radians().sin_cos(), pitch.to_radians().sin_cos());
    DVec3::new(sin * along, up, cos * along)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::shapes::cylinder;

    /// A trunk 0.3 m thick, and an arm 0.1 m thick 0.1 m beside it.
    fn trunk_and_arm() -> Surface {
        let (mut mesh, arm) = (cylinder(0.15, 1.0, 48, 10), cylinder(0.05, 1.0, 24, 10));
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(arm.positions.iter().map(|p| *p + DVec3::X * 0.3));
        mesh.triangles.extend(arm.triangles.iter().map(|t| t.map(|v| v + first)));
        Surface::new(mesh).expect("a body")
    }

    #[test]
    fn what_nothing_hides_is_looked_at_straight() {
        let body = trunk_and_arm();
        let (yaw, pitch) = facing(&[DVec3::new(0.0, 0.5, 0.15)], &body).expect("a way to look");
        assert!(yaw.abs() < 4.0 && pitch == PITCHES[0], "{yaw} {pitch}");
    }

    #[test]
    fn skin_that_looks_at_other_skin_is_looked_at_past_that() {
        let body = trunk_and_arm();
        let place = DVec3::new(0.25, 0.5, 0.0);
        let (yaw, pitch) = facing(&[place], &body).expect("a way to look");
        let way = towards(yaw, pitch);
        assert!(way.x < 0.0, "from the side on which it is: {way}");
        assert_eq!(body.ray(place - DVec3::X * 0.003, way), None, "{way}");
    }

    #[test]
    fn skin_that_looks_all_ways_turns_nothing() {
        let body = trunk_and_arm();
        assert_eq!(facing(&[DVec3::new(-0.15, 0.5, 0.0), DVec3::new(0.35, 0.5, 0.0)], &body), None);
    }
}
