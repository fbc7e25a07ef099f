//! Faults of a dressed garment, in words.

use crate::fit::report::{Moved, Report};
use crate::fit::spots::Spot;
use crate::geometry::problem::{Problem, ProblemKind};
use crate::geometry::words::{Words, decimal, words};

/// Strain (99th percentile, gathers left out) above which the garment does not fit.
const MOST_STRAIN: f64 = 0.25;

/// Cloth or a seam counts as torn when more than one in this many edges is stretched to twice its length; fewer are slivers.
const EDGES_PER_TEAR: usize = 1000;

/// Most seams named in one fault.
const MOST_NAMED: usize = 3;

/// Every fault of a dressed garment; empty when it is sewn, on the body, outside of it and the right way round.
pub fn verdict(report: &Report) -> Vec<Problem> {
    faults(report, Moved::Wrapped).into_iter().map(|(problem, _)| problem).collect()
}

/// Every fault with its place on the garment, which `moved` so to where it lies.
pub fn faults(report: &Report, moved: Moved) -> Vec<(Problem, Spot)> {
    let mut faults = Faults::default();
    faults.placing(report);
    faults.sewing(report);
    if moved == Moved::Draped {
        faults.fastening(report);
    }
    faults.body(report, moved);
    faults.openings(report);
    faults.cloth(report);
    faults.fit(report);
    faults.0
}

/// The widest gap, millimetres, in words.
fn widest(gap: f64) -> Words {
    words!("the widest gap is {mm} mm", mm = decimal(gap, 1))
}

#[derive(Default)]
struct Faults(Vec<(Problem, Spot)>);

impl Faults {
    fn tell(&mut self, spot: Spot, place: Words, words: Words) {
        let problem = Problem { kind: ProblemKind::Dressing, place, words };
        self.0.push((problem, spot));
    }

    /// Adds to the last fault that the pattern is too small: other marks or another start cannot mend that.
    fn fit(&mut self, report: &Report) {
        if let (Some(smaller), Some((problem, _))) = (report.strain_causes.too_small(), self.0.last_mut()) {
            let words = std::mem::take(&mut problem.words);
            problem.words = words.and("; ", smaller.words());
        }
    }

    fn placing(&mut self, report: &Report) {
        if report.not_finite_vertices > 0 {
            let n = report.not_finite_vertices;
            self.tell(
                Spot::Nowhere,
                words!("garment"),
                words!("{n} vertices have no finite position: the simulation broke", n),
            );
        }
        if report.triangles == 0 {
            self.tell(
                Spot::Nowhere,
                words!("garment"),
                words!("no cloth lies on the body: the wrap found no pair of marks to begin with"),
            );
            return;
        }
        for (i, piece) in report.pieces.iter().enumerate().filter(|(_, p)| p.missing_triangles > 0) {
            let place = words!("piece {name}", name = piece.name);
            let words = match piece.triangles {
                0 => words!(
                    "it still lies in the pattern plane: sew it to the others or give it a pair of marks"
                ),
                _ => words!("{n} of its triangles never reached the body", n = piece.missing_triangles),
            };
            self.tell(Spot::Piece(i), place, words);
        }
    }

    fn sewing(&mut self, report: &Report) {
        let seams = &report.seams;
        if seams.open > 0 {
            let gap = seams.max_gap * 1000.0;
            let mut named: Vec<Words> = report.open_seams.iter().take(MOST_NAMED).cloned().collect();
            if report.open_seams.len() > MOST_NAMED {
                named.push(Words::plain("…"));
            }
            let words = words!(
                "{n} of {count} seams are open: {names}",
                n = seams.open,
                count = seams.open + seams.closed,
                names = Words::joined(named, ", ")
            );
            // Seams of pieces that were left out are open without a gap.
            let words = if gap > 0.0 { words.and("; ", widest(gap)) } else { words };
            self.tell(Spot::Seams, words!("seams"), words);
        }
        let (found, expected) = (report.pieces_in_space, report.pieces_expected);
        if report.triangles > 0 && found != expected {
            self.tell(
                Spot::Nowhere,
                words!("garment"),
                words!("it lies in {n} separate parts", n = found)
                    .and("; ", words!("its seams should make {count}", count = expected)),
            );
        }
    }

    /// Cloth that was not draped is not buttoned yet.
    fn fastening(&mut self, report: &Report) {
        let (apart, gap) = (report.fastenings.apart, report.fastenings.max_gap * 1000.0);
        if apart > 0 {
            let words = match apart {
                1 => words!("1 fastened button does not close"),
                n => words!("{n} fastened buttons do not close", n),
            };
            let words = words.and("; ", widest(gap));
            self.tell(Spot::Nowhere, words!("fastenings"), words);
        }
    }

    fn body(&mut self, report: &Report, moved: Moved) {
        if moved == Moved::Draped && report.triangles > 0 && report.faces_near_body == 0 {
            let words =
                words!("it touches the body nowhere: it has fallen off it, or nothing holds it there");
            self.tell(Spot::Nowhere, words!("garment"), words);
        }
        let p = &report.penetration;
        if p.vertices > 0 || p.faces > 0 {
            let depth = p.max_depth * 1000.0;
            self.tell(
                Spot::Inside,
                words!("body"),
                words!(
                    "{n} vertices and {faces} triangles of the cloth are inside the body, up to {mm} mm",
                    n = p.vertices,
                    faces = p.faces,
                    mm = decimal(depth, 1)
                ),
            );
        }
        let (edges, body_edges) = (report.edges_through_body, report.body_edges_through_garment);
        if edges > 0 || body_edges > 0 {
            let words = match edges + body_edges {
                1 => words!("cloth and skin cut through each other in 1 place"),
                n => words!("cloth and skin cut through each other in {n} places", n),
            };
            let words = match report.cuts_at_body_overlaps {
                0 => words,
                n => words.and("; ", words!("near {n} of them parts of the body pass through each other", n)),
            };
            self.tell(Spot::Through, words!("body"), words);
        }
        let n = report.wrong_side_out(moved);
        if n > 0 {
            let words = match n {
                1 => words!("1 triangle lies wrong side out"),
                n => words!("{n} triangles lie wrong side out", n),
            };
            self.tell(Spot::WrongSide, words!("garment"), words);
        }
    }

    fn openings(&mut self, report: &Report) {
        for (i, opening) in report.missed_openings() {
            let (length, height) = (opening.length * 100.0, opening.height);
            self.tell(
                Spot::Opening(i),
                words!("opening of {cm} cm, {m} m above the ground", cm = decimal(length, 0), m = decimal(height, 2)),
                words!("the body does not pass through it: the cloth lies on one side of the limb, or a seam has a hole"),
            );
        }
    }

    fn cloth(&mut self, report: &Report) {
        if report.self_crossings > 0 {
            let n = report.self_crossings;
            let words = match n {
                1 => words!("the cloth passes through itself in 1 place"),
                n => words!("the cloth passes through itself in {n} places", n),
            };
            self.tell(Spot::Crossing, words!("garment"), words);
        }
        if report.degenerate_faces > 0 {
            let n = report.degenerate_faces;
            let words = match n {
                1 => words!("1 triangle has shrunk to nothing"),
                n => words!("{n} triangles have shrunk to nothing", n),
            };
            self.tell(Spot::Strained, words!("garment"), words);
        }
        let strain = report.strain;
        if strain.doubled * EDGES_PER_TEAR > strain.edges {
            let (n, percent) = (strain.doubled, strain.max * 100.0);
            let words = words!(
                "{n} edges are stretched to more than twice their length, by up to {percent} %: the cloth or a seam would have torn",
                n,
                percent = decimal(percent, 0)
            );
            self.tell(Spot::Strained, words!("garment"), words);
        }
        if report.uneased_p99 > MOST_STRAIN {
            let percent = report.uneased_p99 * 100.0;
            self.tell(
                Spot::Strained,
                words!("garment"),
                words!(
                    "its worst hundredth is strained by {percent} % and more: it does not fit this body",
                    percent = decimal(percent, 0)
                ),
            );
        }
    }
}
