//! Routes of sewing springs round the body.
//!
//! Pieces are placed a few centimetres off the body: a strap placed lower than the shoulder would be pulled to the chest, never
//! over the shoulder, and the garment would be sewn together under the arms. So a spring whose straight line meets the body is
//! led over a waypoint beside it, all springs of a seam on the same side, until the straight line is free. A spring that was free
//! remembers on which side of a limb it was, and stays there when its ends slide past the limb.

use glam::DVec3;
use rayon::prelude::*;

use crate::body::Surface;
use crate::drape::garment::SEARCH_STEP;

/// Most steps of [`SEARCH_STEP`]: a line that is deeper in the body than this was not caught by the placement.
const MOST_STEPS: u32 = 20;
/// Deepest point of a line inside the body, as a share of the length inside, up to which the body only bulges into it. Through
/// the middle of a circle it is half the diameter. A deeper line runs through a limb.
const BULGE: f64 = 0.15;

/// Route of a sewing spring between its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Route {
    /// Waypoint while the body is between the ends, metres; None: straight.
    pub over: Option<DVec3>,
    /// Midpoint of the ends when the body was last not between them, metres.
    free: Option<DVec3>,
    /// Unit direction towards the side on which the spring was; the waypoint then moves along with the ends.
    back: Option<DVec3>,
}

impl Route {
    /// A route over the waypoint `over`, or straight.
    pub fn new(over: Option<DVec3>) -> Self {
        Self { over, free: None, back: None }
    }

    /// Updates the route for new positions of its ends, metres. It becomes straight where it can be tightened without passing
    /// through the body. Where the body has come between the ends, as they slid along a limb, the spring stays on the side on
    /// which it was.
    pub fn go_on(&mut self, surface: &Surface, ends: [DVec3; 2]) {
        let middle = middle(ends);
        if self.over.is_some_and(|over| may_be_drawn(surface, ends, over)) {
            (self.over, self.back) = (None, None);
        } else if self.over.is_some() && self.back.is_none() {
            return;
        }
        if self.over.is_none() {
            self.back = self
                .free
                .filter(|&free| has_passed(surface, ends, free))
                .and_then(|free| (free - middle).try_normalize());
        }
        if let Some(back) = self.back {
            let before = self.over.or(self.free);
            let there = steps_round(surface, ends, back).map(|steps| aside(ends, back, steps));
            let is_that_side =
                |there: &DVec3| !before.is_some_and(|before| surface.meets_segment([before, *there]));
            self.over = there.filter(is_that_side).or(before);
        } else if !surface.meets_segment(ends) {
            self.free = Some(middle);
        }
    }
}

/// Waypoint for each spring of a seam (ends in metres). None: straight, because the line is free on the side on which the others
/// of the seam go round the body, or because no route was found.
pub fn over(surface: &Surface, threads: &[[DVec3; 2]]) -> Vec<Option<DVec3>> {
    let caught: Vec<bool> = threads.par_iter().map(|&ends| surface.meets_segment(ends)).collect();
    let of_caught: Vec<[DVec3; 2]> =
        threads.iter().zip(&caught).filter(|(_, caught)| **caught).map(|(ends, _)| *ends).collect();
    let along: DVec3 = of_caught.iter().map(|[a, b]| *b - *a).sum();
    let Some(along) = along.try_normalize() else { return vec![None; threads.len()] };
    let (u, v) = along.any_orthonormal_pair();
    // Directions round the seam that are tried for the waypoints.
    let sides = 16;
    let side = |k: u32| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(sides)).sin_cos();
        u * cos + v * sin
    };
    let steps = |way: DVec3| -> u32 {
        let of_thread = |(&ends, &caught)| steps_to(surface, ends, caught, way).unwrap_or(2 * MOST_STEPS);
        threads.par_iter().zip(&caught).map(of_thread).sum()
    };
    let Some(way) = (0..sides).map(side).min_by_key(|&way| steps(way)) else {
        return vec![None; threads.len()];
    };
    let place = |(&ends, &caught): (&[DVec3; 2], &bool)| {
        let steps = steps_to(surface, ends, caught, way).filter(|&steps| steps > 0)?;
        Some(aside(ends, way, steps))
    };
    threads.par_iter().zip(&caught).map(place).collect()
}

/// Whether a spring between `ends`, whose midpoint was at `free`, has since moved to the other side of a limb or runs through
/// one.
fn has_passed(surface: &Surface, ends: [DVec3; 2], free: DVec3) -> bool {
    let middle = middle(ends);
    match surface.meets_segment(ends) {
        true => runs_through_a_limb(surface, ends),
        false => runs_through_a_limb(surface, [free, middle]) && !may_be_drawn(surface, ends, free),
    }
}

/// Whether the part of the line from `a` to `b` inside the body is deep. A trunk only bulges into the line, which comes free as
/// its ends approach.
fn runs_through_a_limb(surface: &Surface, [a, b]: [DVec3; 2]) -> bool {
    let way = (b - a).normalize_or_zero();
    let hits = [surface.ray(a, way), surface.ray(b, -way)];
    let [Some(first), Some(last)] = hits else { return false };
    let inside = a.distance(b) - first.distance - last.distance;
    let middle = a + way * (first.distance + inside / 2.0);
    inside > 0.0 && -surface.nearest(middle).distance > BULGE * inside
}

/// Steps towards `way` by which the midpoint of a spring must move to be on that side of the body; 0 where it is there already,
/// None where [`MOST_STEPS`] are not enough.
fn steps_to(surface: &Surface, ends: [DVec3; 2], caught: bool, way: DVec3) -> Option<u32> {
    if caught {
        return steps_round(surface, ends, way);
    }
    let is_free = |steps: u32| is_free_over(surface, ends, aside(ends, way, steps));
    let beyond = surface
        .meets_segment([middle(ends), aside(ends, way, MOST_STEPS)])
        .then(|| (1..=MOST_STEPS).find(|&steps| !is_free(steps)));
    let Some(Some(meets)) = beyond else { return Some(0) };
    (meets..=MOST_STEPS).find(|&steps| is_free(steps)).map(|steps| steps + 1)
}

/// Steps towards `way` by which the midpoint of a spring must move until the line over it is free of the body, plus one; None
/// where [`MOST_STEPS`] are not enough.
fn steps_round(surface: &Surface, ends: [DVec3; 2], way: DVec3) -> Option<u32> {
    let is_free = |&steps: &u32| is_free_over(surface, ends, aside(ends, way, steps));
    (1..=MOST_STEPS).find(is_free).map(|steps| steps + 1)
}

fn middle([a, b]: [DVec3; 2]) -> DVec3 {
    (a + b) / 2.0
}

/// The midpoint of a spring, moved `steps` steps towards `way`.
fn aside(ends: [DVec3; 2], way: DVec3, steps: u32) -> DVec3 {
    middle(ends) + way * (SEARCH_STEP * f64::from(steps))
}

fn is_free_over(surface: &Surface, [a, b]: [DVec3; 2], over: DVec3) -> bool {
    !surface.meets_segment([a, over]) && !surface.meets_segment([over, b])
}

/// Whether a spring between `ends` that runs over `place` can be tightened to a straight line without passing through the body. A
/// free straight line is not enough: pieces that slid along an arm until both are below it would leave it for good.
fn may_be_drawn(surface: &Surface, ends: [DVec3; 2], place: DVec3) -> bool {
    let middle = middle(ends);
    let ways = (place.distance(middle) / SEARCH_STEP).ceil().max(1.0) as u32;
    (0..ways).all(|k| {
        let place = middle.lerp(place, f64::from(k) / f64::from(ways));
        ends.iter().all(|&end| !surface.meets_segment([end, place]))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::mesh::TriMesh;
    use crate::geometry::shapes::cylinder;

    /// A bar 0.1 m thick along x, about the origin, as a shoulder is.
    fn bar() -> Surface {
        let TriMesh { positions, triangles } = cylinder(0.05, 0.6, 48, 24);
        let positions = positions.iter().map(|p| DVec3::new(p.y - 0.3, p.x, -p.z)).collect();
        let mesh = Surface::new(TriMesh { positions, triangles }).expect("a body");
        assert!(mesh.contains(DVec3::ZERO), "wrong side out");
        mesh
    }

    /// Threads from before the bar to behind it, at these heights.
    fn across(heights: &[f64]) -> Vec<[DVec3; 2]> {
        heights.iter().map(|&y| [DVec3::new(0.02, y, 0.25), DVec3::new(0.02, y, -0.2)]).collect()
    }

    #[test]
    fn what_the_body_is_not_in_the_way_of_runs_straight() {
        assert_eq!(over(&bar(), &across(&[0.06, 0.2, -0.06])), [None; 3]);
        assert!(over(&bar(), &[]).is_empty());
    }

    #[test]
    fn a_strap_a_little_too_low_runs_over_the_shoulder_and_is_free_there() {
        let (bar, threads) = (bar(), across(&[0.06, 0.04, 0.02, 0.01]));
        let places = over(&bar, &threads);
        assert_eq!(places[0], None);
        for ([a, b], place) in threads.iter().zip(&places).skip(1) {
            let place = place.expect("a way over");
            assert!(place.y > 0.05 && place.y < 0.12, "{place}");
            assert!(!bar.meets_segment([*a, place]) && !bar.meets_segment([place, *b]));
        }
        let below = over(&bar, &across(&[-0.03, -0.02]));
        assert!(below.iter().all(|place| place.is_some_and(|p| p.y < -0.05)), "{below:?}");
    }

    /// The lowest alone would go below: it goes where the seam goes.
    #[test]
    fn threads_of_a_seam_run_on_one_side() {
        let places = over(&bar(), &across(&[0.045, 0.04, 0.03, 0.02, -0.005]));
        assert!(places.iter().all(|place| place.is_some_and(|p| p.y > 0.05)), "{places:?}");
    }

    #[test]
    fn a_thread_is_drawn_straight_only_on_the_side_of_the_body_on_which_it_runs() {
        let (bar, over) = (bar(), DVec3::new(0.02, 0.08, 0.0));
        let [above, in_the_way, below] = [0.06, 0.02, -0.06].map(|y| across(&[y])[0]);
        assert!(may_be_drawn(&bar, above, over) && !may_be_drawn(&bar, in_the_way, over));
        assert!(!bar.meets_segment(below) && !may_be_drawn(&bar, below, over));
    }

    /// Of a seam that begins below an arm and ends above it, as at the side of a wide bodice.
    #[test]
    fn threads_of_a_seam_that_are_free_on_the_other_side_go_round_too() {
        let bar = bar();
        let threads = across(&[-0.12, -0.1, -0.08, -0.06, -0.04, -0.01, 0.03, 0.06]);
        let places = over(&bar, &threads);
        assert!(places[..4].iter().all(Option::is_none), "free where they should be: {places:?}");
        assert!(places[4..].iter().all(|place| place.is_some_and(|p| p.y < -0.05)), "{places:?}");
    }

    /// Pulled up along both sides of an arm, the seam under it is not sewn together above it.
    #[test]
    fn a_thread_whose_ends_slide_past_the_body_stays_on_its_side() {
        let bar = bar();
        let mut route = Route::new(None);
        for height in [-0.08, -0.06, -0.045] {
            route.go_on(&bar, across(&[height])[0]);
            assert_eq!(route.over, None, "the skin may bulge a little into it");
        }
        let mut leaping = route;
        for height in [-0.02, 0.02, 0.06, 0.08] {
            route.go_on(&bar, across(&[height])[0]);
        }
        leaping.go_on(&bar, across(&[0.08])[0]);
        for mut route in [route, leaping] {
            assert!(route.over.is_some_and(|over| over.y < -0.05), "{route:?}");
            route.go_on(&bar, across(&[-0.07])[0]);
            assert_eq!(route.over, None, "free below, where it was");
        }
    }

    #[test]
    fn what_lies_deeper_than_pieces_are_misplaced_stays_straight() {
        let wall = TriMesh {
            positions: cylinder(0.6, 1.2, 48, 24).positions.iter().map(|p| *p - DVec3::Y * 0.6).collect(),
            triangles: cylinder(0.6, 1.2, 48, 24).triangles,
        };
        let ends = [DVec3::new(0.0, 0.0, 0.7), DVec3::new(0.0, 0.0, -0.7)];
        assert_eq!(over(&Surface::new(wall).expect("a body"), &[ends]), [None]);
    }
}
