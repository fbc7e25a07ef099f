//! The figure's proportions: sections of trunk, legs, arms, feet and head for the default measurements, drawn by eye.
//!
//! Everything is in metres on a figure 1.78 m tall; `figure` stretches it to other measurements. The left half is given
//! (x > 0); the figure stands with its feet on y = 0 and faces +z.

/// Heights of the places for which the tables were drawn, metres.
pub mod level {
    /// Narrowest place above the ankle bones.
    pub const ANKLE: f64 = 0.140;
    /// The ankle bone itself.
    pub const ANKLE_BONE: f64 = 0.072;
    /// Fullest place of the calf.
    pub const CALF: f64 = 0.350;
    /// Middle of the kneecap.
    pub const KNEE: f64 = 0.485;
    /// Half-way between crotch and knee.
    pub const MID_THIGH: f64 = 0.657;
    /// Just below the crotch.
    pub const UPPER_THIGH: f64 = 0.795;
    /// Fullest place of the hip.
    pub const HIP: f64 = 0.925;
    /// Half-way between waist and hip.
    pub const ABDOMEN: f64 = 1.035;
    /// Natural waist.
    pub const WAIST: f64 = 1.142;
    /// Fullest place of the bust.
    pub const BUST: f64 = 1.292;
    /// Shoulder tips.
    pub const SHOULDER: f64 = 1.455;
    /// Middle of the neck.
    pub const NECK: f64 = 1.535;
    /// Underside of the chin.
    pub const CHIN: f64 = 1.556;
    /// Top of the head.
    pub const CROWN: f64 = 1.78;
}

/// Trunk with one leg, from ankle to neck, by height: `[y, inner edge x, outer edge x, centre x, centre z, front
/// half-depth, back half-depth, exponent]`. Where the inner edge is negative the two halves overlap and make one trunk.
#[rustfmt::skip]
pub const TRUNK: [[f64; 8]; 34] = [
    [0.045,  0.081, 0.141, 0.111, -0.034, 0.033, 0.034, 2.0],
    [0.075,  0.077, 0.141, 0.110, -0.034, 0.034, 0.036, 2.0],
    [0.115,  0.075, 0.137, 0.107, -0.033, 0.034, 0.037, 2.0],
    [0.150,  0.072, 0.138, 0.106, -0.032, 0.035, 0.040, 2.0],
    [0.200,  0.067, 0.141, 0.106, -0.031, 0.038, 0.048, 2.0],
    [0.250,  0.060, 0.146, 0.106, -0.029, 0.042, 0.058, 2.0],
    [0.300,  0.053, 0.150, 0.105, -0.026, 0.045, 0.065, 2.0],
    [0.350,  0.050, 0.152, 0.104, -0.022, 0.047, 0.066, 2.0],
    [0.410,  0.051, 0.150, 0.102, -0.015, 0.050, 0.059, 2.0],
    [0.460,  0.050, 0.148, 0.101, -0.008, 0.055, 0.054, 2.1],
    [0.500,  0.047, 0.149, 0.100, -0.004, 0.058, 0.055, 2.1],
    [0.560,  0.042, 0.153, 0.098, -0.001, 0.066, 0.062, 2.1],
    [0.610,  0.036, 0.157, 0.097,  0.001, 0.073, 0.070, 2.1],
    [0.657,  0.030, 0.162, 0.096,  0.002, 0.080, 0.078, 2.1],
    [0.730,  0.022, 0.170, 0.096,  0.001, 0.086, 0.087, 2.1],
    [0.795,  0.016, 0.176, 0.094, -0.003, 0.091, 0.100, 2.1],
    [0.835, -0.004, 0.1780, 0.085, -0.006, 0.095, 0.113, 2.1],
    [0.875, -0.055, 0.1780, 0.070, -0.008, 0.101, 0.125, 2.1],
    [0.925, -0.110, 0.1755, 0.052, -0.008, 0.111, 0.125, 2.1],
    [0.980, -0.130, 0.1640, 0.032, -0.004, 0.117, 0.113, 2.1],
    [1.035, -0.140, 0.1500, 0.014, -0.001, 0.112, 0.095, 2.15],
    [1.090, -0.128, 0.1285, 0.004,  0.003, 0.101, 0.084, 2.2],
    [1.142, -0.1160, 0.1160, 0.0,  0.005, 0.094, 0.086, 2.2],
    [1.195, -0.1225, 0.1225, 0.0,  0.002, 0.090, 0.088, 2.2],
    [1.245, -0.132, 0.132, 0.0,   -0.002, 0.096, 0.094, 2.2],
    [1.305, -0.141, 0.141, 0.0,   -0.008, 0.101, 0.102, 2.2],
    [1.375, -0.149, 0.149, 0.0,   -0.014, 0.093, 0.101, 2.2],
    [1.425, -0.150, 0.150, 0.0,   -0.020, 0.077, 0.090, 2.2],
    [1.455, -0.130, 0.130, 0.0,   -0.021, 0.063, 0.078, 2.15],
    [1.485, -0.091, 0.091, 0.0,   -0.018, 0.054, 0.066, 2.1],
    [1.515, -0.061, 0.061, 0.0, -0.012, 0.051, 0.056, 2.0],
    [1.555, -0.0510, 0.0510, 0.0, -0.004, 0.051, 0.052, 2.0],
    [1.600, -0.0490, 0.0490, 0.0,  0.002, 0.049, 0.050, 2.0],
    [1.660, -0.0440, 0.0440, 0.0,  0.006, 0.044, 0.046, 2.0],
];

/// Centre of the left shoulder joint, where the arm starts.
pub const SHOULDER_JOINT: [f64; 3] = [0.161, 1.406, -0.018];
/// Angle between the arm and straight down, radians.
pub const ARM_ANGLE: f64 = 0.765;

/// Arm and palm, by length from the shoulder joint along the arm:
/// `[s, centre outward, centre forward, half-width inward, half-width outward, half-depth back, half-depth front, exponent]`.
#[rustfmt::skip]
pub const ARM: [[f64; 8]; 18] = [
    [-0.025, 0.000,  0.000, 0.048, 0.047, 0.054, 0.049, 2.0],
    [ 0.000, 0.000,  0.000, 0.050, 0.0515, 0.057, 0.053, 2.0],
    [ 0.045, 0.000,  0.001, 0.047, 0.0525, 0.055, 0.052, 2.0],
    [ 0.100, 0.000,  0.002, 0.044, 0.047, 0.050, 0.048, 2.0],
    [ 0.150, 0.000,  0.002, 0.043, 0.042, 0.047, 0.045, 2.0],
    [ 0.210, 0.000,  0.001, 0.040, 0.038, 0.043, 0.042, 2.0],
    [ 0.265, 0.000,  0.002, 0.037, 0.036, 0.038, 0.037, 2.0],
    [ 0.305, 0.000,  0.006, 0.037, 0.036, 0.036, 0.038, 2.0],
    [ 0.350, -0.001, 0.013, 0.037, 0.038, 0.037, 0.041, 2.0],
    [ 0.400, -0.003, 0.022, 0.034, 0.036, 0.036, 0.037, 2.0],
    [ 0.460, -0.006, 0.033, 0.028, 0.029, 0.030, 0.031, 2.0],
    [ 0.520, -0.009, 0.044, 0.021, 0.022, 0.026, 0.026, 2.1],
    [ 0.550, -0.010, 0.050, 0.019, 0.020, 0.026, 0.026, 2.2],
    [ 0.580, -0.011, 0.055, 0.019, 0.017, 0.030, 0.031, 2.3],
    [ 0.610, -0.012, 0.061, 0.018, 0.015, 0.036, 0.036, 2.5],
    [ 0.635, -0.013, 0.065, 0.015, 0.014, 0.039, 0.039, 2.6],
    [ 0.655, -0.014, 0.069, 0.012, 0.012, 0.0395, 0.0405, 2.6],
    [ 0.666, -0.015, 0.071, 0.0105, 0.0105, 0.039, 0.040, 2.6],
];
/// Distance along the arm at which the upper arm is measured, metres.
pub const UPPER_ARM_AT: f64 = 0.145;
/// Distance along the arm of the elbow, metres.
pub const ELBOW_AT: f64 = 0.300;
/// Distance along the arm of the wrist, metres.
pub const WRIST_AT: f64 = 0.548;

/// Fingers and thumb as chains of joints in the arm's frame (length along the arm, outward, forward, radius), without
/// the arm's own bend.
#[rustfmt::skip]
pub const FINGERS: [[[f64; 4]; 4]; 5] = [
    [[0.650,  0.000,  0.0335, 0.0084], [0.697, -0.003,  0.0360, 0.0080], [0.722, -0.009,  0.0375, 0.0073], [0.741, -0.017,  0.0385, 0.0062]],
    [[0.650,  0.001,  0.0113, 0.0086], [0.704, -0.002,  0.0120, 0.0082], [0.733, -0.009,  0.0123, 0.0075], [0.753, -0.018,  0.0125, 0.0064]],
    [[0.650,  0.000, -0.0113, 0.0084], [0.699, -0.004, -0.0122, 0.0079], [0.726, -0.012, -0.0128, 0.0072], [0.744, -0.021, -0.0130, 0.0061]],
    [[0.645, -0.001, -0.0332, 0.0078], [0.684, -0.006, -0.0356, 0.0071], [0.705, -0.014, -0.0372, 0.0065], [0.718, -0.022, -0.0380, 0.0055]],
    [[0.570, -0.006,  0.0200, 0.0140], [0.606, -0.016,  0.0440, 0.0110], [0.638, -0.022,  0.0580, 0.0088], [0.662, -0.024,  0.0640, 0.0068]],
];

/// A foot, heel to toe, by length from below the ankle:
/// `[s, centre outward, half-width inward, half-width outward, height of the widest place, height of the top, exponent]`.
#[rustfmt::skip]
pub const FOOT: [[f64; 7]; 8] = [
    [-0.016, -0.002, 0.030, 0.030, 0.027, 0.080, 2.2],
    [ 0.010, -0.001, 0.031, 0.031, 0.027, 0.088, 2.2],
    [ 0.045, 0.000, 0.031, 0.032, 0.024, 0.081, 2.2],
    [ 0.085, 0.000, 0.036, 0.038, 0.020, 0.060, 2.2],
    [ 0.115, -0.001, 0.040, 0.042, 0.017, 0.046, 2.3],
    [ 0.135, -0.003, 0.041, 0.042, 0.015, 0.038, 2.3],
    [ 0.150, -0.0045, 0.0400, 0.0405, 0.0135, 0.0335, 2.3],
    [ 0.163, -0.0055, 0.0395, 0.0390, 0.0130, 0.0315, 2.3],
];
/// Origin of the foot on the floor below the ankle joint (x, z), metres.
pub const FOOT_ORIGIN: [f64; 2] = [0.110, -0.037];
/// Angle by which the feet turn outward, radians.
pub const FOOT_TURN: f64 = 0.16;

/// Head by height: `[y, half-width, centre z, front half-depth, back half-depth, exponent]`.
#[rustfmt::skip]
pub const HEAD: [[f64; 6]; 9] = [
    [1.570, 0.037, 0.054, 0.041, 0.046, 2.0],
    [1.582, 0.043, 0.046, 0.052, 0.056, 2.0],
    [1.597, 0.050, 0.036, 0.064, 0.068, 2.0],
    [1.615, 0.0565, 0.025, 0.075, 0.081, 2.0],
    [1.635, 0.0620, 0.015, 0.084, 0.091, 2.0],
    [1.655, 0.066, 0.009, 0.090, 0.098, 2.0],
    [1.675, 0.071, 0.006, 0.093, 0.102, 2.0],
    [1.690, 0.0735, 0.005, 0.095, 0.103, 2.0],
    [1.700, 0.0740, 0.004, 0.095, 0.103, 2.0],
];

/// A soft bump or hollow on the skin, metres.
#[derive(Clone, Copy, Debug)]
pub struct Swelling {
    /// Position of its centre.
    pub centre: [f64; 3],
    /// Distance along each axis at which it has fallen to 1/e.
    pub reach: [f64; 3],
    /// Height above the plain surface; negative for a hollow.
    pub height: f64,
}

const fn swelling(centre: [f64; 3], reach: [f64; 3], height: f64) -> Swelling {
    Swelling { centre, reach, height }
}

/// Face: nose and its bridge, hollows of the eyes, lips, chin, cheekbones, brows.
#[rustfmt::skip]
pub const FACE: [Swelling; 7] = [
    swelling([0.0, 1.642, 0.108], [0.013, 0.015, 0.030], 0.014),
    swelling([0.0, 1.664, 0.102], [0.012, 0.022, 0.030], 0.007),
    swelling([0.031, 1.670, 0.088], [0.018, 0.012, 0.030], -0.0052),
    swelling([0.0, 1.609, 0.098], [0.019, 0.008, 0.030], 0.0030),
    swelling([0.0, 1.572, 0.092], [0.018, 0.012, 0.030], 0.0045),
    swelling([0.045, 1.645, 0.070], [0.020, 0.016, 0.030], 0.003),
    swelling([0.030, 1.693, 0.090], [0.024, 0.009, 0.030], 0.0020),
];

/// Details of trunk and limbs: collar bones, hollow of the throat, shoulder blades, furrow of the spine, navel,
/// kneecaps, hollows of the knees, ankle bones.
#[rustfmt::skip]
pub const MODELLING: [Swelling; 10] = [
    swelling([0.0, 0.900, -0.135], [0.018, 0.060, 0.045], -0.009),
    swelling([0.070, 1.468, 0.040], [0.050, 0.009, 0.045], 0.0035),
    swelling([0.0, 1.474, 0.045], [0.018, 0.018, 0.040], -0.004),
    swelling([0.078, 1.375, -0.120], [0.035, 0.050, 0.040], 0.006),
    swelling([0.0, 1.230, -0.095], [0.021, 0.140, 0.040], -0.006),
    swelling([0.0, 1.062, 0.112], [0.012, 0.014, 0.030], -0.006),
    swelling([0.101, 0.487, 0.052], [0.024, 0.024, 0.030], 0.003),
    swelling([0.101, 0.480, -0.062], [0.022, 0.030, 0.030], -0.003),
    swelling([0.143, 0.074, -0.036], [0.020, 0.017, 0.017], 0.0035),
    swelling([0.076, 0.082, -0.030], [0.020, 0.017, 0.017], 0.0035),
];

/// Centre of the left breast, metres.
pub const BREAST_CENTRE: [f64; 3] = [0.080, 1.284, 0.050];
/// Half-axes of a breast sideways, up, down and forward, metres.
pub const BREAST_AXES: [f64; 4] = [0.065, 0.120, 0.058, 0.081];
