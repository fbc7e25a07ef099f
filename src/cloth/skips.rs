//! What may be skipped, and what must not be for once: to see what a skip saves, and that it changes nothing.

use std::str::FromStr;

/// Work that is left out where it would change nothing, or nothing to speak of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Skip {
    /// Cloth known to be outside and far enough from the skin does not ask for it until it has moved that far.
    Certificates,
    /// Cloth that moved less than a fifth of a millimetre keeps its plane of the skin.
    Planes,
    /// Where the nearest triangle of the body cannot be another than those round the last one, only they are looked at.
    Triangles,
    /// Faces that cannot have come near the skin, or turned from it, since they were looked at last are not looked at again.
    Faces,
    /// Where no layers ran through each other, nobody looks again until the cloth lies still.
    Crossings,
    /// The matrix is factored anew only when more than a share of the contacts has changed.
    Refactor,
    /// The long slow swings of a fine mesh are left to coarser ones, dressed first.
    Fine,
    /// Edges that the body is too far from or too flat to be cut by are not tested exactly.
    Edges,
    /// Edges that cannot come as deep into the body as its bones lie are not tested against them.
    Bones,
    /// While cloth is dragged on within a tick the skin next to it is walked to, and searched for at the end of it.
    Walks,
}

impl Skip {
    /// All of them, in the order of [`Skip::name`].
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

    /// As it is typed.
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

    /// Whether the cloth lies the same, bit for bit, without it. The others take another way to where it rests.
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

/// Which skips are made: all, unless told otherwise.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Skips {
    /// A bit for each of [`Skip::ALL`].
    forbidden: u32,
}

impl Skips {
    /// All but these.
    pub fn without(skips: &[Skip]) -> Self {
        Self { forbidden: skips.iter().fold(0, |bits, &skip| bits | 1 << skip as u32) }
    }

    /// Whether `skip` is made.
    pub fn allow(self, skip: Skip) -> bool {
        self.forbidden & (1 << skip as u32) == 0
    }
}

/// Names with commas between them, or "all".
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
