//! Sleeves led to the arms of the body before they are sewn.

use std::sync::Arc;

use glam::DVec3;
use toile::body::pose::rig;
use toile::body::{NamedPose, Surface, bones, landmarks, mannequin};
use toile::cloth::{Garment, build};
use toile::draft::{Design, Form, Kind, SIZES};
use toile::place::{Limb, Part, led, limbs};

/// A design of the corpus for the largest size in `pose`: its cloth, where its flat corners stand, and that body.
fn drafted(kind: Kind, number: u32, pose: NamedPose) -> (Garment, Vec<Option<DVec3>>, Arc<Surface>) {
    let measurements = SIZES[SIZES.len() - 1].measurements();
    let form = Form::new(&measurements, pose).expect("a form");
    let figure = mannequin::mannequin(&measurements).expect("a body");
    let posed = rig(&measurements).expect("a rig").posed(&pose.pose(&figure.skeleton)).expect("a pose");
    let pattern = Design::drawn(7, number, &[kind]).drafted(&form);
    let (garment, _) = build(&pattern, 0.04);
    let place = |corner: &toile::cloth::Corner| Some(pattern.pieces[&corner.piece].placement?.at(corner.uv));
    let places = garment.corners.iter().map(place).collect();
    (garment, places, posed.surface)
}

/// The arms of `surface`.
fn arms(surface: &Surface) -> Vec<Limb> {
    let marks = landmarks::found(&surface.mesh).expect("a human");
    let (lower, upper) = surface.bounds();
    let all = limbs(&bones::extracted(surface, &marks), upper.y - lower.y);
    all.into_iter().filter(|limb| matches!(limb.part, Part::Arm { .. })).collect()
}

/// How far the middles of the outermost openings at both sides are from the line of the arm there, seen from the front, metres.
fn beside_the_arms(garment: &Garment, places: &[Option<DVec3>], surface: &Surface) -> [f64; 2] {
    let open = |e: &&[u32; 2]| {
        let count = garment.triangles.iter().filter(|t| e.iter().all(|v| t.contains(v))).count();
        count == 1
    };
    let border: Vec<[u32; 2]> = garment.adjacency.edges.iter().filter(open).copied().collect();
    let arms = arms(surface);
    assert_eq!(arms.len(), 2);
    let mut apart = [0.0; 2];
    for (apart, arm) in apart.iter_mut().zip(&arms) {
        let side = arm.along().x.signum();
        let out = |v: u32| {
            let own = garment.corners.iter().zip(places).filter(|(corner, _)| corner.vertex == v);
            own.map(|(_, place)| place.expect("placed")).collect::<Vec<_>>()
        };
        // From the outermost place on along the border.
        let far = |v: u32| out(v).iter().map(|p| p.x * side).fold(f64::MIN, f64::max);
        let first = border.iter().flatten().copied().max_by(|&a, &b| far(a).total_cmp(&far(b)));
        let mut cuff = vec![first.expect("an opening")];
        let mut k = 0;
        while let Some(&v) = cuff.get(k) {
            for w in border.iter().filter(|e| e.contains(&v)).flatten() {
                if !cuff.contains(w) {
                    cuff.push(*w);
                }
            }
            k += 1;
        }
        let points: Vec<DVec3> = cuff.iter().flat_map(|&v| out(v)).collect();
        let flat = |v: DVec3| DVec3::new(v.x, v.y, 0.0);
        let middle = flat(points.iter().sum::<DVec3>() / points.len() as f64 - arm.bone[0]);
        let along = flat(arm.along()).normalize();
        *apart = (middle - along * middle.dot(along)).length();
    }
    apart
}

#[test]
fn sleeves_above_hanging_arms_are_led_to_them() {
    let mut led_to = 0;
    for number in 0..8 {
        let (garment, places, surface) = drafted(Kind::Dolman, number, NamedPose::A);
        let moved = led(&garment, &surface, &places);
        if moved == places {
            continue;
        }
        led_to += 1;
        let before = beside_the_arms(&garment, &places, &surface);
        let after = beside_the_arms(&garment, &moved, &surface);
        for (before, after) in before.iter().zip(after) {
            assert!(*before > 0.03 && after < 0.01, "design {number}: {before:.3} m beside, then {after:.3}");
        }
        let far = |(a, b): (&Option<DVec3>, &Option<DVec3>)| a.expect("placed").distance(b.expect("placed"));
        let middle = places.iter().zip(&moved).filter(|(place, _)| place.is_some_and(|p| p.x.abs() < 0.03));
        let farthest = middle.map(far).fold(0.0, f64::max);
        let led_by = before[0].max(before[1]);
        assert!(
            farthest < 0.5 * led_by,
            "design {number}: {farthest:.3} m in its middle, {led_by:.3} m at cuffs"
        );
    }
    assert!(led_to >= 3, "{led_to} of 8 designs have sleeves above the arms");
}

#[test]
fn what_the_arms_run_through_and_what_has_no_sleeves_stays_to_the_last_bit() {
    for kind in [Kind::Shirt, Kind::Trousers, Kind::CircleSkirt] {
        let (garment, places, surface) = drafted(kind, 1, NamedPose::T);
        assert!(led(&garment, &surface, &places) == places, "{kind:?}");
    }
}

/// Shorts end beside the arms where these hang down.
#[test]
fn legs_of_shorts_are_not_led_to_the_arms() {
    for number in 0..4 {
        let (garment, places, surface) = drafted(Kind::Shorts, number, NamedPose::A);
        assert!(led(&garment, &surface, &places) == places, "design {number}");
    }
}
