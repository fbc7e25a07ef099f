//! What of body and cloth is drawn besides their surfaces.

use crate::render::Look;

/// What of body and cloth is drawn besides their surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sight {
    /// Edges of the cloth's triangles.
    pub wire: bool,
    /// The body can be seen through.
    pub sheer: bool,
    /// Marks, pins and seams show through.
    pub xray: bool,
    /// Marks on the table are joined to their partners on the body.
    pub pairs: bool,
}

impl Default for Sight {
    fn default() -> Self {
        Self { wire: false, sheer: false, xray: false, pairs: true }
    }
}

impl Sight {
    /// `look` with it.
    pub fn on(self, look: Look) -> Look {
        let Self { wire, sheer, xray, .. } = self;
        Look { wire, sheer, xray, ..look }
    }
}
