//! Frames of a sequence from motion capture (BVH), applied to the mannequin.

use std::path::Path;
use std::sync::Arc;

use crate::body::pose::motion::{Clip, Retarget};
use crate::body::pose::{Rig, rig};
use crate::body::{Surface, UpAxis};
use crate::cli::failure::Failure;
use crate::io::bvh::{self, BvhError};
use crate::session::BodyChoice;

/// A motion retargeted to the mannequin.
pub struct Captured {
    clip: Clip,
    retarget: Retarget,
    rig: Arc<Rig>,
    /// Index of the reference frame, in which the mannequin is at its own horizontal position.
    first: usize,
    /// Whether z was taken to point up because of the rest pose.
    is_turned: bool,
}

impl Captured {
    /// Reads the motion in `bytes` (from `path`) and retargets it to the mannequin of `body`. `first` is the reference frame.
    /// Without `up` the axis is guessed from the motion's rest pose.
    pub fn new(
        path: &Path,
        bytes: &[u8],
        body: &BodyChoice,
        up: Option<UpAxis>,
        first: usize,
    ) -> Result<Self, Failure> {
        let mut clip = bvh::read(bytes).map_err(|error| match error {
            BvhError::OverLimit(words) => Failure::Limit(format!("{}: {words}", path.display())),
            error => Failure::input(path, error),
        })?;
        let likely = clip.likely_up();
        clip.set_upright(up.unwrap_or(likely));
        let words = "a BVH motion is for the mannequin, and the body of this project is from a file";
        let measurements = body.measurements().ok_or_else(|| Failure::input(path, words))?;
        let rig = rig(&measurements).map_err(|error| Failure::input(path, error))?;
        let retarget = Retarget::new(&clip, &rig.figure().skeleton);
        Ok(Self {
            retarget: retarget.map_err(|why| Failure::input(path, why))?,
            clip,
            rig,
            first,
            is_turned: up.is_none() && likely == UpAxis::Z,
        })
    }

    /// Number of frames of the file.
    pub fn frames(&self) -> usize {
        self.clip.frames()
    }

    /// Frames per second of the file.
    pub fn fps(&self) -> f64 {
        1.0 / self.clip.seconds_per_frame
    }

    /// Notes on the up axis, and on joints without a counterpart.
    pub fn notes(&self) -> Vec<String> {
        let Retarget { unused, unmoved, .. } = &self.retarget;
        let mut notes = Vec::new();
        if self.is_turned {
            notes.push("z is taken to point up, by its rest pose (see --up)".to_owned());
        }
        if !unused.is_empty() {
            notes.push(format!("joints that move nothing of the mannequin: {}", unused.join(", ")));
        }
        if !unmoved.is_empty() {
            notes.push(format!("joints of the mannequin that nothing moves: {}", unmoved.join(", ")));
        }
        notes
    }

    /// The mannequin in frame `i` of the file, from 0.
    pub fn body(&self, i: usize) -> Result<Arc<Surface>, Failure> {
        let (pose, place) = self.retarget.frame(&self.clip, self.first, i);
        let body = self.rig.placed(&pose, &place);
        body.ok_or_else(|| Failure::Check(format!("the mannequin cannot take the pose of frame {}", i + 1)))
    }
}
