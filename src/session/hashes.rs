//! Document hashes. Parts that have not changed are not hashed again.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::Serialize;

use crate::geometry::ids::ImageId;
use crate::pattern::Pattern;
use crate::session::animations::Animations;
use crate::session::artwork::{Artwork, ImageFile};
use crate::session::body_choice::BodyChoice;
use crate::session::document::{Aim, Document};
use crate::sim::hash::{Fnv, hash_of};
use crate::wrap::Marks;

/// Computes document hashes, with a cache for the last parts. Holding the parts keeps their addresses from being reused.
#[derive(Debug, Default)]
pub struct DocumentHasher {
    pattern: Option<(Arc<Pattern>, u64)>,
    marks: Option<(Arc<Marks>, u64)>,
    body: Option<(BodyChoice, u64)>,
    aim: Option<(Arc<Aim>, u64)>,
    animations: Option<(Arc<Animations>, u64)>,
    images: BTreeMap<ImageId, Option<(Arc<ImageFile>, u64)>>,
}

impl DocumentHasher {
    /// Hash of `document` and of the numbers of steps that can be undone (`done`) and redone (`undone`).
    pub fn hash(&mut self, document: &Document, done: usize, undone: usize) -> u64 {
        let Document {
            pattern,
            body,
            marks,
            last_mark,
            pins,
            last_pin,
            aim,
            animations,
            moment,
            bones,
            fabrics,
            dyes,
            colourways,
            artwork,
            settings,
        } = document;
        let mut hash = Fnv::default();
        hash.number(shared(&mut self.pattern, pattern));
        hash.number(shared(&mut self.marks, marks));
        hash.number(self.body(body));
        hash.number(u64::from(*last_mark));
        if !pins.is_empty() || *last_pin > 0 {
            hash.number(json_hash(&**pins));
            hash.number(u64::from(*last_pin));
        }
        if let Some(aim) = aim {
            hash.number(shared(&mut self.aim, aim));
        }
        if let Some(animations) = animations {
            hash.number(shared(&mut self.animations, animations));
        }
        if let Some(moment) = moment {
            hash.number(json_hash(moment));
        }
        if let Some(bones) = bones {
            hash.number(json_hash(&**bones));
        }
        if !fabrics.is_usual() {
            hash.number(json_hash(fabrics));
        }
        if !dyes.is_plain() {
            hash.number(json_hash(dyes));
        }
        if !colourways.is_empty() {
            hash.number(json_hash(&**colourways));
        }
        if !artwork.is_empty() {
            self.artwork(artwork, &mut hash);
        }
        hash.number(json_hash(settings));
        hash.number(done as u64);
        hash.number(undone as u64);
        hash.finish()
    }

    /// Adds images, each of which is hashed once, and graphics.
    fn artwork(&mut self, artwork: &Artwork, hash: &mut Fnv) {
        let Artwork { images, graphics, last } = artwork;
        self.images.retain(|id, _| images.contains_key(id));
        for (id, file) in images {
            hash.number(u64::from(id.0));
            hash.number(shared(self.images.entry(*id).or_default(), file));
        }
        hash.number(json_hash(graphics));
        hash.number(u64::from(*last));
    }

    fn body(&mut self, body: &BodyChoice) -> u64 {
        // Compared by identity, not by equality: 0 and -0 are equal but are written differently.
        let is_same = |kept: &BodyChoice| match (kept, body) {
            (BodyChoice::Imported { name, mesh }, BodyChoice::Imported { name: other, mesh: of_other }) => {
                name == other && Arc::ptr_eq(mesh, of_other)
            }
            _ => false,
        };
        match &self.body {
            Some((kept, hash)) if is_same(kept) => *hash,
            _ => {
                let hash = json_hash(body);
                self.body = Some((body.clone(), hash));
                hash
            }
        }
    }
}

fn shared<T: Serialize>(kept: &mut Option<(Arc<T>, u64)>, part: &Arc<T>) -> u64 {
    match kept {
        Some((known, hash)) if Arc::ptr_eq(known, part) => *hash,
        _ => {
            let hash = json_hash(part);
            *kept = Some((Arc::clone(part), hash));
            hash
        }
    }
}

/// Hash of the JSON of a value, which is canonical thanks to ordered maps and shortest floats. A value that cannot be written as
/// JSON hashes as nothing; a NaN cannot occur, since commands are checked.
fn json_hash<T: Serialize + ?Sized>(value: &T) -> u64 {
    hash_of(&serde_json::to_vec(value).unwrap_or_default())
}
