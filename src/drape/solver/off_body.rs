//! Collision of cloth with a body in small steps: every vertex is kept off the half-space by which the skin near it is approximated, with
//! Coulomb friction, and off the other side of a crease of the skin; and off the floor.

use glam::DVec3;

use crate::drape::contact::body::Collider;
use crate::drape::solver::shares::{Plane, Share};
use crate::drape::solver::surroundings::{EASE, Surroundings};

/// Cosine of the angle between the normals of two successive nearest points below which they form a crease: cloth is then kept off
/// both sides. That of 60°: so much the nearest skin turns at once only between two parts of a body, as in an armpit.
const CREASE: f64 = 0.5;
/// Distance from where the first side of a crease was seen within which cloth is still kept off it, in offsets. Chosen by trial; it
/// bounds how far along the skin the other side of a crease is remembered.
const CREASE_REACH: f64 = 4.0;
/// Largest speed at which cloth is pushed off the side of a crease that is not nearest, m/s. Chosen by trial.
const CREASE_SPEED: f64 = 1.5;

/// A small step against a body.
pub(super) struct Colliding<'a> {
    pub around: &'a Surroundings<'a>,
    pub collider: &'a Collider,
    /// Share of the body's motion that is still to come after this small step.
    pub left: f64,
    /// Share of the body's motion in this small step.
    pub part: f64,
    pub small: f64,
}

/// Read-only data of the vertices that collisions with the body need.
pub(super) struct Knowing<'a> {
    pub inverse_mass: &'a [f64],
    pub lift: &'a [f64],
    pub spread: &'a [f64],
    pub pulled: &'a [f64],
    pub eases: bool,
}

impl Knowing<'_> {
    /// Projects the vertices of `share` off the floor and the body, with friction. Where a body presses cloth into the floor, it is kept
    /// off the body. Returns the numbers of nearest-point queries made and saved.
    pub fn collide(&self, scene: &Colliding<'_>, share: &mut Share<'_>) -> (u64, u64) {
        let Colliding { around, collider, left, part, small } = *scene;
        let floor = around.floor.map(|floor| floor + around.offset);
        let (mut queries, mut skipped) = (0, 0);
        for (k, x) in share.x.iter_mut().enumerate() {
            let i = share.first + k;
            if self.inverse_mass[i] == 0.0 {
                continue;
            }
            let (plane, before) = (&mut share.planes[k], &mut share.before[k]);
            if let Some(height) = floor.filter(|height| x.y < *height) {
                self.keep_off(scene, i, (x, before), (DVec3::Y, height), |_| DVec3::ZERO);
            }
            if x.distance_squared(plane.place) > plane.good_for * plane.good_for {
                queries += 1;
                let seen = *plane;
                *plane = look(collider, *x, *before, around.offset + self.lift[i], left);
                let both = seen.normal != DVec3::ZERO && plane.normal != DVec3::ZERO;
                if both && seen.normal.dot(plane.normal) < CREASE {
                    share.creases.retain(|(known, _)| *known != i);
                    share.creases.push((i, seen));
                }
            } else if plane.normal == DVec3::ZERO {
                skipped += 1;
                continue;
            }
            let carried = |at: DVec3| collider.carried_near(at) * part;
            self.keep_off(scene, i, (x, before), (plane.normal, plane.height), carried);
        }
        let reach = CREASE_REACH * around.offset;
        share
            .creases
            .retain(|(i, plane)| share.x[i - share.first].distance_squared(plane.place) < reach * reach);
        for (i, plane) in share.creases.iter() {
            let k = i - share.first;
            let depth = plane.height - plane.normal.dot(share.x[k]);
            // The projection adds no velocity: between the two sides of a crease the cloth would tremble.
            let way = plane.normal * depth.clamp(0.0, CREASE_SPEED * small);
            share.x[k] += way;
            share.before[k] += way;
        }
        (queries, skipped)
    }

    /// Projects vertex `i`, at `x` and `before` the small step at `before`, off the half-space n·x ≥ height, with friction. `carried` gives
    /// how far what is behind it moves in the small step near a point, metres.
    fn keep_off(
        &self,
        scene: &Colliding<'_>,
        i: usize,
        (x, before): (&mut DVec3, &mut DVec3),
        (normal, height): (DVec3, f64),
        carried: impl FnOnce(DVec3) -> DVec3,
    ) {
        let Colliding { around, small, .. } = *scene;
        let mut depth = height - normal.dot(*x);
        if self.eases {
            let old = height - normal.dot(*before);
            if old > 0.0 {
                let eased = old.min(EASE * small);
                depth -= old - eased;
                *before += normal * eased;
            }
        }
        if depth <= 0.0 {
            return;
        }
        *x += normal * depth;
        let slip = *x - *before - carried(*before);
        let slip = slip - normal * slip.dot(normal);
        let length = slip.length();
        // Pressure of elastic is known, and not limited.
        let pulled = self.pulled.get(i).copied().unwrap_or(0.0);
        let hold = around.friction[i] * depth.min(around.grip * self.spread[i] * small * small + pulled);
        *x -= if length <= hold { slip } else { slip * (hold / length) };
    }
}

/// Half-space of the body near `x`; `left` is the share of the body's motion that is still to come.
fn look(collider: &Collider, x: DVec3, before: DVec3, offset: f64, left: f64) -> Plane {
    let back = collider.carried_near(x) * left;
    let near = collider.surface.nearest(x + back);
    let clear = near.distance - offset - collider.farthest() * left;
    if clear > offset {
        return Plane { normal: DVec3::ZERO, height: 0.0, place: x, good_for: clear };
    }
    let mut normal = near.normal;
    let mut point = near.point - back;
    let way = x - before;
    if way.length() > near.distance.abs()
        && let Some(hit) = collider.surface.ray(before + back, way)
        && hit.distance < way.length()
        && hit.normal.dot(way) < 0.0
    {
        (normal, point) = (hit.normal, hit.point - back);
    }
    // Two offsets: over a sphere of radius R the tangent plane is then off by (2 offset)²/2R, twice the offset squared over R.
    let good_for = if collider.farthest() > 0.0 { 0.0 } else { 2.0 * offset.max(1e-4) };
    Plane { normal, height: normal.dot(point) + offset, place: x, good_for }
}
