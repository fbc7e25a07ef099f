//! Bodies that are no people, made by others and scaled: a scarf round an octopus, a tube on a koala's leg.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use toile::body::measure::section;
use toile::body::{Surface, Unit, import};
use toile::cloth::build;
use toile::fit::{BodyIndex, Report, measure, verdict};
use toile::geometry::ids::{MarkId, PieceId};
use toile::io::obj;
use toile::pattern::{EdgeRef, Pattern, Piece, Seam};
use toile::relax::RelaxSettings;
use toile::wrap::{BodyMark, ClothMark, ClothSide, Dressing, Marks, Phase};

/// Metres.
const EDGE: f64 = 0.01;

/// A body of `bodies/nonhuman`, its unit taken for a decimetre.
fn creature(file: &str) -> Option<Arc<Surface>> {
    let read = obj::read(&crate::bytes(&format!("bodies/nonhuman/{file}"))?).expect("an OBJ");
    Some(Arc::new(Surface::new(import(read.mesh, Unit::Decimetre).mesh).expect("triangles")))
}

/// A closed line round a limb, that begins at its front and goes to its left first.
struct Ring {
    points: Vec<DVec3>,
    lengths: Vec<f64>,
}

impl Ring {
    /// Where the plane at `height` cuts the limb whose middle passes the test `of_limb`.
    fn new(surface: &Surface, height: f64, of_limb: impl Fn(DVec3) -> bool) -> Self {
        let middle = |points: &[DVec3]| points.iter().sum::<DVec3>() / points.len() as f64;
        let mut points = section(&surface.mesh, DVec3::Y * height, DVec3::Y)
            .into_iter()
            .filter(|points| of_limb(middle(points)))
            .max_by_key(Vec::len)
            .expect("a limb");
        let turn: f64 = (0..points.len()).map(|i| points[i].cross(points[(i + 1) % points.len()]).y).sum();
        if turn < 0.0 {
            points.reverse();
        }
        let front = (0..points.len()).max_by(|&a, &b| points[a].z.total_cmp(&points[b].z)).unwrap_or(0);
        points.rotate_left(front);
        points.push(points[0]);
        let mut lengths = vec![0.0];
        points.windows(2).for_each(|w| lengths.push(lengths[lengths.len() - 1] + w[0].distance(w[1])));
        Self { points, lengths }
    }

    fn girth(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    fn at(&self, s: f64) -> DVec3 {
        let s = s.rem_euclid(self.girth());
        let i = self.lengths.partition_point(|&l| l <= s).clamp(1, self.points.len() - 1);
        let along = (s - self.lengths[i - 1]) / (self.lengths[i] - self.lengths[i - 1]).max(1e-12);
        self.points[i - 1].lerp(self.points[i], along)
    }

    /// The part of it round `middle` that is `half` metres long both ways.
    fn part(&self, middle: f64, half: f64) -> Vec<DVec3> {
        (0..=40).map(|k| self.at(middle + half * (f64::from(k) / 20.0 - 1.0))).collect()
    }
}

/// Adds a pair of strokes: `half` metres both ways from the middle of the piece at height `y`, and `body`.
fn pair(marks: &mut Marks, piece: PieceId, half: f64, y: f64, body: Vec<DVec3>) {
    let id = marks.cloth.len() as u32 * 2 + 100;
    let points = vec![DVec2::new(-half, y), DVec2::new(half, y)];
    marks.cloth.push(ClothMark { id: MarkId(id), piece, side: ClothSide::Front, points });
    marks.body.push(BodyMark { id: MarkId(id + 1), points: body });
}

fn dressed(pattern: &Pattern, surface: &Arc<Surface>, marks: &Marks) -> Report {
    let garment = Arc::new(build(pattern, EDGE).0);
    let (dressing, mut state, problems) =
        Dressing::new(garment.clone(), surface.clone(), marks, RelaxSettings::default());
    assert!(problems.is_empty(), "{problems:?}");
    let mut dressing = dressing.expect("a dressing");
    while dressing.step(&mut state) != Phase::AtRest {}
    let report = measure(pattern, &garment, &state, &BodyIndex::new(surface));
    assert_eq!(verdict(&report), []);
    assert_eq!(report.penetration.vertices + report.penetration.faces, 0);
    assert_eq!(report.edges_through_body + report.body_edges_through_garment, 0);
    assert_eq!(report.self_crossings + report.flipped_faces, 0);
    assert!(report.strain.p99 < 0.02, "p99 strain {}", report.strain.p99);
    report
}

#[test]
fn a_scarf_lies_round_the_octopus() {
    let Some(octopus) = creature("octopus_surface.obj") else { return };
    let (half, width) = (0.25, 0.07);
    let strip = [(-half, 0.0), (half, 0.0), (half, width), (-half, width)].map(DVec2::from);
    let mut pattern = Pattern::default();
    let scarf = pattern.add_piece(Piece::polygon("scarf", &strip));
    let head = Ring::new(&octopus, 0.06, |_| true);
    let mut marks = Marks::default();
    let marked = half - 0.01;
    pair(&mut marks, scarf, marked, width / 2.0, head.part(0.0, marked));
    assert_eq!(dressed(&pattern, &octopus, &marks).openings.len(), 1);
}

#[test]
fn a_tube_is_pulled_over_the_koalas_leg() {
    let Some(koala) = creature("koala_low_resolution.obj") else { return };
    let (lower, upper) = (-0.072, -0.02);
    let left_fore_leg = |middle: DVec3| middle.x > 0.0 && middle.z > 0.0;
    let leg = |height| Ring::new(&koala, height, left_fore_leg);
    let ease = 0.012 + TAU * RelaxSettings::default().offset * koala.scale();
    let [bottom, top] = [lower, upper].map(|height| (leg(height).girth() + ease) / 4.0);
    let height = upper - lower;
    let half = [(-bottom, 0.0), (bottom, 0.0), (top, height), (-top, height)].map(DVec2::from);
    let mut pattern = Pattern::default();
    let [front, back] = ["front", "back"].map(|name| pattern.add_piece(Piece::polygon(name, &half)));
    for (edge, other) in [(1, 3), (3, 1)] {
        let sides = [EdgeRef { piece: front, edge }, EdgeRef { piece: back, edge: other }];
        pattern.add_seam(Seam::of_edges(sides, false));
    }
    let ring = leg((lower + upper) / 2.0);
    let quarter = ring.girth() / 4.0;
    let mut marks = Marks::default();
    for (piece, middle) in [(front, 0.0), (back, 2.0 * quarter)] {
        let marked = 0.475 * (bottom + top);
        pair(&mut marks, piece, marked, height / 2.0, ring.part(middle, 0.95 * quarter));
    }
    let report = dressed(&pattern, &koala, &marks);
    assert_eq!(report.openings.iter().map(|o| o.body_through).collect::<Vec<_>>(), [true, true]);
}
