//! Contact of whole faces with the body: faces too near to it between their corners, and faces on the wrong side of the skin.
//! Results for a face stay valid until its corners have moved too far, so that few faces of resting cloth are tested again.

use glam::DVec3;
use rayon::prelude::*;

use crate::body::Surface;
use crate::cloth::refine::Refined;
use crate::cloth::{ClothState, Counters, Garment, Skip, Skips};
use crate::contact::BodyOverlaps;
use crate::contact::tracker::Lengths;
use crate::geometry::parallel::LEAST_SHARE;

/// Share of the offset that the interiors of faces and edges must keep from the skin where the vertices keep all of it. Chosen by
/// trial; it bounds how far vertices have to be raised over round skin.
pub const FACE_CLEARANCE: f64 = 0.25;
/// Distance from the skin within which faces are tested for being on the wrong side, metres on a body 1.5 m large. Chosen by trial;
/// farther off, the nearest skin says little about the side on which cloth belongs.
const WRONG_REACH: f64 = 0.02;
/// Cosine between the normals of face and skin below which the face is on the wrong side. Chosen by trial: a face that stands
/// upright on the skin, as in a fold, is not wrong yet.
const WRONG: f64 = -0.15;
/// Sample points of a face, in barycentric coordinates. The middles of its sides, of the whole and of its three outer quarters;
/// vertices are looked at by themselves.
const SAMPLES: [[f64; 3]; 7] = [
    [0.5, 0.5, 0.0],
    [0.0, 0.5, 0.5],
    [0.5, 0.0, 0.5],
    [1.0 / 3.0; 3],
    [2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0],
    [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0],
    [1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0],
];

/// Results of the last tests of a face. Values that are not positive: to be tested again.
#[derive(Clone, Copy, Debug, Default)]
struct Known {
    /// The face keeps its clearance while no corner moves farther than this, metres.
    clear: f32,
    /// The face is not on the wrong side while no corner moves farther than this, metres, and `turn` is kept as well.
    right: f32,
    /// Change of the unit normal below which the face is not on the wrong side, see `right`.
    turn: f32,
}

/// Results for all faces of a garment.
#[derive(Clone, Debug, Default)]
pub struct Faces {
    known: Vec<Known>,
    /// Positions of the vertices when the results were last updated, metres.
    seen: Vec<DVec3>,
    clearance: f64,
}

/// A garment on its body, as face tests need it.
#[derive(Clone, Copy, Debug)]
pub struct Lying<'a> {
    /// The cloth.
    pub garment: &'a Garment,
    /// The body.
    pub surface: &'a Surface,
    /// State of the cloth.
    pub state: &'a ClothState,
    /// Allowed shortcuts.
    pub skips: Skips,
    /// The garment with split edges, and its state, where edges are split.
    pub split: Option<(&'a Refined, &'a ClothState)>,
    /// Which skin each vertex ignores; None: no skin.
    pub apart: Option<&'a BodyOverlaps>,
}

impl Lying<'_> {
    fn corners(&self, t: usize) -> Option<[DVec3; 3]> {
        let vs = self.garment.triangles[t];
        let laid = vs.iter().all(|&v| self.state.mapped[v as usize]);
        laid.then(|| vs.map(|v| self.state.positions[v as usize]))
    }

    /// Whether face `t` ignores `triangle` of the body.
    fn leaves_out(&self, t: usize, triangle: u32) -> bool {
        let vs = &self.garment.triangles[t];
        self.apart.is_some_and(|apart| vs.iter().any(|&v| apart.leaves_out(v as usize, triangle)))
    }
}

impl Faces {
    /// For each face how much its worst sample point lacks to `clearance` metres above the skin, metres; 0 for none.
    /// `near` tells for each vertex whether the skin is near.
    pub fn lacking(
        &mut self,
        lying: Lying<'_>,
        near: &[bool],
        clearance: f64,
        counters: &mut Counters,
    ) -> Vec<f64> {
        if self.clearance != clearance {
            self.known.iter_mut().for_each(|known| known.clear = 0.0);
            self.clearance = clearance;
        }
        self.age(lying);
        // Depth down to which a face is found in the body; its corners are above the skin.
        let limit = clearance * 5.0;
        let ahead = Lengths::on(lying.surface).ahead;
        let mut asked = vec![0u32; self.known.len()];
        let mut lacking: Vec<f64> = self
            .known
            .par_iter_mut()
            .zip(&mut asked)
            .enumerate()
            .map(|(t, (known, asked))| {
                let Some(corners) = lying.corners(t) else { return 0.0 };
                let far = lying.garment.triangles[t].iter().all(|&v| !near[v as usize]);
                if far || known.clear > 0.0 {
                    return 0.0;
                }
                *asked = SAMPLES.len() as u32;
                let (lack, clear) = look(corners, lying, t, [clearance, limit, ahead]);
                known.clear = (clear as f32).next_down();
                lack
            })
            .collect();
        counters.face_checks += self.known.len() as u64;
        counters.face_queries += asked.iter().map(|&n| u64::from(n)).sum::<u64>();
        if let Some((refined, state)) = lying.split {
            refined.opened.iter().for_each(|&t| lacking[t as usize] = 0.0);
            for (t, &from) in (refined.first_cut..).zip(&refined.cut_from) {
                let corners = refined.garment.triangles[t].map(|v| state.positions[v as usize]);
                let (lack, _) = look(corners, lying, from as usize, [clearance, limit, ahead]);
                let all = &mut lacking[from as usize];
                *all = all.max(lack);
                counters.face_queries += SAMPLES.len() as u64;
            }
        }
        lacking
    }

    /// For each face that is on the wrong side of the skin next to it, the direction off that skin; None for the others.
    pub fn wrong(&mut self, lying: Lying<'_>, counters: &mut Counters) -> Vec<Option<DVec3>> {
        self.age(lying);
        let (reach, ahead) = (WRONG_REACH * lying.surface.scale(), Lengths::on(lying.surface).ahead);
        let mut asked = vec![0u32; self.known.len()];
        let wrong = self
            .known
            .par_iter_mut()
            .zip(&mut asked)
            .enumerate()
            .map(|(t, (known, asked))| {
                let corners = lying.corners(t)?;
                if known.right > 0.0 && known.turn > 0.0 {
                    return None;
                }
                *asked = 1;
                let centre = (corners[0] + corners[1] + corners[2]) / 3.0;
                let normal = normal(corners);
                let Some((facing, near)) = lying.surface.least_facing(centre, reach + ahead, normal) else {
                    (known.right, known.turn) = (ahead as f32, f32::INFINITY);
                    return None;
                };
                if lying.leaves_out(t, near.triangle) {
                    return None;
                }
                let distance = near.distance.abs();
                if distance > reach {
                    (known.right, known.turn) = (((distance - reach) as f32).next_down(), f32::INFINITY);
                    return None;
                }
                if facing < WRONG {
                    return Some(near.normal);
                }
                // While the centre moves by less than half of `ahead`, its nearest facet is one of these.
                *asked = 2;
                let least = lying.surface.least_facing_within(centre, distance + ahead, normal);
                known.right = ((ahead / 2.0) as f32).next_down();
                known.turn = ((least.unwrap_or(-1.0) - WRONG) as f32).next_down();
                None
            })
            .collect();
        counters.face_checks += self.known.len() as u64;
        counters.face_queries += asked.iter().map(|&n| u64::from(n)).sum::<u64>();
        wrong
    }

    /// Memory used, bytes.
    pub fn bytes(&self) -> usize {
        self.known.len() * size_of::<Known>() + self.seen.len() * size_of::<DVec3>()
    }

    /// Shortens the validity of all results by the motion of the cloth since the last update.
    fn age(&mut self, lying: Lying<'_>) {
        let (garment, positions) = (lying.garment, &lying.state.positions);
        if self.seen.len() != positions.len() || !lying.skips.allow(Skip::Faces) {
            self.known.clear();
            self.known.resize(garment.triangles.len(), Known::default());
        } else {
            let seen = &self.seen;
            self.known.par_iter_mut().enumerate().with_min_len(LEAST_SHARE).for_each(|(t, known)| {
                let Some(now) = lying.corners(t) else {
                    *known = Known::default();
                    return;
                };
                let before = garment.triangles[t].map(|v| seen[v as usize]);
                let moved = (0..3).map(|k| (now[k] - before[k]).length()).fold(0.0, f64::max);
                if moved > 0.0 {
                    let moved = (moved as f32).next_up();
                    known.clear -= moved;
                    known.right -= moved;
                    known.turn -= ((normal(now) - normal(before)).length() as f32).next_up();
                }
            });
        }
        self.seen.clone_from(positions);
    }
}

/// How much the worst sample point of face `t`, or of a part of it with these `corners`, lacks to the clearance; and how far
/// it may move before it lacks anything (at most `ahead`). Metres. Points deeper in the body than `limit` are not found.
fn look(corners: [DVec3; 3], lying: Lying<'_>, t: usize, [clearance, limit, ahead]: [f64; 3]) -> (f64, f64) {
    let (mut lack, mut clear) = (0.0f64, f64::INFINITY);
    for share in &SAMPLES {
        let p = corners[0] * share[0] + corners[1] * share[1] + corners[2] * share[2];
        match lying.surface.nearest_within_but(p, limit + ahead, |triangle| lying.leaves_out(t, triangle)) {
            Some(n) if n.distance.abs() <= limit => {
                lack = lack.max(clearance - n.distance);
                clear = clear.min(n.distance - clearance);
            }
            Some(n) => clear = clear.min(n.distance.abs() - limit),
            None => clear = clear.min(ahead),
        }
    }
    (lack, if lack > 0.0 { -1.0 } else { clear })
}

fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).normalize_or_zero()
}
