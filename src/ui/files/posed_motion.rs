//! A captured motion that the mannequin can be led through.

use crate::body::UpAxis;
use crate::body::mannequin::mannequin;
use crate::body::pose::motion::{Clip, Retarget};
use crate::session::BodyChoice;

/// A motion put on the mannequin of one set of measurements: its angles do for all.
#[derive(Debug)]
pub struct PosedMotion {
    /// Of the file.
    pub name: String,
    clip: Clip,
    retarget: Retarget,
    up: UpAxis,
}

impl PosedMotion {
    /// The motion `clip` for the mannequin of `body`, set upright as its rest pose tells. The error says in words why it
    /// cannot make it.
    pub fn new(name: String, mut clip: Clip, body: &BodyChoice) -> Result<Self, String> {
        let measurements = body.measurements().ok_or("a BVH motion is for the mannequin")?;
        let figure = mannequin(&measurements).map_err(|e| e.to_string())?;
        let up = clip.likely_up();
        clip.set_upright(up);
        let retarget = Retarget::new(&clip, &figure.skeleton)?;
        Ok(Self { name, clip, retarget, up })
    }

    /// How many frames it has, one or more.
    pub fn frames(&self) -> usize {
        self.clip.frames().max(1)
    }

    /// `body` in frame `i`, where it stands. None for a body from a file.
    pub fn body(&self, body: &BodyChoice, i: usize) -> Option<BodyChoice> {
        body.posed(self.retarget.frame(&self.clip, 0, i).0)
    }

    /// How it was taken, and which joints found no partner, in words.
    pub fn note(&self) -> Option<String> {
        let Retarget { unused, unmoved, .. } = &self.retarget;
        let list = |words: &str, names: String| format!("{words}: {names}");
        let mut notes = Vec::new();
        if self.up == UpAxis::Z {
            notes.push("Its rest pose stands along z, which is taken to point up".to_owned());
        }
        if !unused.is_empty() {
            notes.push(list("Joints that move nothing of the mannequin", unused.join(", ")));
        }
        if !unmoved.is_empty() {
            notes.push(list("Joints of the mannequin that nothing moves", unmoved.join(", ")));
        }
        (!notes.is_empty()).then(|| notes.join(". "))
    }
}
