//! Transfer of marks on a body to another body.
//!
//! Marks are tied to the skin. On a body with the same triangles, which is the same body moved, they follow their triangles. To
//! any other body they are transferred by landmarks that both bodies have: a smooth map takes landmarks to landmarks, and the
//! points of a mark to near the new skin, where the nearest points are taken.

use std::sync::Arc;

use glam::DVec3;

use crate::body::Surface;
use crate::body::warp::Warp;
use crate::geometry::ids::MarkId;
use crate::geometry::words::{Words, words};
use crate::pattern::{Problem, ProblemKind};
use crate::session::body::Body;
use crate::wrap::{Marks, Tie};

/// Distance within which a point stands for a landmark, metres on a body whose largest side is 1.5 m.
const NEAR: f64 = 0.02;
/// Distance from the new skin beyond which a transferred point is lost, metres on a body whose largest side is 1.5 m.
const OFF_SKIN: f64 = 0.06;
/// Cosine of the angle between old and new skin normal below which a transferred point is lost.
const SAME_WAY: f64 = 0.2;
/// Distance within which a point still agrees with its tie, metres on a body whose largest side is 1.5 m.
const MOVED: f64 = 1e-3;
/// Share of its points that must find a place for a stroke to be transferred.
const ENOUGH: f64 = 0.75;

/// Ties those strokes on the body that are not tied yet.
pub fn tie(marks: &mut Arc<Marks>, body: &Body) {
    let untied = |marks: &Marks, id: MarkId, points: usize| {
        marks.ties.get(&id).is_none_or(|ties| ties.len() != points)
    };
    if marks.body.iter().all(|m| !untied(marks, m.id, m.points.len())) {
        return;
    }
    let marks = Arc::make_mut(marks);
    for i in 0..marks.body.len() {
        let mark = &marks.body[i];
        if untied(marks, mark.id, mark.points.len()) {
            let ties = mark.points.iter().map(|&p| tied(p, body)).collect();
            marks.ties.insert(mark.id, ties);
        }
    }
}

fn tied(p: DVec3, body: &Body) -> Tie {
    let surface = &body.surface;
    let (triangle, weights) = place(p, surface);
    let landmark = body.landmarks().and_then(|l| l.near(p, NEAR * surface.scale())).map(str::to_owned);
    Tie { triangle, weights, landmark }
}

/// The triangle of `surface` that is nearest to `p`, and the barycentric coordinates of the point there.
fn place(p: DVec3, surface: &Surface) -> (u32, DVec3) {
    let near = surface.nearest(p);
    let [a, b, c] = surface.mesh.corners(near.triangle as usize);
    let normal = (b - a).cross(c - a);
    let share =
        |u: DVec3, v: DVec3| (u - near.point).cross(v - near.point).dot(normal) / normal.length_squared();
    let weights = DVec3::new(share(b, c), share(c, a), share(a, b));
    let flat = normal.length_squared() == 0.0 || !weights.is_finite();
    (near.triangle, if flat { DVec3::splat(1.0 / 3.0) } else { weights })
}

/// `marks`, whose strokes on the body are not tied, moved with its skin; None if `to` has other triangles than `from`.
pub fn moved(marks: &Marks, from: &Surface, to: &Surface) -> Option<Marks> {
    if from.mesh.triangles != to.mesh.triangles {
        return None;
    }
    let mut marks = marks.clone();
    for p in marks.body.iter_mut().flat_map(|mark| &mut mark.points) {
        let (triangle, weights) = place(*p, from);
        *p = at(to, triangle, weights)?;
    }
    Some(marks)
}

/// `marks` transferred from the body `from` to the body `to`, called `name`, and tied to it, with a problem for each stroke that
/// was lost. Their partners on the cloth are moved behind all others, so that the other pairs stay pairs.
pub fn carried(marks: &Marks, from: Option<&Body>, to: &Body, name: &str) -> (Marks, Vec<Problem>) {
    let mut new = Marks { body: Vec::new(), ..marks.clone() };
    let mut lost = Vec::new();
    let way = from.map_or(Err(words!("the old body cannot be read")), |from| Way::new(from, to));
    for (i, mark) in marks.body.iter().enumerate() {
        let known = marks.ties.get(&mark.id).filter(|ties| ties.len() == mark.points.len());
        let points = way.as_ref().map_err(Clone::clone).and_then(|way| {
            let ties = (0..mark.points.len()).map(|k| known.map(|ties| &ties[k]));
            way.stroke(&mark.points, ties).ok_or_else(|| words!("there is no such place on its skin"))
        });
        match points {
            Ok(points) => new.body.push(crate::wrap::BodyMark { points, ..mark.clone() }),
            Err(why) => lost.push((i, problem(marks, i, name, why))),
        }
    }
    let is_lost = |i: usize| lost.iter().any(|(k, _)| *k == i);
    let cloth = marks.cloth.iter().enumerate();
    new.cloth = cloth.clone().filter(|(i, _)| !is_lost(*i)).map(|(_, m)| m.clone()).collect();
    // In front of unpaired strokes on the body they would form new pairs.
    if marks.body.len() <= marks.cloth.len() {
        new.cloth.extend(cloth.filter(|(i, _)| is_lost(*i)).map(|(_, m)| m.clone()));
    }
    new.ties.clear();
    new.prune();
    let mut new = Arc::new(new);
    tie(&mut new, to);
    (Arc::unwrap_or_clone(new), lost.into_iter().map(|(_, problem)| problem).collect())
}

fn problem(marks: &Marks, i: usize, body: &str, why: Words) -> Problem {
    let given = marks.name(marks.body[i].id);
    let number = words!("mark {n}", n = i + 1);
    let place =
        if given.is_empty() { number } else { words!("{mark} ({name})", mark = number, name = given) };
    Problem {
        kind: ProblemKind::Mark,
        place,
        words: words!("it could not be carried to {body}: {why}; paint it again", body, why),
    }
}

/// How points are transferred from one body to another.
enum Way<'a> {
    /// The two bodies have the same triangles.
    Triangles { from: &'a Body, to: &'a Body },
    /// The two bodies have landmarks in common.
    Landmarks { from: &'a Body, to: &'a Body, warp: Warp },
}

impl<'a> Way<'a> {
    fn new(from: &'a Body, to: &'a Body) -> Result<Self, Words> {
        if from.surface.mesh.triangles == to.surface.mesh.triangles {
            return Ok(Self::Triangles { from, to });
        }
        let none = || words!("the two bodies have too few landmarks in common");
        let (there, here) = from.common_landmarks(to).ok_or_else(none)?;
        let pairs: Vec<_> = there.iter().filter_map(|(name, p)| Some((p, here.get(name)?))).collect();
        Ok(Self::Landmarks { from, to, warp: Warp::new(&pairs).ok_or_else(none)? })
    }

    /// Transfers a stroke. None when too few points find a place.
    fn stroke<'t>(
        &self,
        points: &[DVec3],
        ties: impl Iterator<Item = Option<&'t Tie>>,
    ) -> Option<Vec<DVec3>> {
        let found: Vec<DVec3> = points.iter().zip(ties).filter_map(|(&p, tie)| self.point(p, tie)).collect();
        (!found.is_empty() && found.len() as f64 >= ENOUGH * points.len() as f64).then_some(found)
    }

    fn point(&self, p: DVec3, tie: Option<&Tie>) -> Option<DVec3> {
        let (Self::Triangles { from, to } | Self::Landmarks { from, to, .. }) = self;
        let held =
            tie.filter(|t| of_tie(from, t).is_some_and(|q| q.distance(p) < MOVED * from.surface.scale()));
        let tie = held.cloned().unwrap_or_else(|| tied(p, from));
        let Self::Landmarks { warp, .. } = self else { return of_tie(to, &tie) };
        let near = to.surface.nearest(warp.image(p));
        let [before, now] = [(from, tie.triangle), (to, near.triangle)]
            .map(|(body, triangle)| body.surface.face_normals[triangle as usize]);
        let is_there = near.distance.abs() <= OFF_SKIN * to.surface.scale() && before.dot(now) > SAME_WAY;
        is_there.then_some(near.point)
    }
}

/// The point that a tie stands for. None when it is of another body.
fn of_tie(body: &Body, tie: &Tie) -> Option<DVec3> {
    at(&body.surface, tie.triangle, tie.weights)
}

/// The point with these barycentric coordinates in a triangle. None where the surface has no such triangle.
fn at(surface: &Surface, triangle: u32, weights: DVec3) -> Option<DVec3> {
    let corners = surface.mesh.triangles.get(triangle as usize)?;
    Some((0..3).map(|k| surface.mesh.positions[corners[k] as usize] * weights[k]).sum())
}
