//! Pieces and seams measured in every size.

use serde::Serialize;

use crate::geometry::words::Words;
use crate::pack::shape::size_of;
use crate::pattern::grading::graded;
use crate::pattern::{Pattern, Problem};

/// A size, measured flat. Seam allowances do not count.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SizeRow {
    /// Its name.
    pub size: String,
    /// Width and height of each piece as it is drawn, in the order of their numbers, metres.
    pub pieces: Vec<[f64; 2]>,
    /// Length of the first side of each seam, in the order of their numbers, metres; None where there is no such stretch.
    pub seams: Vec<Option<f64>>,
    /// What cannot be cut in this size, in words.
    pub problems: Vec<Words>,
}

impl SizeRow {
    /// All sizes of `pattern`, from small to large; none where it is not graded.
    pub fn all(pattern: &Pattern) -> Vec<Self> {
        pattern.sizes.names.iter().filter_map(|size| Self::of(pattern, size)).collect()
    }

    fn of(pattern: &Pattern, size: &str) -> Option<Self> {
        let graded = graded(pattern, size).ok()?;
        let own = &graded.pattern;
        let length = |seam: &crate::pattern::Seam| {
            let side = seam.sides[0];
            side.length(own.pieces.get(&side.piece)?)
        };
        Some(Self {
            size: size.to_owned(),
            pieces: own.pieces.values().map(|piece| size_of(piece).to_array()).collect(),
            seams: own.seams.values().map(length).collect(),
            problems: graded.problems.iter().map(Problem::in_words).collect(),
        })
    }
}
