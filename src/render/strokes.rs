//! Lines, dots and digits as instances of one primitive, the capsule.

use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};

use super::scene::{Label, Polyline};

/// Instance data of one capsule. It matches `Stroke` in shaders/line.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(super) struct Stroke {
    a: Vec3,
    b: Vec3,
    offset_a: Vec2,
    offset_b: Vec2,
    colour: [u8; 4],
    half_width: f32,
    lift: f32,
    lift_widths: f32,
    /// Real width, metres; 0: none.
    thickness: f32,
}

impl Stroke {
    /// A stroke from `a` to `b`, `half_width` in pixels, nearer to the eye by `lift` metres.
    pub(super) fn along(a: Vec3, b: Vec3, colour: [u8; 4], half_width: f32, lift: f32) -> Self {
        let (offset_a, offset_b) = (Vec2::ZERO, Vec2::ZERO);
        Self { a, b, offset_a, offset_b, colour, half_width, lift, lift_widths: 0.0, thickness: 0.0 }
    }
}

/// All capsules in drawing order: borders of lines, lines, then each label with its badge and digits. `scale` is the number of
/// physical pixels per logical pixel.
pub(super) fn strokes(lines: &[Polyline], labels: &[Label], scale: f32) -> Vec<Stroke> {
    let mut all = Vec::new();
    for line in lines.iter().filter(|l| l.halo[3] > 0 && l.halo_width > 0.0) {
        push_line(&mut all, line, line.halo, (line.width / 2.0 + line.halo_width) * scale);
    }
    for line in lines {
        push_line(&mut all, line, line.colour, line.width / 2.0 * scale);
    }
    for label in labels {
        push_badge(&mut all, label, scale);
        push_digits(&mut all, label, scale);
    }
    all
}

fn push_line(all: &mut Vec<Stroke>, line: &Polyline, colour: [u8; 4], half_width: f32) {
    let mut push = |a: Vec3, b: Vec3| {
        all.push(Stroke {
            a,
            b,
            offset_a: Vec2::ZERO,
            offset_b: Vec2::ZERO,
            colour,
            half_width,
            lift: line.lift,
            lift_widths: line.lift_widths,
            thickness: line.thickness,
        });
    };
    match line.points.as_slice() {
        [] => {}
        [p] => push(*p, *p),
        points => {
            points.windows(2).for_each(|w| push(w[0], w[1]));
            if line.closed {
                push(points[points.len() - 1], points[0]);
            }
        }
    }
}

/// Adds a badge: a pill in the label's colour with a border, wide enough for its digits.
fn push_badge(all: &mut Vec<Stroke>, label: &Label, scale: f32) {
    let height = label.height * scale;
    let reach = (label.text.chars().count().max(1) - 1) as f32 * ADVANCE / 2.0 * height;
    let middle = label.offset * scale;
    for (colour, half_width) in [(label.halo, 0.98), (label.colour, 0.82)] {
        all.push(Stroke {
            a: label.anchor,
            b: label.anchor,
            offset_a: middle - Vec2::new(reach, 0.0),
            offset_b: middle + Vec2::new(reach, 0.0),
            colour,
            half_width: half_width * height,
            lift: label.lift,
            lift_widths: 0.0,
            thickness: 0.0,
        });
    }
}

/// Adds the digits as strokes of constant width.
fn push_digits(all: &mut Vec<Stroke>, label: &Label, scale: f32) {
    let height = label.height * scale;
    let count = label.text.chars().count() as f32;
    let start = Vec2::new(-((count - 1.0) * ADVANCE + DIGIT_WIDTH) / 2.0, -0.5);
    for (i, c) in label.text.chars().enumerate() {
        let corner = label.offset * scale + (start + Vec2::new(i as f32 * ADVANCE, 0.0)) * height;
        for path in digit(c) {
            for w in path.windows(2) {
                let place = |(x, y): (f32, f32)| corner + Vec2::new(x, y) * height;
                all.push(Stroke {
                    a: label.anchor,
                    b: label.anchor,
                    offset_a: place(w[0]),
                    offset_b: place(w[1]),
                    colour: label.halo,
                    half_width: 0.085 * height,
                    lift: label.lift,
                    lift_widths: 0.0,
                    thickness: 0.0,
                });
            }
        }
    }
}

/// Distance from one digit to the next, relative to the height of a digit.
const ADVANCE: f32 = 0.78;
/// Width of a digit, relative to its height.
const DIGIT_WIDTH: f32 = 0.55;

type Path = &'static [(f32, f32)];

/// Strokes of each digit in a box 0.55 wide and 1 high, y up.
const DIGITS: [&[Path]; 10] = [
    // 0
    &[&[
        (0.27, 1.0),
        (0.08, 0.88),
        (0.0, 0.62),
        (0.0, 0.38),
        (0.08, 0.12),
        (0.27, 0.0),
        (0.47, 0.12),
        (0.55, 0.38),
        (0.55, 0.62),
        (0.47, 0.88),
        (0.27, 1.0),
    ]],
    // 1
    &[&[(0.1, 0.8), (0.32, 1.0), (0.32, 0.0)]],
    // 2
    &[&[
        (0.02, 0.78),
        (0.1, 0.94),
        (0.28, 1.0),
        (0.46, 0.93),
        (0.53, 0.76),
        (0.47, 0.57),
        (0.0, 0.0),
        (0.55, 0.0),
    ]],
    // 3
    &[&[
        (0.03, 0.88),
        (0.26, 1.0),
        (0.47, 0.92),
        (0.52, 0.76),
        (0.44, 0.59),
        (0.24, 0.53),
        (0.46, 0.46),
        (0.55, 0.28),
        (0.47, 0.08),
        (0.25, 0.0),
        (0.0, 0.1),
    ]],
    // 4
    &[&[(0.42, 0.0), (0.42, 1.0), (0.0, 0.3), (0.56, 0.3)]],
    // 5
    &[&[
        (0.5, 1.0),
        (0.08, 1.0),
        (0.04, 0.56),
        (0.27, 0.63),
        (0.47, 0.53),
        (0.55, 0.32),
        (0.46, 0.09),
        (0.24, 0.0),
        (0.0, 0.09),
    ]],
    // 6
    &[&[
        (0.46, 1.0),
        (0.2, 0.84),
        (0.04, 0.55),
        (0.01, 0.28),
        (0.1, 0.07),
        (0.28, 0.0),
        (0.47, 0.09),
        (0.55, 0.3),
        (0.47, 0.52),
        (0.28, 0.6),
        (0.09, 0.5),
        (0.01, 0.28),
    ]],
    // 7
    &[&[(0.0, 1.0), (0.55, 1.0), (0.2, 0.0)]],
    // 8
    &[&[
        (0.28, 0.55),
        (0.09, 0.65),
        (0.05, 0.82),
        (0.14, 0.95),
        (0.28, 1.0),
        (0.42, 0.95),
        (0.5, 0.82),
        (0.46, 0.65),
        (0.28, 0.55),
        (0.08, 0.44),
        (0.0, 0.26),
        (0.09, 0.07),
        (0.28, 0.0),
        (0.47, 0.07),
        (0.55, 0.26),
        (0.47, 0.44),
        (0.28, 0.55),
    ]],
    // 9
    &[&[
        (0.09, 0.0),
        (0.35, 0.16),
        (0.51, 0.45),
        (0.54, 0.72),
        (0.45, 0.93),
        (0.27, 1.0),
        (0.08, 0.91),
        (0.0, 0.7),
        (0.08, 0.48),
        (0.27, 0.4),
        (0.46, 0.5),
        (0.54, 0.72),
    ]],
];

/// The strokes of a digit; empty for other characters.
fn digit(c: char) -> &'static [Path] {
    c.to_digit(10).map_or(&[], |digit| DIGITS[digit as usize])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_come_before_what_they_border() {
        let line = Polyline {
            points: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            closed: true,
            colour: [1, 1, 1, 255],
            width: 2.0,
            halo: [9, 9, 9, 255],
            halo_width: 1.0,
            lift: 0.0,
            lift_widths: 0.0,
            thickness: 0.0,
        };
        let all = strokes(&[line], &[], 2.0);
        assert_eq!(all.len(), 6);
        assert!(all[..3].iter().all(|s| s.colour[0] == 9 && s.half_width == 4.0));
        assert!(all[3..].iter().all(|s| s.colour[0] == 1 && s.half_width == 2.0));
    }

    #[test]
    fn every_digit_has_strokes_inside_its_box() {
        for c in '0'..='9' {
            let points: Vec<_> = digit(c).iter().flat_map(|p| p.iter()).collect();
            assert!(points.len() > 2, "{c}");
            assert!(points.iter().all(|(x, y)| (0.0..=0.6).contains(x) && (0.0..=1.0).contains(y)), "{c}");
        }
    }
}
