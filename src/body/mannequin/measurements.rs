//! The body measurements from which a mannequin is built.

use serde::{Deserialize, Serialize};

/// Body measurements, metres. Girths are taken with a tape, which bridges hollows. The default is the measured figure
/// of Zhong and Xu 2009, Figure 12; values that it leaves out are filled in for a figure of those proportions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Measurements {
    /// Height from floor to crown.
    pub height: f64,
    /// Girth round the fullest part of the bust.
    pub bust: f64,
    /// Girth at the natural waist.
    pub waist: f64,
    /// Girth at the abdomen, half-way between waist and hip.
    pub abdomen: f64,
    /// Girth round the fullest part of the hip.
    pub hip: f64,
    /// Half the distance between the two shoulder tips.
    pub half_across_shoulder: f64,
    /// Girth at the middle of the neck.
    pub neck: f64,
    /// Length from shoulder tip to wrist, over the elbow.
    pub arm_length: f64,
    /// Girth round the fullest part of the upper arm.
    pub upper_arm: f64,
    /// Girth at the wrist.
    pub wrist: f64,
    /// Girth of the thigh just below the crotch.
    pub upper_thigh: f64,
    /// Girth of the thigh half-way between crotch and knee.
    pub mid_thigh: f64,
    /// Girth at the knee.
    pub knee: f64,
    /// Girth round the fullest part of the calf.
    pub calf: f64,
    /// Girth at the narrowest part above the ankle bones.
    pub ankle: f64,
    /// Length from the waist down the side to the ankle bone.
    pub waist_to_ankle: f64,
}

impl Default for Measurements {
    fn default() -> Self {
        Self {
            height: 1.78,
            bust: 0.9364,
            waist: 0.7066,
            abdomen: 0.8597,
            hip: 0.9800,
            half_across_shoulder: 0.2009,
            neck: 0.335,
            arm_length: 0.600,
            upper_arm: 0.275,
            wrist: 0.158,
            upper_thigh: 0.5577,
            mid_thigh: 0.4791,
            knee: 0.3531,
            calf: 0.345,
            ankle: 0.222,
            waist_to_ankle: 1.0794,
        }
    }
}

impl Measurements {
    /// Every measurement with its name, in the order of the fields.
    pub fn named(&self) -> [(&'static str, f64); 16] {
        let mut own = *self;
        own.named_mut().map(|(name, value)| (name, *value))
    }

    /// Every measurement with its name, mutable, in the order of the fields.
    pub fn named_mut(&mut self) -> [(&'static str, &mut f64); 16] {
        let Self {
            height,
            bust,
            waist,
            abdomen,
            hip,
            half_across_shoulder,
            neck,
            arm_length,
            upper_arm,
            wrist,
            upper_thigh,
            mid_thigh,
            knee,
            calf,
            ankle,
            waist_to_ankle,
        } = self;
        [
            ("height", height),
            ("bust", bust),
            ("waist", waist),
            ("abdomen", abdomen),
            ("hip", hip),
            ("half across shoulder", half_across_shoulder),
            ("neck", neck),
            ("arm length", arm_length),
            ("upper arm", upper_arm),
            ("wrist", wrist),
            ("upper thigh", upper_thigh),
            ("mid-thigh", mid_thigh),
            ("knee", knee),
            ("calf", calf),
            ("ankle", ankle),
            ("waist to ankle", waist_to_ankle),
        ]
    }
}
