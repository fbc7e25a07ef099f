//! The body that the cloth is put on.

pub mod bones;
pub mod closest;
pub mod import;
pub mod landmarks;
pub mod mannequin;
pub mod measure;
pub mod pose;
pub mod readings;
pub mod sections;
mod shoulders;
pub mod skeleton;
pub mod surface;
pub mod unit;
pub mod up;
pub mod warp;

pub use import::{BodyReport, Imported, import};
pub use landmarks::Landmarks;
pub use mannequin::{Mannequin, MannequinError, Measurements};
pub use pose::{NamedPose, Pose};
pub use sections::Trunk;
pub use skeleton::{Joint, Skeleton};
pub use surface::{Hit, Nearest, Surface};
pub use unit::{Unit, guess_unit};
pub use up::UpAxis;
