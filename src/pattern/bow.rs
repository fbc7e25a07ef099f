//! Bows: pieces of ribbon that are sewn to a bow and tacked to a place of a garment.
//!
//! The knot is a strip that is closed to a tube, which lies across the bow. At either end of the tube its front half holds the front
//! of a loop, the upper half of its back the back of the loop, and the lower half a tail; they are gathered there. So the whole bow is
//! one cloth whose pieces do not pass through each other, and can be sewn from where they are placed: the knot and the loops rolled to
//! tubes, the tails hanging under them.

use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::sync::Arc;

use glam::{DMat3, DQuat, DVec2, DVec3};
use serde::{Deserialize, Serialize};

use crate::geometry::ids::PieceId;
use crate::geometry::polygon::{distance_to_segment, is_inside, sides};
use crate::geometry::words::{Words, words};
use crate::pattern::piece::flattened_loop;
use crate::pattern::trims::beyond;
use crate::pattern::{Button, Edge, EdgeRef, Pattern, Piece, PiecePoint, PlanePose, Roll, Seam, SpacePose};

/// Range of the width of the ribbon, metres.
pub const BOW_WIDTHS: std::ops::RangeInclusive<f64> = 0.02..=0.2;
/// Range of the length of a loop, metres; no less than the ribbon is wide.
pub const BOW_LOOPS: std::ops::RangeInclusive<f64> = 0.02..=0.4;
/// Range of the length of a tail, metres.
pub const BOW_TAILS: std::ops::RangeInclusive<f64> = 0.03..=1.5;

/// Length of the strip of the knot, its width, and widths at the knot of the backs of the loops and of the tails, in widths of the
/// ribbon. A smaller knot is drawn to nothing by the weight of the loops. What is gathered more at its back trembles there and is late to
/// rest.
const KNOT: [f64; 2] = [1.4, 0.5];
const LOOP_BACK: f64 = 0.45;
const TAIL_TOP: f64 = 0.4;
/// Share of the strip of a loop, from its tip to its back end, at which it begins to taper.
const TAPER: f64 = 0.3;
/// How much the slanted end of a tail is higher on one side, in widths of the ribbon.
const SLANT: f64 = 0.45;
/// Angle of the tails away from each other as placed, radians.
const SPREAD: f64 = 0.2;
/// Radius of a rolled strip over that of the closed tube: its ends are apart as placed.
const OPEN: [f64; 2] = [1.12, 1.08];
/// Distance of loops and tails from the knot, and of the tails from the loops, as placed, metres.
const GAPS: [f64; 2] = [0.006, 0.012];
/// Distance of the loops from the garment as placed, metres.
const CLEARANCE: f64 = 0.02;
/// Distance before the place of a bow, metres, within which cloth counts as lying in front of it.
const IN_FRONT: f64 = 0.2;
/// Mesh size, in widths of the ribbon, and its least and largest value, metres: fine enough for gathers and a round knot.
const MESH: (f64, [f64; 2]) = (0.115, [0.004, 0.012]);
/// Distance of the two tacks from the middle, in half widths of the knot, and their place on the strip of the knot from the middle of
/// its front, in half lengths: on the upper half of its back, so that the bow hangs from them.
const TACKS: [f64; 2] = [0.5, 0.8];
/// Least distance of a tack from the outline of the garment's piece, metres.
const INSET: f64 = 0.003;
/// Distance of the pieces from the pattern and from each other on the table, metres.
const BESIDE: f64 = 0.03;

/// Measures of a bow, metres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bow {
    /// Width of the ribbon, within [`BOW_WIDTHS`].
    pub width: f64,
    /// Length of a loop from the knot to its tip, within [`BOW_LOOPS`].
    pub loops: f64,
    /// Length of a tail, within [`BOW_TAILS`].
    pub tails: f64,
}

impl Bow {
    /// The bow that is offered first.
    pub const USUAL: Self = Self { width: 0.06, loops: 0.09, tails: 0.24 };

    /// What is out of range, in words.
    pub fn problem(&self) -> Option<Words> {
        let within = |what: Words, value: f64, range: &std::ops::RangeInclusive<f64>| {
            beyond(what, value, *range.start(), *range.end())
        };
        within(words!("the width of the ribbon of a bow (m)"), self.width, &BOW_WIDTHS)
            .or_else(|| within(words!("the length of the loops of a bow (m)"), self.loops, &BOW_LOOPS))
            .or_else(|| within(words!("the length of the tails of a bow (m)"), self.tails, &BOW_TAILS))
            .or_else(|| {
                (self.loops < self.width)
                    .then(|| words!("the loops of a bow are at least as long as its ribbon is wide"))
            })
    }

    /// Half the width of the knot, metres.
    fn knot(&self) -> f64 {
        KNOT[1] * self.width / 2.0
    }

    /// Length of the strip of the knot, metres.
    fn round(&self) -> f64 {
        KNOT[0] * self.width
    }

    /// Radius of a loop as placed, metres.
    fn radius(&self) -> f64 {
        OPEN[1] * self.loops / PI
    }
}

/// The frame of a bow: the middle of its knot, and its axes to the wearer's left, up and outwards.
#[derive(Clone, Copy, Debug)]
struct Frame {
    at: DVec3,
    turn: DQuat,
}

impl Frame {
    /// The place `at` of `host`, and the unit direction in its plane that goes to the wearer's left there. Without a place of the bow
    /// in space where `host` has none.
    fn of(host: &Piece, at: DVec2) -> (Option<Self>, DVec2) {
        let Some(pose) = host.placement else {
            let left = if host.pose.flipped { -DVec2::X } else { DVec2::X };
            return (None, DVec2::from_angle(-host.pose.rotation).rotate(left));
        };
        let [x, y] = pose.axes_at(at);
        let out = (x.cross(y) * host.signed_area().signum()).normalize_or(DVec3::Z);
        let up = (DVec3::Y - out * out.y).try_normalize().unwrap_or_else(|| y.normalize_or(DVec3::Y));
        let left = up.cross(out);
        let turn = DQuat::from_mat3(&DMat3::from_cols(left, up, out)).normalize();
        let along = DVec2::new(left.dot(x), left.dot(y)).normalize_or(DVec2::X);
        (Some(Self { at: pose.at(at), turn }), along)
    }

    /// Distance of the foremost cloth of this layer that is placed before the bow's place and not far from it, metres; the place itself is
    /// at 0.
    fn beyond(&self, pattern: &Pattern, layer: u8, bow: &Bow) -> f64 {
        let wide = bow.knot() + 2.0 * bow.radius() + BESIDE;
        let (high, low) = (bow.width / 2.0 + BESIDE, -bow.width / 2.0 - bow.tails - BESIDE);
        let placed = pattern.pieces.values().filter(|piece| piece.layer == layer);
        let places = placed.filter_map(|piece| Some((piece, piece.placement?))).flat_map(|(piece, pose)| {
            let outline = piece.flattened(1e-3);
            let inside = |[a, b]: [DVec2; 2]| (0..8).map(move |k| a.lerp(b, f64::from(k) / 8.0));
            let points: Vec<DVec2> = sides(&outline).flat_map(inside).collect();
            points.into_iter().map(move |p| pose.at(p))
        });
        let own = places.map(|p| self.turn.inverse() * (p - self.at));
        let near = own.filter(|p| p.x.abs() < wide && (low..high).contains(&p.y) && p.z < IN_FRONT);
        near.map(|p| p.z).fold(0.0, f64::max)
    }

    /// A placement given in the frame.
    fn placed(&self, pose: SpacePose) -> SpacePose {
        pose.moved(self.turn, DVec3::ZERO, self.at)
    }
}

impl Pattern {
    /// Adds a bow, tacked to the place `at`, upright, on the outer side of that piece and in its layer. It is placed before that place and
    /// before what is placed in front of it. Returns its pieces: the knot, both loops, both tails, those on the wearer's left first. Err: why
    /// there can be none, in words.
    pub fn add_bow(&mut self, at: PiecePoint, bow: &Bow) -> Result<[PieceId; 5], Words> {
        if let Some(words) = bow.problem() {
            return Err(words);
        }
        let host = self.pieces.get(&at.piece).map(Arc::clone);
        let host = host.ok_or_else(|| words!("there is no {what}", what = at.piece))?;
        let (frame, left) = Frame::of(&host, at.at);
        let aside = tacks(&host, at.at, left * (TACKS[0] * bow.knot()))?;
        let mut maker = Maker::new(self, host, frame, bow);
        let (knot, loops, tails) = (maker.knot(), maker.loops(), maker.tails());
        sew(self, knot, [loops, tails]);
        for (way, by) in aside {
            let strip = DVec2::new(way * TACKS[0] * bow.knot(), TACKS[1] * bow.round() / 2.0);
            let place = PiecePoint { at: at.at + by, ..at };
            self.add_button(Button::tack(place, PiecePoint { piece: knot, at: strip }));
        }
        Ok([knot, loops[0], loops[1], tails[0], tails[1]])
    }
}

/// Adds the pieces of a bow to a pattern.
struct Maker<'a> {
    pattern: &'a mut Pattern,
    host: Arc<Piece>,
    frame: Option<Frame>,
    bow: &'a Bow,
    /// Distance of the bow from its place, outwards, metres.
    forward: f64,
    /// Lower left corner of the next piece on the table, metres.
    corner: DVec2,
}

impl<'a> Maker<'a> {
    fn new(pattern: &'a mut Pattern, host: Arc<Piece>, frame: Option<Frame>, bow: &'a Bow) -> Self {
        let corner = pattern.bounds().map_or(DVec2::ZERO, |(low, high)| DVec2::new(high.x, low.y));
        let before = frame.map_or(0.0, |frame| frame.beyond(pattern, host.layer, bow));
        let forward = before + bow.radius() + CLEARANCE;
        Self { pattern, host, frame, bow, forward, corner: corner + DVec2::X * BESIDE }
    }

    /// Adds a piece with these `edges` (start and name each) and its grain along `grain`, placed at `pose` in the frame of the bow.
    fn add(&mut self, name: &str, edges: &[(DVec2, &str)], grain: DVec2, pose: SpacePose) -> PieceId {
        let edge = |&(start, label): &(DVec2, &str)| Edge {
            start,
            label: Some(label.to_owned()),
            ..Edge::default()
        };
        let starts = || edges.iter().map(|(start, _)| *start);
        let low = starts().fold(DVec2::INFINITY, DVec2::min);
        let high = starts().fold(DVec2::NEG_INFINITY, DVec2::max);
        let (middle, half) = (low.midpoint(high), grain * ((high - low).dot(grain) / 4.0));
        let offset = self.corner - low;
        self.corner.x += high.x - low.x + BESIDE;
        let pose = pose.moved(DQuat::IDENTITY, DVec3::ZERO, DVec3::Z * self.forward);
        let (share, [least, most]) = MESH;
        self.pattern.add_piece(Piece {
            name: name.to_owned(),
            outline: edges.iter().map(edge).collect(),
            grainline: Some([middle - half, middle + half]),
            allowance: self.host.allowance,
            layer: self.host.layer,
            mesh_size: Some((share * self.bow.width).clamp(least, most)),
            pose: PlanePose { offset, ..PlanePose::default() },
            placement: self.frame.map(|frame| frame.placed(pose)),
            label: self.host.label.clone(),
            ..Piece::default()
        })
    }

    /// The strip of the knot, from the middle of the back under it, up its front, and over it to the middle of the back.
    fn knot(&mut self) -> PieceId {
        let (x, y) = (self.bow.knot(), self.bow.round() / 2.0);
        let p = |x: f64, y: f64| DVec2::new(x, y);
        let edges = [
            (p(-x, -y), "knot end"),
            (p(x, -y), "tail left"),
            (p(x, -y / 2.0), "loop front left"),
            (p(x, y / 2.0), "loop back left"),
            (p(x, y), "knot end"),
            (p(-x, y), "loop back right"),
            (p(-x, y / 2.0), "loop front right"),
            (p(-x, -y / 2.0), "tail right"),
        ];
        let radius = OPEN[0] * self.bow.round() / TAU;
        let roll = Roll { centre: DVec2::ZERO, along: DVec2::X, radius };
        let pose = SpacePose { roll: Some(roll), ..SpacePose::flat(DVec3::Z * radius, DQuat::IDENTITY) };
        self.add("bow knot", &edges, DVec2::Y, pose)
    }

    /// Both loops, the left first: strips rolled to upright tubes beside the knot, from its front to its back.
    fn loops(&mut self) -> [PieceId; 2] {
        let Bow { width, loops: long, .. } = *self.bow;
        let (front, back, taper) = (width / 2.0, LOOP_BACK * width / 2.0, TAPER * long);
        let left = [
            (DVec2::new(-long, -front), "loop edge"),
            (DVec2::new(taper, -front), "loop edge"),
            (DVec2::new(long, -back), "loop back"),
            (DVec2::new(long, back), "loop edge"),
            (DVec2::new(taper, front), "loop edge"),
            (DVec2::new(-long, front), "loop front"),
        ];
        let right = [
            (DVec2::new(-long, -back), "loop edge"),
            (DVec2::new(-taper, -front), "loop edge"),
            (DVec2::new(long, -front), "loop front"),
            (DVec2::new(long, front), "loop edge"),
            (DVec2::new(-taper, front), "loop edge"),
            (DVec2::new(-long, back), "loop back"),
        ];
        let radius = self.bow.radius();
        let tip = self.bow.knot() + GAPS[0] + radius * (1.0 - (PI / OPEN[1]).cos());
        let roll = Roll { centre: DVec2::ZERO, along: DVec2::Y, radius };
        [("left", left, 1.0), ("right", right, -1.0)].map(|(side, edges, way)| {
            let turn = DQuat::from_rotation_y(way * FRAC_PI_2);
            let pose = SpacePose { roll: Some(roll), ..SpacePose::flat(DVec3::X * (tip * way), turn) };
            self.add(&format!("bow loop {side}"), &edges, DVec2::X, pose)
        })
    }

    /// Both tails, the left first, hanging under the loops with their outer side to the garment: as they come out of the knot without a
    /// twist.
    fn tails(&mut self) -> [PieceId; 2] {
        let Bow { width, tails: long, .. } = *self.bow;
        let (top, slant) = (TAIL_TOP * width / 2.0, SLANT * width);
        // The inner edge hangs straight down; the outer one flares.
        let ends = [top - width, top];
        let left = [
            (DVec2::new(ends[0], -long), "tail end"),
            (DVec2::new(ends[1], slant - long), "tail edge"),
            (DVec2::new(top, 0.0), "tail top"),
            (DVec2::new(-top, 0.0), "tail edge"),
        ];
        let right = [
            (DVec2::new(-ends[1], slant - long), "tail end"),
            (DVec2::new(-ends[0], -long), "tail edge"),
            (DVec2::new(top, 0.0), "tail top"),
            (DVec2::new(-top, 0.0), "tail edge"),
        ];
        let at = DVec3::new(self.bow.knot() + GAPS[0] + top, -width / 2.0 - GAPS[1], 0.0);
        let round = DQuat::from_rotation_y(PI);
        [("left", left, 1.0), ("right", right, -1.0)].map(|(side, edges, way)| {
            let at = DVec3::new(at.x * way, at.y, at.z);
            let pose = SpacePose::flat(at, DQuat::from_rotation_z(SPREAD * way) * round);
            self.add(&format!("bow tail {side}"), &edges, DVec2::Y, pose)
        })
    }
}

/// Sews loops and tails, the left first, to the knot.
fn sew(pattern: &mut Pattern, knot: PieceId, [loops, tails]: [[PieceId; 2]; 2]) {
    let mut seam = |own: usize, piece: PieceId, edge: usize| {
        let sides = [EdgeRef { piece: knot, edge: own }, EdgeRef { piece, edge }];
        pattern.add_seam(Seam::of_edges(sides, false));
    };
    seam(0, knot, 4);
    for (own, piece, edge) in [(2, loops[0], 5), (3, loops[0], 2), (6, loops[1], 2), (5, loops[1], 5)] {
        seam(own, piece, edge);
    }
    seam(1, tails[0], 2);
    seam(7, tails[1], 2);
}

/// The tacks of a bow at the place `at` of `host`: two, at `aside` from it to either side or nearer to it, or one. Each with its place on
/// the knot in the same measure (1: at `aside`), and its distance from `at`.
fn tacks(host: &Piece, at: DVec2, aside: DVec2) -> Result<Vec<(f64, DVec2)>, Words> {
    let lines: Vec<Vec<DVec2>> = host.loops().map(|edges| flattened_loop(edges, 1e-4)).collect();
    let is_on = |p: DVec2| {
        let all = || lines.iter().flat_map(|line| sides(line));
        is_inside(all(), p) && all().all(|[a, b]| distance_to_segment(p, a, b) >= INSET)
    };
    if !is_on(at) {
        return Err(words!(
            "a bow is tacked to a place inside a piece, {mm} mm from its edges or more",
            mm = INSET * 1000.0
        ));
    }
    let pair = |share: f64| [share, -share].map(|way| (way, aside * way));
    let found = [1.0, 0.5].into_iter().map(pair).find(|pair| pair.iter().all(|(_, by)| is_on(at + *by)));
    Ok(found.map_or_else(|| vec![(0.0, DVec2::ZERO)], Vec::from))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::sampling::sampling;
    use crate::pattern::{CutPattern, Edge};

    fn host(placement: Option<SpacePose>) -> (Pattern, PieceId) {
        let corners = [(-0.3, -0.5), (0.3, -0.5), (0.3, 0.0), (-0.3, 0.0)].map(|(x, y)| DVec2::new(x, y));
        let mut pattern = Pattern::default();
        let piece = Piece { placement, allowance: 0.01, layer: 2, ..Piece::polygon("front", &corners) };
        let piece = pattern.add_piece(piece);
        (pattern, piece)
    }

    fn standing() -> Option<SpacePose> {
        Some(SpacePose::flat(DVec3::new(0.0, 1.1, 0.2), DQuat::IDENTITY))
    }

    /// Places in space of the ends of edge `edge` of a piece.
    fn ends(pattern: &Pattern, piece: PieceId, edge: usize) -> [DVec3; 2] {
        let piece = &pattern.pieces[&piece];
        let (a, b) = piece.edge_ends(edge);
        let pose = piece.placement.expect("placed");
        [a, b].map(|p| pose.at(p))
    }

    fn check_sewn(pattern: &Pattern) {
        let (cut, mut problems) = CutPattern::new(pattern);
        let sampling = sampling(&cut, 0.02, &mut problems);
        assert_eq!(sampling.seams.len(), pattern.seams.len());
        let wrong = problems.iter().filter(|problem| !problem.words.contains("gathered"));
        assert_eq!(wrong.count(), 1, "only the garment has no seam: {problems:?}");
    }

    #[test]
    fn a_bow_is_placed_before_its_place_and_sewn_the_short_way() {
        let (mut pattern, front) = host(standing());
        let at = PiecePoint { piece: front, at: DVec2::new(0.05, -0.1) };
        let [knot, left, right, ..] = pattern.add_bow(at, &Bow::USUAL).expect("a bow");
        assert_eq!((pattern.pieces.len(), pattern.seams.len(), pattern.buttons.len()), (6, 7, 2));
        check_sewn(&pattern);
        let host = DVec3::new(0.05, 1.0, 0.2);
        for (_, piece) in pattern.pieces.iter().filter(|(id, _)| **id != front) {
            assert_eq!((piece.layer, piece.allowance), (2, 0.01));
            let pose = piece.placement.expect("placed");
            assert!(pose.is_sound() && piece.signed_area() > 0.0);
            let nearest = piece.flattened(1e-3).into_iter().map(|p| pose.at(p).z - host.z);
            assert!(nearest.fold(f64::MAX, f64::min) > 0.015, "{} is in the garment", piece.name);
        }
        assert!((ends(&pattern, left, 0)[0].x - host.x) * (ends(&pattern, right, 0)[0].x - host.x) < 0.0);
        // Each end of a seam is nearer to the one that it meets than to the other.
        for seam in pattern.seams.values().skip(1) {
            let [own, other] = seam.sides.map(|side| ends(&pattern, side.piece, side.edge));
            let met = own[0].distance(other[1]) + own[1].distance(other[0]);
            let crossed = own[0].distance(other[0]) + own[1].distance(other[1]);
            assert!(!seam.same_direction && met < crossed, "{seam:?}: {met} {crossed}");
        }
        for tack in pattern.buttons.values() {
            assert!(tack.tack && !tack.open && tack.button.piece == front && tack.hole.piece == knot);
            let pose = pattern.pieces[&knot].placement.expect("placed");
            let (on, behind) = (pose.at(tack.hole.at), host + (tack.button.at - at.at).extend(0.0));
            assert!((on.x - behind.x).abs() < 1e-9, "straight before its place");
        }
    }

    #[test]
    fn a_bow_is_placed_before_what_is_placed_in_front_of_its_place() {
        let (mut pattern, front) = host(standing());
        let ahead = SpacePose::flat(DVec3::new(0.0, 1.1, 0.3), DQuat::IDENTITY);
        let collar = [(-0.1, -0.1), (0.1, -0.1), (0.1, 0.0), (-0.1, 0.0)].map(|(x, y)| DVec2::new(x, y));
        let collar = Piece { placement: Some(ahead), layer: 2, ..Piece::polygon("collar", &collar) };
        pattern.add_piece(collar.clone());
        pattern.add_piece(Piece {
            layer: 5,
            placement: Some(SpacePose::flat(DVec3::new(0.0, 1.1, 0.35), DQuat::IDENTITY)),
            ..collar
        });
        let at = PiecePoint { piece: front, at: DVec2::new(0.0, -0.1) };
        let [_, left, ..] = pattern.add_bow(at, &Bow::USUAL).expect("a bow");
        let nearest = |pattern: &Pattern, piece: PieceId| {
            let piece = &pattern.pieces[&piece];
            let pose = piece.placement.expect("placed");
            let depths = piece.flattened(1e-3).into_iter().map(|p| pose.at(p).z);
            depths.fold(f64::MAX, f64::min)
        };
        assert!(nearest(&pattern, left) > 0.31, "{}", nearest(&pattern, left));
        // Not before what hangs farther down than its tails, nor before another layer.
        assert!(nearest(&pattern, left) < 0.4);
    }

    #[test]
    fn a_bow_faces_outwards_on_a_piece_drawn_from_its_back() {
        let turn = DQuat::from_rotation_y(PI);
        let (mut pattern, back) = host(Some(SpacePose::flat(DVec3::new(0.0, 1.1, -0.2), turn)));
        let at = PiecePoint { piece: back, at: DVec2::new(0.0, -0.1) };
        let [knot, left, ..] = pattern.add_bow(at, &Bow::USUAL).expect("a bow");
        let middle = |piece: PieceId| ends(&pattern, piece, 0)[0].midpoint(ends(&pattern, piece, 0)[1]);
        assert!(middle(knot).z < -0.2 && middle(left).z < -0.2 && middle(left).x < -0.01);
        // The same piece drawn from its other side faces forwards.
        let piece = pattern.pieces.get_mut(&back).map(Arc::make_mut).expect("the piece");
        let mut outline: Vec<Edge> = piece.outline.clone();
        outline.reverse();
        piece.outline = outline;
        let [knot, ..] = pattern.add_bow(at, &Bow::USUAL).expect("a bow");
        assert!(ends(&pattern, knot, 0)[0].z > -0.2);
    }

    #[test]
    fn near_an_edge_one_tack_does_and_beyond_it_a_bow_is_refused() {
        let (mut pattern, front) = host(None);
        let at = |x: f64| PiecePoint { piece: front, at: DVec2::new(x, -0.1) };
        pattern.add_bow(at(0.295), &Bow::USUAL).expect("a bow");
        assert_eq!(pattern.buttons.len(), 1);
        assert!(pattern.pieces.values().all(|piece| piece.placement.is_none()));
        let before = pattern.clone();
        let words = pattern.add_bow(at(0.299), &Bow::USUAL).expect_err("off the piece");
        assert!(words.contains("inside a piece"), "{words}");
        let none = PiecePoint { piece: PieceId(99), at: DVec2::ZERO };
        assert!(pattern.add_bow(none, &Bow::USUAL).is_err());
        for bow in [
            Bow { width: 0.01, ..Bow::USUAL },
            Bow { loops: f64::NAN, ..Bow::USUAL },
            Bow { loops: 0.05, ..Bow::USUAL },
            Bow { tails: 2.0, ..Bow::USUAL },
        ] {
            assert!(bow.problem().is_some() && pattern.add_bow(at(0.0), &bow).is_err(), "{bow:?}");
        }
        assert_eq!(pattern, before, "what is refused leaves no trace");
    }

    #[test]
    fn bows_of_all_sizes_can_be_sewn() {
        for (width, loops, tails) in [(0.02, 0.02, 0.03), (0.2, 0.4, 1.5), (0.035, 0.06, 0.1)] {
            let (mut pattern, front) = host(standing());
            let at = PiecePoint { piece: front, at: DVec2::new(0.0, -0.25) };
            pattern.add_bow(at, &Bow { width, loops, tails }).expect("a bow");
            check_sewn(&pattern);
        }
    }
}
