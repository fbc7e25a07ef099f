//! A creature that is not human, a seal, and a cloak that hangs on its back and is held at its throat.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};

use crate::geometry::mesh::TriMesh;
use crate::pattern::{Pattern, Piece, SpacePose, curve};
use crate::session::samples::draft::{Outline, sew};
use crate::session::samples::gallery;
use crate::session::{BodyChoice, Document};

/// Centre line and radius of the seal, from tail to nose: x, y, radius, metres.
const SEAL: [[f64; 3]; 9] = [
    [-0.80, 0.06, 0.03],
    [-0.70, 0.08, 0.06],
    [-0.50, 0.14, 0.12],
    [-0.20, 0.22, 0.20],
    [0.10, 0.30, 0.23],
    [0.35, 0.42, 0.20],
    [0.52, 0.58, 0.14],
    [0.64, 0.68, 0.12],
    [0.80, 0.72, 0.05],
];

/// Where the seam along the back begins at the neck, as placed beside the seal, metres.
const NAPE: DVec2 = DVec2::new(0.40, 0.70);
/// Direction of that seam towards the tail, radians from the direction of the nose: that of the seal's back.
const BACK: f64 = 200.7 * TAU / 360.0;
/// Angle between the back and the front edge, radians, and radius of the neckline, metres.
const FAN: f64 = 75.0 * TAU / 360.0;
const NECK: f64 = 0.38;
/// Lengths along the back and along the front edge, and of the seam that closes it at the throat, metres.
const LONG: f64 = 0.62;
const SHORT: f64 = 0.22;
const CLOSING: f64 = 0.06;
/// Distance at which both halves are placed beside the middle of the seal, metres.
const BESIDE: f64 = 0.33;

/// A seal that lies on its belly and holds its head up, nose to +x, metres.
pub fn seal() -> TriMesh {
    let (rings, sectors) = (40, 28);
    let at = |t: f64| {
        let s = t * (SEAL.len() - 1) as f64;
        let i = (s as usize).min(SEAL.len() - 2);
        let [a, b] = [SEAL[i], SEAL[i + 1]];
        let f = s - i as f64;
        let f = f * f * (3.0 - 2.0 * f) * 0.5 + f * 0.5;
        [0, 1, 2].map(|k| a[k] + (b[k] - a[k]) * f)
    };
    let mut positions = Vec::new();
    for i in 0..rings {
        let t = (f64::from(i) + 0.5) / f64::from(rings);
        let [x, y, r] = at(t);
        let [ahead, behind] = [at((t + 0.02).min(1.0)), at((t - 0.02).max(0.0))];
        let along = DVec3::new(ahead[0] - behind[0], ahead[1] - behind[1], 0.0).normalize();
        let up = DVec3::Z.cross(along);
        for k in 0..sectors {
            let turn = TAU * f64::from(k) / f64::from(sectors);
            positions.push(DVec3::new(x, y, 0.0) + (DVec3::Z * turn.cos() + up * turn.sin()) * r);
        }
    }
    let ends = [at(0.0), at(1.0)].map(|[x, y, _]| DVec3::new(x, y, 0.0));
    let [tail, nose] = [positions.len() as u32, positions.len() as u32 + 1];
    positions.extend(ends);
    let mut triangles = Vec::new();
    for k in 0..sectors as u32 {
        let next = (k + 1) % sectors as u32;
        for i in 0..rings as u32 - 1 {
            let [a, b] = [i, i + 1].map(|ring| ring * sectors as u32);
            triangles.push([a + k, b + k, b + next]);
            triangles.push([a + k, b + next, a + next]);
        }
        let last = (rings as u32 - 1) * sectors as u32;
        triangles.push([tail, k, next]);
        triangles.push([nose, last + next, last + k]);
    }
    TriMesh { positions, triangles }
}

/// The cloak beside the seal, in wool.
pub fn cloak() -> Document {
    let mut pattern = Pattern::default();
    let right = half();
    let left = Piece { outline: curve::reversed(&right.outline), ..right.clone() };
    let ids = [(right, "cloak right", BESIDE), (left, "cloak left", -BESIDE)].map(|(piece, name, z)| {
        let placement = SpacePose::flat(DVec3::Z * z, DQuat::IDENTITY);
        pattern.add_piece(Piece {
            name: name.to_owned(),
            placement: Some(placement),
            label: Some("body".to_owned()),
            ..piece
        })
    });
    for label in ["back seam", "closing"] {
        sew(&mut pattern, (ids[0], label), (ids[1], label));
    }
    let body = BodyChoice::Imported { name: "seal".to_owned(), mesh: Arc::new(seal()) };
    gallery::laid_out(pattern, body, "wool", gallery::dyed([52, 92, 84]))
}

/// The right half as seen from the seal's right: a fan round a point above its nose, shorter in front.
fn half() -> Piece {
    let middle = NAPE - DVec2::from_angle(BACK) * NECK;
    let front = BACK + FAN;
    let at = |radius: f64, angle: f64| middle + DVec2::from_angle(angle) * radius;
    // Handles of the cubic nearest to an arc of this angle.
    let handle = 4.0 / 3.0 * (FAN / 4.0).tan();
    let on = |radius: f64, angle: f64| DVec2::from_angle(angle).perp() * (handle * radius);
    let [hem, throat] = [NECK + LONG, NECK + SHORT];
    let tail = at(hem, BACK);
    Outline::from(tail)
        .curve("hem", tail + on(hem, BACK), at(throat, front) - on(throat, front), at(throat, front))
        .line("front edge", at(NECK + CLOSING, front))
        .line("closing", at(NECK, front))
        .curve("neck", at(NECK, front) - on(NECK, front), NAPE + on(NECK, BACK), NAPE)
        .line("back seam", tail)
        .piece("cloak")
}
