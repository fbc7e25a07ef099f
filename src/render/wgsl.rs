//! Built-in functions of WGSL, for what the processor computes as shaders do.

/// Smooth step from 0 at `low` to 1 at `high` (cubic Hermite interpolation), `low` < `high`.
pub(super) fn smoothstep(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// The value from `a` (`t` = 0) to `b` (`t` = 1).
pub(super) fn mix(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}
