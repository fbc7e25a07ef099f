//! What one global step is told to do.

/// What one global step does.
#[derive(Clone, Copy, Debug)]
pub struct GlobalStep {
    /// No vertex moves farther, metres.
    pub cap: f64,
    /// Weight of contact on the matrix diagonal, against 2/3 for each triangle round a vertex. It also holds the vertex where
    /// it is along the skin: a heavy weight keeps cloth out of the body while much moves, a light one lets it slide, and what
    /// that lets through the multiplier makes good.
    pub contact: f64,
    /// How strongly marked vertices are held where their marks are, as a weight on the diagonal.
    pub hold: f64,
    /// So far from there they are free, metres.
    pub slack: f64,
    /// Turn triangles that face against the cloth round them, and send cloth that faces the skin next to it (it belongs to
    /// another limb, or to the other side of a fold) away from there.
    pub unfold: bool,
    /// Apply gravity and friction.
    pub weight: bool,
}
