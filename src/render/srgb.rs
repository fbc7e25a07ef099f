//! Colours of sRGB and linear light (transfer function and primaries of IEC 61966-2-1).

use std::sync::LazyLock;

use glam::Vec3;

use super::scene::Rgb;

/// Gamma-encoded sRGB, 0..=1.
pub(super) fn gamma(c: Rgb) -> Vec3 {
    Vec3::from(c.map(|v| f32::from(v) / 255.0))
}

/// Linear RGB, 0..=1.
pub fn linear(c: Rgb) -> Vec3 {
    Vec3::from(gamma(c).to_array().map(decoded))
}

/// Linear value of a gamma-encoded one, both 0..=1.
pub(super) fn decoded(v: f32) -> f32 {
    if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
}

/// sRGB of linear RGB; what is below 0 or above 1 is taken as that.
pub(super) fn encoded(linear: Vec3) -> Rgb {
    let one = |c: f32| if c <= 0.003_130_8 { c * 12.92 } else { 1.055 * c.powf(1.0 / 2.4) - 0.055 };
    linear.to_array().map(|c| byte(one(c)))
}

/// The byte of a share, 0..=1; what is below or above is taken as 0 or 1.
pub(super) fn byte(share: f32) -> u8 {
    (share.clamp(0.0, 1.0) * 255.0).round() as u8
}

/// Linear light of each sRGB value.
pub(super) static LINEAR: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|i| decoded(i as f32 / 255.0)));

/// Luminance of linear RGB (Rec. 709).
pub(super) fn luminance(linear: Vec3) -> f32 {
    linear.dot(Vec3::new(0.2126, 0.7152, 0.0722))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_is_decoded_and_encoded_again() {
        for c in 0..=255 {
            assert_eq!(encoded(linear([c, 255 - c, c / 2])), [c, 255 - c, c / 2]);
            assert_eq!(LINEAR[usize::from(c)], linear([c; 3]).x);
        }
        assert!((decoded(188.0 / 255.0) - 0.5).abs() < 0.005, "half of the light");
        assert_eq!(encoded(Vec3::new(-1.0, 0.5, 9.0)), [0, 188, 255]);
        assert!((luminance(Vec3::ONE) - 1.0).abs() < 1e-6);
    }
}
