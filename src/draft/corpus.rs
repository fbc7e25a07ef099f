//! The corpus: all designs, each for every body size in every pose.

use crate::body::NamedPose;
use crate::draft::design::{Design, Kind};
use crate::draft::sizes::BodySize;
use crate::geometry::random::Random;

/// Definition of a corpus.
#[derive(Clone, Debug)]
pub struct Corpus {
    /// Seed from which the designs are drawn.
    pub seed: u64,
    /// Number of designs.
    pub designs: u32,
    /// Body sizes that each design is drafted for.
    pub sizes: Vec<BodySize>,
    /// Poses of each body.
    pub poses: Vec<NamedPose>,
    /// Kinds of garments, which take turns; empty: all kinds.
    pub kinds: Vec<Kind>,
}

/// A design for a body size in a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// Number of the design, from 0.
    pub number: u32,
    /// Body size.
    pub size: BodySize,
    /// Pose of the body.
    pub pose: NamedPose,
}

impl Case {
    /// Name such as "0012-raglan-m-a": also the stem of its files.
    pub fn name(&self, design: &Design) -> String {
        format!("{:04}-{}-{}-{}", self.number, design.kind.name(), self.size.name, self.pose.name())
    }
}

/// Part number `part` (from 1) of `of` parts of a corpus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    part: usize,
    of: usize,
}

impl Shard {
    /// Whether the `index`-th of all (from 0) is in this part.
    pub fn has(self, index: usize) -> bool {
        index % self.of == self.part - 1
    }

    /// Name for files, such as "2-of-8".
    pub fn name(self) -> String {
        format!("{}-of-{}", self.part, self.of)
    }
}

impl Default for Shard {
    fn default() -> Self {
        Self { part: 1, of: 1 }
    }
}

impl std::str::FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/').and_then(|(part, of)| Some((part.parse().ok()?, of.parse().ok()?)));
        let sound = parts.filter(|(part, of)| (1..=*of).contains(part));
        let words = || format!("{text:?} is not PART/OF, such as 1/4 to 4/4");
        sound.map(|(part, of)| Self { part, of }).ok_or_else(words)
    }
}

impl Corpus {
    /// The cases of a shard. In the whole corpus every design comes once, on one of the bodies, before any comes again on the
    /// next body; of `of` shards, each takes every `of`-th case.
    pub fn cases(&self, shard: Shard) -> Vec<Case> {
        let bodies: Vec<(BodySize, NamedPose)> =
            self.sizes.iter().flat_map(|&size| self.poses.iter().map(move |&pose| (size, pose))).collect();
        let count = bodies.len();
        let case = |round: usize, number: u32| {
            // Each design begins with a body that does not depend on how its number and the number of shards relate.
            let begins = Random::new(u64::from(number)).bits() % count as u64;
            let (size, pose) = bodies[(begins as usize + round) % count];
            Case { number, size, pose }
        };
        let all = (0..count).flat_map(|round| (0..self.designs).map(move |number| (round, number)));
        let own = all.enumerate().filter(|(i, _)| shard.has(*i));
        own.map(|(_, (round, number))| case(round, number)).collect()
    }

    /// The design of a case.
    pub fn design(&self, case: &Case) -> Design {
        let kinds: &[Kind] = if self.kinds.is_empty() { &Kind::ALL } else { &self.kinds };
        Design::drawn(self.seed, case.number, kinds)
    }
}
