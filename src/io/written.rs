//! A written pattern file, and notes on what the format could not hold.

use std::collections::BTreeMap;

use crate::geometry::ids::SeamId;
use crate::geometry::words::{Words, words};
use crate::pattern::{Edge, EdgeShape, InternalLine, Pattern, Piece, Seam};

/// Largest number of names listed; further ones are only counted.
const NAMED: usize = 3;

/// The contents of a file to be saved.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Written {
    /// The bytes of the file.
    pub bytes: Vec<u8>,
    /// Parts of the pattern that the format cannot hold, a line each; empty when all of it is there.
    pub left_out: Vec<Words>,
    /// The grade rule table that belongs beside a DXF (`.rul`), where the pattern has sizes.
    pub rules: Option<Vec<u8>>,
}

/// Parts of a pattern that not every format can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Part {
    Curves,
    SmoothPoints,
    EdgeNames,
    Holes,
    Lines,
    LineNames,
    Notches,
    Grainline,
    Allowance,
    CutLine,
    Symmetry,
    Twin,
    Layer,
    MeshSize,
    Placement,
    Roll,
    PlaceOnBody,
    Seams,
    Ratios,
    Sizes,
}

impl Part {
    fn words(self) -> Words {
        match self {
            Self::Curves => words!("curves (written as short straight lines)"),
            Self::SmoothPoints => words!("which points are smooth"),
            Self::EdgeNames => words!("names of edges"),
            Self::Holes => words!("holes"),
            Self::Lines => words!("internal lines"),
            Self::LineNames => words!("names of internal lines"),
            Self::Notches => words!("notches"),
            Self::Grainline => words!("the grainline"),
            Self::Allowance => words!("the seam allowance"),
            Self::CutLine => words!("the cut line"),
            Self::Symmetry => words!("that the halves stay mirror images"),
            Self::Twin => words!("that it mirrors another piece"),
            Self::Layer => words!("the layer it is worn on"),
            Self::MeshSize => words!("the mesh size it asks for"),
            Self::Placement => words!("its place round the body"),
            Self::Roll => words!("its roll round a limb"),
            Self::PlaceOnBody => words!("the part of the body it belongs to"),
            Self::Seams => words!("seams"),
            Self::Ratios => words!("that lengths of seams are kept"),
            Self::Sizes => words!("the sizes and their grade rules"),
        }
    }
}

/// A line for each part that `pattern` has and that is not in `holds`.
pub(super) fn left_out(pattern: &Pattern, holds: &[Part]) -> Vec<Words> {
    let mut missing: BTreeMap<Part, Vec<&str>> = BTreeMap::new();
    for piece in pattern.pieces.values() {
        for part in parts_of_piece(piece) {
            missing.entry(part).or_default().push(&piece.name);
        }
    }
    let mut lines: Vec<Words> = missing
        .into_iter()
        .filter(|(part, _)| !holds.contains(part))
        .map(|(part, names)| {
            words!("{names}: not in the file: {what}", names = listed(&names), what = part.words())
        })
        .collect();
    if !pattern.sizes.is_empty() && !holds.contains(&Part::Sizes) {
        lines.push(words!("not in the file: {what}", what = Part::Sizes.words()));
    }
    let count = |part: Part, has: fn(&Seam) -> bool| {
        let count = pattern.seams.values().filter(|seam| has(seam)).count();
        (count > 0 && !holds.contains(&part)).then_some(count)
    };
    if let Some(n) = count(Part::Seams, |_| true) {
        lines.push(words!("{n} seams: not in the file", n));
    } else if let Some(n) = count(Part::Ratios, |seam| seam.ratio.is_some()) {
        lines.push(words!("{n} seams: not in the file: {what}", n, what = Part::Ratios.words()));
    }
    lines
}

/// A line about seams that could not be written for the reason `why`.
pub(super) fn seams_left_out(seams: &[SeamId], why: Words) -> Option<Words> {
    let names: Vec<Words> = seams.iter().map(|&seam| seam.into()).collect();
    (!seams.is_empty())
        .then(|| words!("{names}: not in the file: {what}", names = listed_words(names), what = why))
}

fn parts_of_piece(piece: &Piece) -> Vec<Part> {
    // All fields are named, so that a new one is not forgotten. What belongs to the editor and not to the garment, such as the
    // position of a piece in the pattern plane, is no loss.
    let Piece {
        name: _,
        outline,
        holes,
        lines,
        notches,
        grainline,
        allowance,
        cut_line,
        symmetric,
        twin,
        locked: _,
        hidden: _,
        layer,
        mesh_size,
        activity: _,
        pose: _,
        placement,
        label,
    } = piece;
    let edges = || outline.iter().chain(holes.iter().flatten()).chain(lines.iter().flat_map(line_edges));
    let has = [
        (Part::Curves, edges().any(|e| e.shape != EdgeShape::Line)),
        (Part::SmoothPoints, edges().any(|e| e.smooth)),
        (Part::EdgeNames, edges().any(|e| e.label.is_some())),
        (Part::Holes, !holes.is_empty()),
        (Part::Lines, !lines.is_empty()),
        (Part::LineNames, lines.iter().any(|l| !l.name.is_empty())),
        (Part::Notches, !notches.is_empty()),
        (Part::Grainline, grainline.is_some()),
        (Part::Allowance, *allowance > 0.0),
        (Part::CutLine, !cut_line.is_empty()),
        (Part::Symmetry, *symmetric),
        (Part::Twin, twin.is_some()),
        (Part::Layer, *layer > 0),
        (Part::MeshSize, mesh_size.is_some()),
        (Part::Placement, placement.is_some()),
        (Part::Roll, placement.is_some_and(|pose| pose.roll.is_some())),
        (Part::PlaceOnBody, label.is_some()),
    ];
    has.into_iter().filter(|(_, has)| *has).map(|(part, _)| part).collect()
}

fn line_edges(line: &InternalLine) -> &[Edge] {
    &line.edges
}

/// A list of names, such as "front, back, sleeve and 2 more".
fn listed(names: &[&str]) -> Words {
    listed_words(names.iter().map(|&name| Words::plain(name)).collect())
}

fn listed_words(mut names: Vec<Words>) -> Words {
    let more = names.len().saturating_sub(NAMED);
    names.truncate(NAMED);
    let first = Words::joined(names, ", ");
    match more {
        0 => first,
        more => words!("{first} and {more} more", first, more),
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::pattern::Notch;

    #[test]
    fn what_is_missing_is_told_in_a_line_each() {
        let mut pattern = Pattern::default();
        for i in 0..5 {
            let mut piece = Piece::polygon(&format!("p{i}"), &[DVec2::ZERO, DVec2::X, DVec2::Y]);
            piece.notches.push(Notch { edge: 0, at: 0.5 });
            piece.allowance = 0.01;
            pattern.add_piece(piece);
        }
        assert_eq!(
            left_out(&pattern, &[Part::Allowance]),
            ["p0, p1, p2 and 2 more: not in the file: notches"]
        );
        assert!(left_out(&pattern, &[Part::Allowance, Part::Notches]).is_empty());
    }
}
