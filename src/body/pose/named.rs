//! Named poses of the mannequin.

use glam::DVec3;

use crate::body::pose::{Pose, hanging};
use crate::body::skeleton::Skeleton;

/// A named pose.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NamedPose {
    /// The pose it was built in: arms half up.
    A,
    /// T pose: arms level.
    T,
    /// Arms down.
    Standing,
    /// In the middle of a step.
    Walking,
    /// In the middle of a leap.
    Running,
    /// Sitting on a chair.
    Sitting,
    /// Both arms up.
    ArmsUp,
    /// Kung fu: a deep stance, one fist forward.
    KungFu,
}

/// The two sides: the suffix of joint names, and the sign of x.
const SIDES: [(&str, f64); 2] = [("left", 1.0), ("right", -1.0)];
/// Fraction of an arm's raising that the collar takes; the shoulder takes the rest.
const COLLAR: f64 = 0.25;

impl NamedPose {
    /// All poses, in the order of menus.
    pub const ALL: [Self; 8] = [
        Self::A,
        Self::T,
        Self::Standing,
        Self::Walking,
        Self::Running,
        Self::Sitting,
        Self::ArmsUp,
        Self::KungFu,
    ];

    /// Name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::A => "a",
            Self::T => "t",
            Self::Standing => "standing",
            Self::Walking => "walking",
            Self::Running => "running",
            Self::Sitting => "sitting",
            Self::ArmsUp => "arms-up",
            Self::KungFu => "kung-fu",
        }
    }

    /// Name for people.
    pub fn title(self) -> &'static str {
        match self {
            Self::A => "A: arms half up",
            Self::T => "T: arms level",
            Self::Standing => "Standing",
            Self::Walking => "Walking",
            Self::Running => "Running",
            Self::Sitting => "Sitting",
            Self::ArmsUp => "Arms up",
            Self::KungFu => "Kung-fu",
        }
    }

    /// The pose for the joints of `skeleton`.
    pub fn pose(self, skeleton: &Skeleton) -> Pose {
        let mut figure = Posing { pose: Pose::default(), hanging: hanging(skeleton) };
        match self {
            Self::A => {}
            Self::T => SIDES.iter().for_each(|side| figure.raise(side, 90.0)),
            Self::Standing => {
                for side in &SIDES {
                    figure.raise(side, 9.0);
                    figure.elbow(side, 12.0);
                }
            }
            Self::Walking => figure.walking(),
            Self::Running => figure.running(),
            Self::Sitting => figure.sitting(),
            Self::ArmsUp => SIDES.iter().for_each(|side| figure.raise(side, 165.0)),
            Self::KungFu => figure.kung_fu(),
        }
        figure.pose
    }
}

impl std::str::FromStr for NamedPose {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|pose| pose.name().eq_ignore_ascii_case(text)).ok_or_else(|| {
            format!("there is no pose {text:?}; there are {}", Self::ALL.map(Self::name).join(", "))
        })
    }
}

/// A pose under construction. Angles are in degrees.
struct Posing {
    pose: Pose,
    hanging: f64,
}

type Side = (&'static str, f64);

impl Posing {
    fn add(&mut self, joint: &str, turn: [f64; 3]) {
        self.pose.add(joint, DVec3::from_array(turn.map(f64::to_radians)));
    }

    /// Adds a rotation to a joint of one side: x negative bends forward; y and z are given for the left side.
    fn on(&mut self, (name, sign): &Side, joint: &str, [x, y, z]: [f64; 3]) {
        self.add(&format!("{joint}_{name}"), [x, y * sign, z * sign]);
    }

    /// Raises the arm sideways to `angle` degrees from straight down.
    fn raise(&mut self, side: &Side, angle: f64) {
        let turn = angle - self.hanging.to_degrees();
        self.on(side, "collar", [0.0, 0.0, COLLAR * turn.max(0.0)]);
        self.on(side, "shoulder", [0.0, 0.0, turn - COLLAR * turn.max(0.0)]);
    }

    /// Bends the forearm forward by `angle` degrees, whichever way the arm is held.
    fn elbow(&mut self, side: &Side, angle: f64) {
        // Across the built arm, in the plane of both arms.
        let (sin, cos) = self.hanging.sin_cos();
        self.on(side, "elbow", [-angle * cos, -angle * sin, 0.0]);
    }

    /// Bends a leg: hip `forth` degrees forward and `aside` degrees sideways, then knee and ankle.
    fn leg(&mut self, side: &Side, [forth, aside]: [f64; 2], knee: f64, ankle: f64) {
        self.on(side, "hip", [0.0, 0.0, aside]);
        self.on(side, "hip", [-forth, 0.0, 0.0]);
        self.on(side, "knee", [knee, 0.0, 0.0]);
        self.on(side, "ankle", [ankle, 0.0, 0.0]);
    }

    /// Sets an arm that hangs at the side: `aside` degrees from straight down, swung `forth` degrees forward, elbow bent.
    fn arm(&mut self, side: &Side, aside: f64, forth: f64, elbow: f64) {
        self.raise(side, aside);
        self.on(side, "shoulder", [-forth, 0.0, 0.0]);
        self.elbow(side, elbow);
    }

    fn walking(&mut self) {
        let [left, right] = &SIDES;
        self.leg(left, [24.0, 0.0], 6.0, -4.0);
        self.leg(right, [-14.0, 0.0], 24.0, 14.0);
        self.arm(left, 11.0, -20.0, 14.0);
        self.arm(right, 11.0, 22.0, 22.0);
        self.add("chest", [0.0, -5.0, 0.0]);
    }

    fn running(&mut self) {
        let [left, right] = &SIDES;
        self.add("spine", [6.0, 0.0, 0.0]);
        self.add("chest", [4.0, -10.0, 0.0]);
        self.add("neck", [-8.0, 6.0, 0.0]);
        self.leg(left, [58.0, 3.0], 78.0, 8.0);
        self.leg(right, [-22.0, 0.0], 48.0, 24.0);
        self.arm(left, 16.0, -38.0, 80.0);
        self.arm(right, 16.0, 34.0, 82.0);
    }

    fn sitting(&mut self) {
        for side in &SIDES {
            self.leg(side, [86.0, 6.0], 86.0, 0.0);
            self.arm(side, 12.0, 24.0, 42.0);
        }
    }

    fn kung_fu(&mut self) {
        let [left, right] = &SIDES;
        self.leg(left, [58.0, 18.0], 62.0, 0.0);
        self.leg(right, [-16.0, 26.0], 12.0, -6.0);
        self.add("chest", [0.0, 12.0, 0.0]);
        self.add("neck", [0.0, -10.0, 0.0]);
        self.arm(left, 34.0, 40.0, 92.0);
        self.arm(right, 24.0, 78.0, 8.0);
    }
}
