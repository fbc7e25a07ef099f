//! Ways round the body for threads that would run through it.
//!
//! Pieces are placed a few centimetres off: a strap that lies lower than the shoulder would be pulled to the chest, never over
//! the shoulder, and the garment would be sewn together under the arms. A thread whose ends the body parts runs over a place
//! beside it instead, all those of a seam on the same side, until the straight way is free.

use glam::DVec3;
use rayon::prelude::*;

use crate::body::Surface;

/// Sides that are tried for a seam.
const SIDES: u32 = 16;
/// A place is sought in steps of so much aside, metres,
const STEP: f64 = 0.01;
/// and so many at most: what lies deeper in the body is no matter of how it was placed.
const MOST_STEPS: u32 = 20;

/// For each of a seam's threads (ends in metres) the place over which it runs; None: straight, as it is free or nothing leads
/// round.
pub fn over(surface: &Surface, threads: &[[DVec3; 2]]) -> Vec<Option<DVec3>> {
    let caught: Vec<bool> = threads.par_iter().map(|&ends| surface.meets_segment(ends)).collect();
    let of_caught: Vec<[DVec3; 2]> =
        threads.iter().zip(&caught).filter(|(_, caught)| **caught).map(|(ends, _)| *ends).collect();
    let along: DVec3 = of_caught.iter().map(|[a, b]| *b - *a).sum();
    let Some(along) = along.try_normalize() else { return vec![None; threads.len()] };
    let (u, v) = along.any_orthonormal_pair();
    let side = |k: u32| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(SIDES)).sin_cos();
        u * cos + v * sin
    };
    let steps = |way: DVec3| -> u32 {
        let of_thread = |&ends: &[DVec3; 2]| steps_round(surface, ends, way).unwrap_or(2 * MOST_STEPS);
        of_caught.par_iter().map(of_thread).sum()
    };
    let Some(way) = (0..SIDES).map(side).min_by_key(|&way| steps(way)) else {
        return vec![None; threads.len()];
    };
    let place = |(&[a, b], &caught): (&[DVec3; 2], &bool)| {
        let steps = caught.then(|| steps_round(surface, [a, b], way))??;
        Some((a + b) / 2.0 + way * (STEP * f64::from(steps)))
    };
    threads.par_iter().zip(&caught).map(place).collect()
}

/// How many steps towards `way` the middle of a thread has to go until the body is free of it; then one more.
fn steps_round(surface: &Surface, [a, b]: [DVec3; 2], way: DVec3) -> Option<u32> {
    let is_free = |steps: u32| {
        let over = (a + b) / 2.0 + way * (STEP * f64::from(steps));
        !surface.meets_segment([a, over]) && !surface.meets_segment([over, b])
    };
    (1..=MOST_STEPS).find(|&steps| is_free(steps)).map(|steps| steps + 1)
}

/// Whether a thread between `ends` that runs over `place` may be drawn straight without coming through the body. That the straight
/// way is free is not enough: pieces that slid along an arm, to where both lie below it, would leave it for good.
pub fn may_be_drawn(surface: &Surface, ends: [DVec3; 2], place: DVec3) -> bool {
    let middle = (ends[0] + ends[1]) / 2.0;
    let ways = (place.distance(middle) / STEP).ceil().max(1.0) as u32;
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
