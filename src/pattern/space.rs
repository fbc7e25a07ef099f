//! Placement of a piece in space before it is sewn: flat, or rolled into a tube.

use glam::{DQuat, DVec2, DVec3};
use serde::{Deserialize, Serialize};

/// A placement in space: `world = rotation * (x, y, 0) + translation`; a rolled piece is bent before that.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpacePose {
    /// Translation, metres.
    pub translation: DVec3,
    /// Rotation, a unit quaternion.
    pub rotation: DQuat,
    /// How the piece is rolled; None: flat.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub roll: Option<Roll>,
}

/// A piece rolled round a straight axis behind it: an isometry, nothing is stretched (paper B, "self-rolling").
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Roll {
    /// A point of the line along which the rolled piece touches its flat plane, metres in the piece's own plane.
    pub centre: DVec2,
    /// Direction of that line and of the axis, a unit vector in the piece's own plane.
    pub along: DVec2,
    /// Radius: distance from the axis to the cloth, metres, not 0. Positive: the axis is on the -z side of the
    /// piece's own plane.
    pub radius: f64,
}

impl Roll {
    /// The point `p` of the piece's own plane after rolling, before it is placed, metres.
    fn bent(&self, p: DVec2) -> DVec3 {
        let (d, across) = (p - self.centre, -self.along.perp());
        let (sin, cos) = (d.dot(across) / self.radius).sin_cos();
        let flat = self.centre + self.along * d.dot(self.along) + across * (self.radius * sin);
        flat.extend(self.radius * (cos - 1.0))
    }

    /// How the bent cloth at `p` goes on where the piece goes by the unit vector `way`: a unit vector.
    fn slope(&self, p: DVec2, way: DVec2) -> DVec3 {
        let across = -self.along.perp();
        let (sin, cos) = ((p - self.centre).dot(across) / self.radius).sin_cos();
        let flat = self.along * way.dot(self.along) + across * (cos * way.dot(across));
        flat.extend(-sin * way.dot(across))
    }
}

impl SpacePose {
    /// A flat placement.
    pub fn flat(translation: DVec3, rotation: DQuat) -> Self {
        Self { translation, rotation, roll: None }
    }

    /// The position in space of the point `p` of the piece's own plane, metres.
    pub fn at(&self, p: DVec2) -> DVec3 {
        let local = self.roll.map_or(p.extend(0.0), |roll| roll.bent(p));
        self.rotation * local + self.translation
    }

    /// Directions in space, unit vectors, of x and y of the piece's own plane at the point `p` of it.
    pub fn axes_at(&self, p: DVec2) -> [DVec3; 2] {
        let local = |way: DVec2| self.roll.map_or(way.extend(0.0), |roll| roll.slope(p, way));
        [DVec2::X, DVec2::Y].map(|way| self.rotation * local(way))
    }

    /// This placement rotated by `turn` about the point `about` and then moved by `by` metres.
    pub fn moved(self, turn: DQuat, about: DVec3, by: DVec3) -> Self {
        let translation = turn * (self.translation - about) + about + by;
        Self { translation, rotation: (turn * self.rotation).normalize(), ..self }
    }

    /// Whether the placement is valid: all numbers finite, rotation and direction of unit length, radius not 0.
    pub fn is_sound(&self) -> bool {
        let roll = self.roll.is_none_or(|roll| {
            let lengths = roll.centre.is_finite() && roll.radius.is_finite() && roll.radius != 0.0;
            lengths && roll.along.is_normalized()
        });
        roll && self.translation.is_finite() && self.rotation.is_normalized()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rolled(radius: f64) -> SpacePose {
        let roll = Roll { centre: DVec2::new(0.3, -0.2), along: DVec2::from_angle(1.1), radius };
        let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.4, -1.2, 2.0);
        SpacePose { roll: Some(roll), ..SpacePose::flat(DVec3::new(0.1, 1.2, -0.3), turn) }
    }

    #[test]
    fn rolling_stretches_nothing_and_keeps_its_line() {
        for radius in [0.05, -0.2, 3.0] {
            let (pose, flat) = (rolled(radius), SpacePose { roll: None, ..rolled(radius) });
            let roll = pose.roll.expect("a roll");
            for k in 0..7 {
                let on_line = roll.centre + roll.along * (f64::from(k) * 0.1 - 0.3);
                assert!(pose.at(on_line).distance(flat.at(on_line)) < 1e-15);
                // Lengths by central differences: both directions of the plane stay unit and square.
                let p = on_line - roll.along.perp() * 0.07 * f64::from(k);
                let slope = |d: DVec2| (pose.at(p + d * 1e-5) - pose.at(p - d * 1e-5)) / 2e-5;
                let [x, y] = [slope(DVec2::X), slope(DVec2::Y)];
                assert!((x.length() - 1.0).abs() < 1e-8 && (y.length() - 1.0).abs() < 1e-8);
                assert!(x.dot(y).abs() < 1e-8);
                let [own_x, own_y] = pose.axes_at(p);
                assert!(own_x.distance(x) < 1e-8 && own_y.distance(y) < 1e-8);
            }
        }
    }

    #[test]
    fn a_whole_turn_comes_back_to_where_it_began_on_the_side_of_the_axis() {
        for radius in [0.05_f64, -0.05] {
            let pose = rolled(radius);
            let roll = pose.roll.expect("a roll");
            let half = -roll.along.perp() * (std::f64::consts::PI * radius.abs());
            let [one, other] = [pose.at(roll.centre + half), pose.at(roll.centre - half)];
            assert!(one.distance(other) < 1e-14);
            let out = pose.rotation * DVec3::Z * radius.signum();
            assert!(((pose.at(roll.centre) - one).dot(out) - 0.1).abs() < 1e-14, "two radii behind");
        }
    }

    #[test]
    fn what_is_moved_is_moved_as_a_whole() {
        let (pose, turn) = (rolled(0.1), DQuat::from_rotation_z(0.7));
        let (about, by) = (DVec3::new(0.5, 0.2, 0.0), DVec3::new(0.0, 1.0, 2.0));
        let moved = pose.moved(turn, about, by);
        for p in [DVec2::ZERO, DVec2::new(0.2, -0.4)] {
            assert!(moved.at(p).distance(turn * (pose.at(p) - about) + about + by) < 1e-14);
        }
        assert!(moved.is_sound());
    }

    #[test]
    fn numbers_without_meaning_are_not_sound() {
        let pose = rolled(0.1);
        let roll = pose.roll.expect("a roll");
        let bad = [
            SpacePose { translation: DVec3::NAN, ..pose },
            SpacePose { rotation: DQuat::from_xyzw(0.0, 0.0, 0.0, 2.0), ..pose },
            SpacePose { roll: Some(Roll { radius: 0.0, ..roll }), ..pose },
            SpacePose { roll: Some(Roll { radius: f64::NAN, ..roll }), ..pose },
            SpacePose { roll: Some(Roll { along: DVec2::new(2.0, 0.0), ..roll }), ..pose },
        ];
        assert!(pose.is_sound() && bad.iter().all(|pose| !pose.is_sound()));
    }
}
