//! Parameters of a global step.

/// Usual [`GlobalStep::cap`], metres on a body 1.5 m large. Chosen by trial; it bounds how far a vertex goes before contacts are
/// found anew.
pub const STEP_CAP: f64 = 0.02;
/// A heavy [`GlobalStep::contact`], which keeps tight cloth that lies on the body from slipping through a limb. Chosen by trial.
pub const HEAVY_CONTACT: f64 = 0.1;
/// Step by which cloth that is inside the body, or on the wrong side of skin or of other cloth, is moved out of it, metres on a body
/// 1.5 m large. Chosen by trial; it bounds how far one step may go before it is looked again which way is out.
pub const STEP_OUT: f64 = 0.003;
/// Cosine between the normals of two faces, or of a face and the cloth round it, below which the cloth is folded over there. Steps
/// that unfold turn such faces over. About 102°. Chosen by trial.
pub const FOLDED: f64 = -0.2;

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
