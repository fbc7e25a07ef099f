//! A captured motion retargeted to the mannequin.

use crate::body::UpAxis;
use crate::body::mannequin::mannequin;
use crate::body::pose::motion::{Clip, Retarget};
use crate::session::BodyChoice;
use crate::ui::language::{said, say, tr};

/// A motion retargeted to the mannequin; its joint angles hold for mannequins of all measurements.
#[derive(Debug)]
pub struct PosedMotion {
    /// Name of the file.
    pub name: String,
    clip: Clip,
    retarget: Retarget,
    up: UpAxis,
}

impl PosedMotion {
    /// Retargets the motion `clip` to the mannequin of `body`, with the up axis that its rest pose suggests. The error is a
    /// message.
    pub fn new(name: String, mut clip: Clip, body: &BodyChoice) -> Result<Self, String> {
        let measurements = body.measurements().ok_or(tr("a BVH motion is for the mannequin"))?;
        let figure = mannequin(&measurements).map_err(|why| said(&why.words()))?;
        let up = clip.likely_up();
        clip.set_upright(up);
        let retarget = Retarget::new(&clip, &figure.skeleton).map_err(|why| said(&why))?;
        Ok(Self { name, clip, retarget, up })
    }

    /// Number of frames, at least 1.
    pub fn frames(&self) -> usize {
        self.clip.frames().max(1)
    }

    /// `body` in the pose and place of frame `i`; None for a body from a file.
    pub fn body(&self, body: &BodyChoice, i: usize) -> Option<BodyChoice> {
        body.posed(self.retarget.frame(&self.clip, 0, i).0)
    }

    /// A message about the up axis, and about joints without a counterpart.
    pub fn note(&self) -> Option<String> {
        let Retarget { unused, unmoved, .. } = &self.retarget;
        let mut notes = Vec::new();
        if self.up == UpAxis::Z {
            notes.push(tr("Its rest pose stands along z, which is taken to point up").to_owned());
        }
        if !unused.is_empty() {
            let names = unused.join(", ");
            notes.push(say!("Joints that move nothing of the mannequin: {names}", names));
        }
        if !unmoved.is_empty() {
            let names = unmoved.join(", ");
            notes.push(say!("Joints of the mannequin that nothing moves: {names}", names));
        }
        (!notes.is_empty()).then(|| notes.join(". "))
    }
}
