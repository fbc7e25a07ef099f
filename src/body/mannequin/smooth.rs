//! Smooth unions and intersections of signed distances.

/// Smooth union of two signed distances, with a fillet about `k` metres wide; twice differentiable.
pub fn blended(a: f64, b: f64, k: f64) -> f64 {
    let h = (k - (a - b).abs()).max(0.0) / k;
    a.min(b) - h * h * h * k / 6.0
}

/// Smooth intersection of two signed distances, with a rounding about `k` metres wide.
pub fn cut(a: f64, b: f64, k: f64) -> f64 {
    -blended(-a, -b, k)
}
