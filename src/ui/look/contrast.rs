//! How well a colour is seen on another.

use egui::{Color32, Rgba};

/// Contrast ratio of WCAG 2.1 of two opaque colours, 1..=21.
pub fn contrast(a: Color32, b: Color32) -> f32 {
    let luminance = |c: Color32| {
        let [r, g, b, _] = Rgba::from(c).to_array();
        0.2126 * r + 0.7152 * g + 0.0722 * b
    };
    let (x, y) = (luminance(a) + 0.05, luminance(b) + 0.05);
    (x / y).max(y / x)
}

/// `ink` if it has at least the contrast `least` on `paper`, else black or white, whichever is seen better.
pub fn readable(ink: Color32, paper: Color32, least: f32) -> Color32 {
    if contrast(ink, paper) >= least {
        return ink;
    }
    let [black, white] = [Color32::BLACK, Color32::WHITE];
    if contrast(black, paper) >= contrast(white, paper) { black } else { white }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_are_those_of_wcag() {
        let near = |a: f32, b: f32| assert!((a - b).abs() < 0.01, "{a} {b}");
        near(contrast(Color32::BLACK, Color32::WHITE), 21.0);
        near(contrast(Color32::WHITE, Color32::WHITE), 1.0);
        // The grey that is just readable on white.
        near(contrast(Color32::from_gray(0x76), Color32::WHITE), 4.54);
        near(contrast(Color32::from_rgb(255, 0, 0), Color32::WHITE), 4.0);
    }

    #[test]
    fn on_every_grey_there_is_a_readable_ink() {
        for grey in 0..=255 {
            let paper = Color32::from_gray(grey);
            let ink = readable(Color32::from_gray(128), paper, 4.5);
            assert!(contrast(ink, paper) >= 4.5, "{grey}");
        }
    }
}
