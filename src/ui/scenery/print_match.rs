//! How well prints meet at seams: the offset between the repeats on both sides.

use glam::DVec2;

use crate::cloth::Garment;
use crate::geometry::ids::SeamId;
use crate::pattern::Pattern;
use crate::session::{Dyes, Motif, Print};
use crate::ui::scenery::fabric_looks::on_fabric;

/// A seam between pieces with the same print.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PrintMatch {
    /// The seam.
    pub seam: SeamId,
    /// What is printed.
    pub motif: Motif,
    /// Largest offset of the print along the seam, metres, at most half a repeat.
    pub offset: f64,
}

/// The seams of `garment`, cut from `pattern`, both sides of which have the same motif and repeat.
pub fn print_matches(garment: &Garment, pattern: &Pattern, dyes: &Dyes) -> Vec<PrintMatch> {
    let grain = |piece| pattern.pieces.get(&piece).map_or(DVec2::Y, |piece| piece.grain());
    let of_seam = |(seam, pairs): &(SeamId, Vec<[u32; 2]>)| {
        let sides = pairs.iter().map(|pair| pair.map(|corner| garment.corners[corner as usize]));
        let mut offset = None;
        let mut motif = None;
        for [a, b] in sides {
            let prints = [a, b].map(|corner| dyes.of(corner.piece).print);
            let [Some(one), Some(other)] = prints else { return None };
            if (one.motif, one.repeat_m) != (other.motif, other.repeat_m) {
                return None;
            }
            let apart = offset_of(one, [a, b].map(|corner| on_fabric(corner.uv, grain(corner.piece))));
            offset = Some(offset.map_or(apart, |most: f64| most.max(apart)));
            motif = Some(one.motif);
        }
        Some(PrintMatch { seam: *seam, motif: motif?, offset: offset? })
    };
    garment.seam_pairs.iter().filter_map(of_seam).collect()
}

/// Offset between the repeats of `print` at two places of flat cloth, metres. A motif and its mirror image count as the same: all
/// motifs are symmetric.
fn offset_of(print: Print, [a, b]: [DVec2; 2]) -> f64 {
    let repeat = print.repeat_m;
    let phase = |x: f64| ((x / repeat + 0.5).rem_euclid(1.0) - 0.5).abs() * repeat;
    let apart = |a: f64, b: f64| phase(a - b).min(phase(a + b));
    match print.motif {
        Motif::Stripes => apart(a.x, b.x),
        Motif::Hoops => apart(a.y, b.y),
        Motif::Checks | Motif::Dots => apart(a.x, b.x).max(apart(a.y, b.y)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cloth::build;
    use crate::pattern::{EdgeRef, Piece, Seam};
    use crate::session::Dye;

    /// Two squares with sides of 20 cm sewn along upright sides; the second is drawn `up` metres higher in its own plane.
    fn garment(up: f64) -> (Garment, Pattern) {
        let square =
            |up: f64| [(0.0, 0.0), (0.2, 0.0), (0.2, 0.2), (0.0, 0.2)].map(|(x, y)| DVec2::new(x, y + up));
        let mut pattern = Pattern::default();
        let [a, b] =
            [("a", 0.0), ("b", up)].map(|(name, up)| pattern.add_piece(Piece::polygon(name, &square(up))));
        let sides = [EdgeRef { piece: a, edge: 1 }, EdgeRef { piece: b, edge: 3 }];
        pattern.add_seam(Seam::of_edges(sides, false));
        (build(&pattern, 0.05).0, pattern)
    }

    fn offsets((garment, pattern): &(Garment, Pattern), motif: Motif, repeat_m: f64) -> Vec<f64> {
        let print = Print { motif, repeat_m, colour: [255; 3] };
        let mut dyes = Dyes::default();
        dyes.set(None, Dye { print: Some(print), ..Dye::default() });
        print_matches(garment, pattern, &dyes).iter().map(|found| found.offset).collect()
    }

    #[test]
    fn hoops_meet_where_the_pieces_are_drawn_alike() {
        let near = |found: Vec<f64>, wanted: f64| found.len() == 1 && (found[0] - wanted).abs() < 1e-9;
        assert!(near(offsets(&garment(0.0), Motif::Hoops, 0.03), 0.0));
        assert!(near(offsets(&garment(0.03), Motif::Hoops, 0.03), 0.0), "a whole repeat higher");
        assert!(near(offsets(&garment(0.0), Motif::Stripes, 0.04), 0.0), "20 cm are five repeats");
        assert!(near(offsets(&garment(0.0), Motif::Stripes, 0.03), 0.01), "and six and two thirds");
        let higher = offsets(&garment(0.005), Motif::Hoops, 0.03);
        assert!(higher.len() == 1 && higher[0] > 0.001 && higher[0] < 0.0051, "{higher:?}");
        let (garment, pattern) = garment(0.0);
        assert!(print_matches(&garment, &pattern, &Dyes::default()).is_empty(), "nothing is printed");
    }
}
