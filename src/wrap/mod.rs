//! Paper A's wrap: marks, root edges, growth, settling.

pub mod coarser;
pub mod dressing;
pub mod growth;
mod hold;
mod limbs;
pub mod mark_error;
pub mod marks;
pub mod order;
mod placed;
mod plan;
pub mod roots;
mod settling;
pub mod suggest;
mod tube;

pub use coarser::coarser;
pub use dressing::{Dressed, Dressing, Phase};
pub use mark_error::{MarkError, mark_error};
pub use marks::{BodyMark, ClothMark, ClothSide, MarkPlace, Marks, Tie};
pub use placed::{AT_AN_EDGE, EDGE_SAMPLES, RUNS_ALONG};
pub use roots::{PairStretch, stretches};
pub use suggest::{ROUND_LIMBS, Stand, are_suggested, stand, suggested};
