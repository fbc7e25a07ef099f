//! Switches for shortcuts that skip work, so that one can measure what each saves and check that it changes nothing.

use std::str::FromStr;

/// A shortcut: work that is skipped where it would change nothing, or almost nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Skip {
    /// A vertex known to be outside and far enough from the skin is not checked again until it has moved by that distance.
    Certificates,
    /// A vertex that moved less than a fifth of a millimetre keeps its contact plane.
    Planes,
    /// Where the nearest triangle of the body must be one of those round the last nearest, only these are tested.
    Triangles,
    /// Faces that cannot have come near the skin, or turned away from it, since their last check are not checked again.
    Faces,
    /// Where no layers intersected, intersections are not sought again until the cloth is at rest; while it is draped not as long as
    /// contact keeps it from crossing.
    Crossings,
    /// The matrix is factored again only when more than a certain fraction of the contacts has changed.
    Refactor,
    /// The slow large motions of a fine mesh are left to coarser meshes, which are dressed first.
    Fine,
    /// Edges that cannot be cut by the body, because it is too far or too flat, are not tested exactly.
    Edges,
    /// Edges that cannot be as deep in the body as its bones are not tested against them.
    Bones,
    /// During the substeps of a drag the nearest point of the skin is found by a walk, and by a full query only at
    /// the end of the tick.
    Walks,
}

impl Skip {
    /// All shortcuts, in the order of [`Skip::name`].
    pub const ALL: [Self; 10] = [
        Self::Certificates,
        Self::Planes,
        Self::Triangles,
        Self::Faces,
        Self::Crossings,
        Self::Refactor,
        Self::Fine,
        Self::Edges,
        Self::Bones,
        Self::Walks,
    ];

    /// Name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Certificates => "certificates",
            Self::Planes => "planes",
            Self::Triangles => "triangles",
            Self::Faces => "faces",
            Self::Crossings => "crossings",
            Self::Refactor => "refactor",
            Self::Fine => "fine",
            Self::Edges => "edges",
            Self::Bones => "bones",
            Self::Walks => "walks",
        }
    }

    /// Whether the cloth's positions are the same, bit for bit, without the shortcut. With the others it takes
    /// another path to its rest state.
    pub fn is_exact(self) -> bool {
        matches!(self, Self::Certificates | Self::Triangles | Self::Faces | Self::Bones)
    }
}

impl FromStr for Skip {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let names = || Self::ALL.map(Self::name).join(", ");
        let found = Self::ALL.into_iter().find(|skip| skip.name() == text);
        found.ok_or_else(|| format!("{text:?} is not one of {}, all", names()))
    }
}

/// The set of allowed shortcuts: all, unless told otherwise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Skips {
    /// One bit for each of [`Skip::ALL`]; set when the shortcut is forbidden.
    forbidden: u32,
}

impl Skips {
    /// All shortcuts except these.
    pub fn without(skips: &[Skip]) -> Self {
        Self { forbidden: skips.iter().fold(0, |bits, &skip| bits | 1 << skip as u32) }
    }

    /// Whether `skip` is allowed.
    pub fn allow(self, skip: Skip) -> bool {
        self.forbidden & (1 << skip as u32) == 0
    }
}

/// Parses names separated by commas, or "all".
impl FromStr for Skips {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "all" {
            return Ok(Self::without(&Skip::ALL));
        }
        let skips: Result<Vec<Skip>, String> = text.split(',').map(|name| name.trim().parse()).collect();
        skips.map(|skips| Self::without(&skips))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_read() {
        let skips: Skips = "planes,refactor".parse().expect("two names");
        assert!(Skip::ALL.iter().all(|&s| skips.allow(s) != matches!(s, Skip::Planes | Skip::Refactor)));
        let all: Skips = "all".parse().expect("all");
        assert!(Skip::ALL.iter().all(|&s| !all.allow(s)));
        assert!(Skip::ALL.iter().all(|&s| Skips::default().allow(s) && s.name().parse() == Ok(s)));
        assert!("".parse::<Skips>().is_err() && "plane".parse::<Skips>().is_err());
    }
}
