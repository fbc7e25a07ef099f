//! The pattern in all its sizes, cached until it changes.

use std::collections::BTreeMap;
use std::sync::Arc;

use egui::Color32;
use glam::DVec2;

use crate::geometry::ids::PieceId;
use crate::pattern::grading::{SeamGrowth, graded, growth_in};
use crate::pattern::piece::flattened_loop;
use crate::pattern::{GradeRule, Pattern, Piece, Problem, RulePoint};
use crate::ui::look::theme::Palette;

/// Flattening tolerance, metres.
const TOLERANCE: f64 = 4e-4;

/// A piece in one size, in its own plane.
#[derive(Clone, Debug)]
pub struct NestedPiece {
    /// Its closed lines as closed polylines.
    pub lines: Vec<Vec<DVec2>>,
    /// Its internal lines as polylines.
    pub inside: Vec<Vec<DVec2>>,
    /// The piece itself.
    piece: Arc<Piece>,
}

/// The pattern in all sizes but the base.
#[derive(Clone, Debug, Default)]
pub struct Nests {
    of: Option<Arc<Pattern>>,
    /// For each size the pieces that differ from the base size.
    pub pieces: Vec<BTreeMap<PieceId, NestedPiece>>,
    /// What cannot be cut in some size.
    pub problems: Vec<Problem>,
    /// Seams whose sides grow apart, in each size.
    pub growth: Vec<SeamGrowth>,
}

impl Nests {
    /// Takes over a pattern that has changed.
    pub fn update(&mut self, pattern: &Arc<Pattern>) {
        if self.of.as_ref().is_some_and(|of| Arc::ptr_eq(of, pattern)) {
            return;
        }
        *self = Self { of: Some(Arc::clone(pattern)), ..Self::default() };
        for size in &pattern.sizes.names {
            let Ok(graded) = graded(pattern, size) else { continue };
            let pieces = graded.moved.keys().filter_map(|id| {
                let piece = graded.pattern.pieces.get(id)?;
                let lines = piece.loops().map(|line| flattened_loop(line, TOLERANCE)).collect();
                let inside = piece.lines.iter().map(|line| line.flattened(TOLERANCE)).collect();
                Some((*id, NestedPiece { lines, inside, piece: Arc::clone(piece) }))
            });
            self.pieces.push(pieces.collect());
            self.growth.extend(growth_in(pattern, &graded, size));
            self.problems.extend(graded.problems);
        }
    }

    /// The place of a point of a closed or an internal line in size number `size`, in the plane of its piece.
    pub fn point(&self, size: usize, point: impl Into<RulePoint>) -> Option<DVec2> {
        let point = point.into();
        let in_size = self.pieces.get(size).and_then(|pieces| pieces.get(&point.piece));
        match in_size {
            Some(nested) => nested.piece.place_of(&point),
            None => self.of.as_ref()?.pieces.get(&point.piece)?.place_of(&point),
        }
    }

    /// How a point moves from size to size: by its rule, or as it follows the points beside it or the cloth round it.
    pub fn rule(&self, point: impl Into<RulePoint>) -> Option<GradeRule> {
        let (pattern, point) = (self.of.as_ref()?, point.into());
        let piece = pattern.pieces.get(&point.piece)?;
        let base = piece.place_of(&point)?;
        if let Some(rule) = piece.rule_of(&point) {
            return Some(rule.clone());
        }
        let by = |size| self.point(size, point).map_or(DVec2::ZERO, |p| p - base);
        Some(GradeRule((0..pattern.sizes.len()).map(by).collect()))
    }
}

/// Which sizes the pattern pane shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SizeView {
    /// Whether the outlines of all sizes are drawn.
    pub nested: bool,
    /// Number of the size whose points are moved; None: the base size.
    pub shown: Option<usize>,
}

impl Default for SizeView {
    fn default() -> Self {
        Self { nested: true, shown: None }
    }
}

impl SizeView {
    /// The size whose points are moved in place of those of the base.
    pub fn of(self, pattern: &Pattern) -> Option<usize> {
        self.shown.filter(|size| *size < pattern.sizes.len() && *size != pattern.sizes.base)
    }
}

/// The colour of size number `size` of `count`: from blue for the smallest to red for the largest.
pub fn size_colour(palette: &Palette, size: usize, count: usize) -> Color32 {
    let [saturation, value] = palette.seam_tone;
    let share = size as f32 / (count.max(2) - 1) as f32;
    egui::ecolor::Hsva::new(0.62 * (1.0 - share), saturation, value, 1.0).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::edit::PointRef;
    use crate::pattern::grading::READY_SIZES;
    use crate::pattern::{Edge, InternalLine};

    #[test]
    fn every_point_has_its_place_in_every_size() {
        let mut pattern = Pattern { sizes: READY_SIZES[0].run(), ..Pattern::default() };
        let mut piece = Piece::polygon("p", &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)].map(DVec2::from));
        piece.outline[1].rule = Some(GradeRule::even(DVec2::X * 0.01, 6, 2));
        let id = pattern.add_piece(piece);
        let mut nests = Nests::default();
        nests.update(&Arc::new(pattern));
        let point = |point| PointRef { piece: id, point };
        assert_eq!(nests.point(4, point(1)), Some(DVec2::new(1.02, 0.0)));
        assert_eq!(nests.point(2, point(1)), Some(DVec2::X), "the base");
        assert_eq!(nests.point(4, point(3)), None);
        assert_eq!(nests.rule(point(0)), Some(GradeRule(vec![DVec2::ZERO; 6])));
        assert!(nests.problems.is_empty() && nests.growth.is_empty());
    }

    #[test]
    fn points_of_internal_lines_have_their_places_too() {
        let mut pattern = Pattern { sizes: READY_SIZES[0].run(), ..Pattern::default() };
        let mut piece = Piece::polygon("p", &[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)].map(DVec2::from));
        let edges = vec![Edge { start: DVec2::new(0.5, 0.2), ..Edge::default() }];
        let (end, end_rule) = (DVec2::new(0.8, 0.2), Some(GradeRule::even(DVec2::Y * 0.01, 6, 2)));
        piece.lines.push(InternalLine { edges, end, end_rule: end_rule.clone(), ..InternalLine::default() });
        let id = pattern.add_piece(piece);
        let mut nests = Nests::default();
        nests.update(&Arc::new(pattern));
        let at = |point| RulePoint { piece: id, line: Some(0), point };
        assert_eq!(nests.point(4, at(1)), Some(DVec2::new(0.8, 0.22)));
        assert_eq!((nests.point(2, at(1)), nests.point(4, at(2))), (Some(end), None));
        assert_eq!((nests.rule(at(1)), nests.rule(at(0))), (end_rule, Some(GradeRule(vec![DVec2::ZERO; 6]))));
        assert_eq!(nests.pieces[4][&id].inside[0].last(), Some(&DVec2::new(0.8, 0.22)));
    }

    #[test]
    fn the_base_and_sizes_that_are_gone_are_not_shown_for_moving() {
        let pattern = Pattern { sizes: READY_SIZES[0].run(), ..Pattern::default() };
        let view = |shown| SizeView { shown, ..SizeView::default() };
        assert_eq!(view(Some(3)).of(&pattern), Some(3));
        assert_eq!([view(None), view(Some(2)), view(Some(6))].map(|view| view.of(&pattern)), [None; 3]);
    }
}
