//! Combining garments that are worn over each other into one pattern.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use glam::DVec2;

use crate::geometry::ids::PieceId;
use crate::geometry::words::{Words, words};
use crate::pattern::edit::grading::take_run;
use crate::pattern::{Pattern, Piece};

/// The highest layer.
pub const MOST_LAYER: u8 = 15;
/// Gap between garments side by side on the table (the pattern plane), metres.
const BESIDE: f64 = 0.1;

impl Pattern {
    /// The highest layer of the pattern's pieces; 0 when it has none.
    pub fn outermost(&self) -> u8 {
        self.pieces.values().map(|piece| piece.layer).max().unwrap_or(0)
    }

    /// Adds the pieces and seams of `garment`, on layers over those of this pattern and beside it on the table. A piece
    /// whose name is taken gets `name` as a prefix. Err: a message, where the layers would exceed [`MOST_LAYER`].
    pub fn wear_over(&mut self, garment: &Pattern, name: &str) -> Result<(), Words> {
        let first = if self.pieces.is_empty() { 0 } else { self.outermost() + 1 };
        if first.saturating_add(garment.outermost()) > MOST_LAYER {
            return Err(words!("no more than {most} layers can be worn", most = MOST_LAYER + 1));
        }
        if self.sizes.is_empty() {
            self.sizes = garment.sizes.clone();
        }
        let beside = match (self.bounds(), garment.bounds()) {
            (Some((_, right)), Some((left, _))) => DVec2::X * (right.x - left.x + BESIDE),
            _ => DVec2::ZERO,
        };
        let taken: BTreeSet<String> = self.pieces.values().map(|piece| piece.name.clone()).collect();
        let mut ids: BTreeMap<PieceId, PieceId> = BTreeMap::new();
        for (&old, piece) in &garment.pieces {
            let mut piece = Piece::clone(piece);
            if taken.contains(&piece.name) {
                piece.name = format!("{name} {}", piece.name);
            }
            piece.layer += first;
            piece.pose.offset += beside;
            let mut piece = Arc::new(piece);
            take_run(&mut piece, &garment.sizes, &self.sizes);
            ids.insert(old, self.add_piece(Arc::unwrap_or_clone(piece)));
        }
        for id in ids.values() {
            if let Some(piece) = self.pieces.get_mut(id)
                && let Some(twin) = piece.twin
            {
                Arc::make_mut(piece).twin = ids.get(&twin).copied();
            }
        }
        for seam in garment.seams.values() {
            let [Some(&one), Some(&other)] = seam.sides.map(|side| ids.get(&side.piece)) else { continue };
            let mut seam = *seam;
            (seam.sides[0].piece, seam.sides[1].piece) = (one, other);
            self.add_seam(seam);
        }
        for button in garment.buttons.values() {
            let [Some(&one), Some(&other)] = button.pieces().map(|piece| ids.get(&piece)) else { continue };
            let mut button = *button;
            (button.button.piece, button.hole.piece) = (one, other);
            self.add_button(button);
        }
        Ok(())
    }

    /// Lower left and upper right corner of all pieces on the table, metres. None without pieces.
    pub(in crate::pattern) fn bounds(&self) -> Option<(DVec2, DVec2)> {
        let on_table = |piece: &Arc<Piece>| {
            let pose = piece.pose;
            piece.flattened(1e-3).into_iter().map(move |p| pose.plane_from_piece(p))
        };
        let points = self.pieces.values().flat_map(on_table);
        points.fold(None, |known, p| {
            Some(known.map_or((p, p), |(low, high): (DVec2, DVec2)| (low.min(p), high.max(p))))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::{EdgeRef, Seam};

    fn square(name: &str) -> Piece {
        Piece::polygon(name, &[DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y])
    }

    fn pair(names: [&str; 2]) -> Pattern {
        let mut pattern = Pattern::default();
        let [a, b] = names.map(|name| pattern.add_piece(square(name)));
        Arc::make_mut(pattern.pieces.get_mut(&a).expect("just added")).twin = Some(b);
        let side = |piece| EdgeRef { piece, edge: 1 };
        pattern.add_seam(Seam::of_edges([side(a), side(b)], false));
        pattern
    }

    #[test]
    fn what_is_worn_over_keeps_its_seams_and_lies_beside() {
        let mut outfit = pair(["front", "back"]);
        outfit.wear_over(&pair(["front", "hood"]), "hoody").expect("two layers");
        let names: Vec<(&str, u8)> = outfit.pieces.values().map(|p| (&*p.name, p.layer)).collect();
        assert_eq!(names, [("front", 0), ("back", 0), ("hoody front", 1), ("hood", 1)]);
        let ids: Vec<PieceId> = outfit.pieces.keys().copied().collect();
        let seams: Vec<[PieceId; 2]> =
            outfit.seams.values().map(|s| s.sides.map(|side| side.piece)).collect();
        assert_eq!(seams, [[ids[0], ids[1]], [ids[2], ids[3]]]);
        assert_eq!(outfit.pieces[&ids[2]].twin, Some(ids[3]));
        assert!((outfit.pieces[&ids[2]].pose.offset.x - 1.1).abs() < 1e-9);
    }

    #[test]
    fn there_are_no_more_layers_than_can_be_told_apart() {
        let mut outfit = Pattern::default();
        for _ in 0..=MOST_LAYER {
            outfit.wear_over(&pair(["a", "b"]), "again").expect("as many as there may be");
        }
        let words = outfit.wear_over(&pair(["a", "b"]), "again").expect_err("one more");
        assert!(words.contains("16 layers"), "{words}");
    }
}
