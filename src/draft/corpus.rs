//! Which garments there are: designs, each for every body in every pose.

use crate::body::NamedPose;
use crate::draft::design::{Design, Kind};
use crate::draft::random::Random;
use crate::draft::sizes::BodySize;

/// What a corpus is made of.
#[derive(Clone, Debug)]
pub struct Corpus {
    /// Designs are drawn from it.
    pub seed: u64,
    /// Number of designs.
    pub designs: u32,
    /// Bodies that each is drafted for.
    pub sizes: Vec<BodySize>,
    /// Poses of these.
    pub poses: Vec<NamedPose>,
    /// Only these kinds take turns; all where there are none.
    pub kinds: Vec<Kind>,
}

/// A design for a body in a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// Number of the design, from 0.
    pub number: u32,
    /// The body.
    pub size: BodySize,
    /// How it stands.
    pub pose: NamedPose,
}

impl Case {
    /// "0012-raglan-m-a": also the stem of its files.
    pub fn name(&self, design: &Design) -> String {
        format!("{:04}-{}-{}-{}", self.number, design.kind.name(), self.size.name, self.pose.name())
    }
}

/// The `part`th of `of` parts of a corpus, from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    part: usize,
    of: usize,
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
    /// The cases of a shard. In the whole corpus every design comes once, on any of the bodies, before one comes again on the
    /// next; a shard takes every so manieth.
    pub fn cases(&self, shard: Shard) -> Vec<Case> {
        let bodies: Vec<(BodySize, NamedPose)> =
            self.sizes.iter().flat_map(|&size| self.poses.iter().map(move |&pose| (size, pose))).collect();
        let count = bodies.len();
        let case = |round: usize, number: u32| {
            // Each design begins elsewhere, whatever its number has in common with those of a shard.
            let begins = Random::new(u64::from(number)).bits() % count as u64;
            let (size, pose) = bodies[(begins as usize + round) % count];
            Case { number, size, pose }
        };
        let all = (0..count).flat_map(|round| (0..self.designs).map(move |number| (round, number)));
        let own = all.enumerate().filter(|(i, _)| i % shard.of == shard.part - 1);
        own.map(|(_, (round, number))| case(round, number)).collect()
    }

    /// The design of a case.
    pub fn design(&self, case: &Case) -> Design {
        let kinds: &[Kind] = if self.kinds.is_empty() { &Kind::ALL } else { &self.kinds };
        Design::drawn(self.seed, case.number, kinds)
    }
}
