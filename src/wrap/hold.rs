//! How marks hold the vertices at them: firmly while the cloth grows, then less and less, and hardly at all in the end.

/// How marks hold their vertices in a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hold {
    /// Weight on the diagonal of the matrix.
    pub weight: f64,
    /// Distance from the mark's position within which a vertex is free, metres.
    pub slack: f64,
}

/// How marks hold their vertices from growth to rest.
struct Holding {
    /// Weight while the cloth grows; nothing is free.
    growing: f64,
    /// Factors on that weight in the first steps of settling. They are few, so that the matrix changes seldom.
    fade: [f64; 3],
    /// Number of steps for each of these factors.
    steps_per_fade: usize,
    /// Weight after that, on a mesh with edges of `kept_edge`. It stops a garment that is too tight from creeping off along the
    /// body, as static friction would. It grows with the square of the edge length: with longer edges fewer vertices are along a
    /// mark, and the forces of strain are larger.
    kept: f64,
    /// Edge length at which the weight is `kept`, metres on a body 1.5 m large.
    kept_edge: f64,
    /// Distance within which vertices are free after that, metres on a body 1.5 m large.
    slack: f64,
}

/// Chosen by trial on the samples.
const HOLDING: Holding = Holding {
    growing: 0.3,
    fade: [1.0, 0.3, 0.1],
    steps_per_fade: 4,
    kept: 0.001,
    kept_edge: 0.0175,
    slack: 0.03,
};

impl Hold {
    /// While the cloth grows.
    pub fn growing() -> Self {
        Self { weight: HOLDING.growing, slack: 0.0 }
    }

    /// After `done` steps of the first part of settling; None once only [`Hold::kept`] is left.
    pub fn fading(done: usize) -> Option<Self> {
        let fading = HOLDING.fade.get(done / HOLDING.steps_per_fade)?;
        Some(Self { weight: HOLDING.growing * fading, slack: 0.0 })
    }

    /// At the end, on a mesh with edges of `edge_length` metres on a body of `scale`.
    pub fn kept(edge_length: f64, scale: f64) -> Self {
        let edge = edge_length / (HOLDING.kept_edge * scale);
        Self { weight: HOLDING.kept * edge * edge, slack: HOLDING.slack * scale }
    }
}
