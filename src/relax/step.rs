//! Parameters of a global step.

/// Parameters of one global step.
#[derive(Clone, Copy, Debug)]
pub struct GlobalStep {
    /// Largest move of a vertex, metres.
    pub cap: f64,
    /// Weight of contact on the matrix diagonal; each triangle round a vertex adds 2/3 there. It also resists sliding
    /// along the skin: a heavy weight keeps cloth out of the body while it moves much, a light one lets it slide, and
    /// the multiplier makes up for what that lets through.
    pub contact: f64,
    /// Weight on the diagonal by which vertices are held at their marks.
    pub hold: f64,
    /// Distance from the mark's position within which a held vertex is free, metres.
    pub slack: f64,
    /// Whether to turn over triangles that face against the cloth round them, and to move cloth away from skin on
    /// whose wrong side it is (it belongs to another limb, or to the other side of a fold).
    pub unfold: bool,
    /// Whether to apply gravity and friction.
    pub weight: bool,
}
