//! Where trims are on the cloth, and the shapes of buttons and hems there. Pictures show them and files hold them.

use glam::{DVec2, Vec3};

use crate::cloth::cords::{Cord, cords};
use crate::cloth::{FlatPiece, FlatPlace, Garment};
use crate::geometry::ids::PieceId;
use crate::geometry::solid::Solid;
use crate::pattern::stitches::{Row, Thread, hems, rows};
use crate::pattern::{Button, Pattern};

/// Thickness of thread, metres on a body 1.5 m tall.
pub const THREAD_THICKNESS: f32 = 0.0012;
/// Thickness of the thread of stitches, and of an unbroken thread, as shares of that.
pub const STITCH_SHARES: [f32; 2] = [0.7, 0.6];
/// Share of a stitch's length that is the gap after it.
pub const GAP: f32 = 0.35;
/// Length of a tooth of a zip and of the gap to the next, and its real width, metres.
pub const TOOTH: [f32; 3] = [0.0016, 0.0012, 0.0035];
/// Width of the tape of a zip, in widths of a tooth.
pub const TAPE_WIDTH: f32 = 2.0;
/// Colour of the tape of a zip, as a share of that of the teeth.
pub const TAPE: f32 = 0.35;
/// Width of a buttonhole, metres.
pub const SLIT: f32 = 0.0016;
/// Colours of a buttonhole and of the thread that holds a button, as shares of that of the button.
pub const AROUND_BUTTON: [f32; 2] = [0.45, 0.55];
/// Height of a button, metres, and of its middle above the cloth.
const BUTTON_HEIGHT: [f32; 2] = [0.0025, 0.0022];
/// Corners of a button.
const ROUND: usize = 20;
/// Distance of the holes of a button from its middle, in diameters, and their size.
const HOLES: f32 = 0.14;
/// By how much a buttonhole is longer than the button, metres.
const HOLE_EASE: f64 = 0.003;
/// Distance of the layer of a hem from the cloth, on its inner side, metres.
pub const HEM_LAYER: f32 = 0.0012;

/// Where the trims of a garment are on it.
#[derive(Clone, Debug, Default)]
pub struct TrimShapes {
    /// Rows of stitches, threads and teeth.
    pub rows: Vec<(Thread, Vec<FlatPlace>)>,
    /// Buttons and their holes.
    pub buttons: Vec<ButtonPlaces>,
    /// For each hem its piece, and pairs of a point of the edge and one of where it ends.
    pub hems: Vec<(PieceId, Vec<[FlatPlace; 2]>)>,
    /// Piping.
    pub cords: Vec<Cord>,
}

/// Where a button is.
#[derive(Clone, Debug)]
pub struct ButtonPlaces {
    /// How it looks.
    pub look: Button,
    /// The button's own place.
    pub button: Option<FlatPlace>,
    /// The place of its hole.
    pub hole: Option<FlatPlace>,
    /// The buttonhole: both ends and the middle between them; fewer where it leaves the cloth.
    pub slit: Vec<FlatPlace>,
}

impl ButtonPlaces {
    /// Where the button is seen: fastened it is on its hole.
    pub fn shown(&self) -> Option<&FlatPlace> {
        if self.look.open { self.button.as_ref() } else { self.hole.as_ref() }
    }
}

impl TrimShapes {
    /// The places of the trims of `pattern` on `garment`, which was cut from it.
    pub fn new(garment: &Garment, pattern: &Pattern) -> Self {
        let mut known: Option<(PieceId, FlatPiece)> = None;
        // Beside the chords of a curved edge a row may leave the mesh a little.
        let is_near = |place: &FlatPlace| place.shares.iter().all(|&share| share > -0.3);
        let mut placed = |piece: PieceId, points: &[DVec2]| -> Vec<FlatPlace> {
            if known.as_ref().is_none_or(|(id, _)| *id != piece) {
                known = Some((piece, FlatPiece::new(garment, piece)));
            }
            let flat = known.as_ref().map(|(_, flat)| flat);
            points.iter().filter_map(|&p| flat?.nearest(garment, p).filter(is_near)).collect()
        };
        let rows = rows(pattern)
            .into_iter()
            .map(|Row { piece, points, thread }| (thread, placed(piece, &points)))
            .collect();
        let buttons = pattern
            .buttons
            .values()
            .filter(|button| !button.tack)
            .map(|&look| {
                let half = DVec2::X * ((look.diameter + HOLE_EASE) / 2.0);
                let hole = look.hole;
                ButtonPlaces {
                    look,
                    button: placed(look.button.piece, &[look.button.at]).first().copied(),
                    hole: placed(hole.piece, &[hole.at]).first().copied(),
                    slit: placed(hole.piece, &[hole.at - half, hole.at, hole.at + half]),
                }
            })
            .collect();
        let hems = hems(pattern)
            .into_iter()
            .map(|(piece, pairs)| {
                let pair = |ends: [DVec2; 2]| <[FlatPlace; 2]>::try_from(placed(piece, &ends)).ok();
                (piece, pairs.into_iter().filter_map(pair).collect())
            })
            .collect();
        Self { rows, buttons, hems, cords: cords(garment, pattern) }
    }
}

/// A colour at this share of its brightness.
pub fn shade(colour: [u8; 3], share: f32) -> [u8; 3] {
    colour.map(|c| (f32::from(c) * share) as u8)
}

/// Adds a round button on the cloth at `at`, without normals; `normal` is that of the cloth, `side` a unit vector across it in
/// which the first corner is, and `scale` that of the body. Gives both threads that hold it, each from hole to hole.
pub fn push_button(
    solid: &mut Solid,
    look: &Button,
    at: Vec3,
    [normal, side]: [Vec3; 2],
    scale: f32,
) -> [[Vec3; 2]; 2] {
    let radius = look.diameter as f32 / 2.0 * scale;
    let [height, above] = BUTTON_HEIGHT.map(|h| h * scale);
    let other = normal.cross(side);
    let around = |i: usize, r: f32, up: f32| {
        let (sin, cos) = (std::f32::consts::TAU * i as f32 / ROUND as f32).sin_cos();
        at + normal * up + (side * cos + other * sin) * r
    };
    let (low, high) = (above - height / 2.0, above + height / 2.0);
    // Rings from below: the foot, the rim, its upper edge, and the dip within it.
    let rings =
        [(radius * 0.9, low), (radius, above), (radius * 0.9, high), (radius * 0.7, high - height * 0.25)];
    let first = solid.positions.len() as u32;
    for (r, up) in rings {
        solid.positions.extend((0..ROUND).map(|i| around(i, r, up)));
    }
    let top = solid.positions.len() as u32;
    solid.positions.push(at + normal * (high - height * 0.25));
    solid.colours.resize(solid.positions.len(), look.colour);
    let n = ROUND as u32;
    for ring in 0..rings.len() as u32 - 1 {
        for i in 0..n {
            let (a, b) = (first + ring * n + i, first + ring * n + (i + 1) % n);
            solid.triangles.extend([[a, b, b + n], [a, b + n, a + n]]);
        }
    }
    let last = first + (rings.len() as u32 - 1) * n;
    solid.triangles.extend((0..n).map(|i| [last + i, last + (i + 1) % n, top]));
    let reach = radius * 2.0 * HOLES;
    let hole = |x: f32, y: f32| at + normal * (high - height * 0.1) + (side * x + other * y) * reach;
    [[(-1.0, -1.0), (1.0, 1.0)], [(-1.0, 1.0), (1.0, -1.0)]].map(|ends| ends.map(|(x, y)| hole(x, y)))
}

/// The layer of a hem at one place, as [`push_hem`] takes it, from point and normal at the edge of the cloth and at the inner border.
pub fn hem_layer([edge, inner]: [[Vec3; 2]; 2], scale: f32) -> [Vec3; 3] {
    let [below, under] = [edge, inner].map(|[_, normal]| normal * (HEM_LAYER * scale));
    [edge[0], edge[0] - below, inner[0] - under]
}

/// Adds the layer of a hem, without normals: along it the edge of the cloth, the edge of the layer, and its inner border.
pub fn push_hem(solid: &mut Solid, ends: &[[Vec3; 3]], colour: [u8; 3]) {
    let first = solid.positions.len() as u32;
    solid.positions.extend(ends.iter().flatten());
    solid.colours.resize(solid.positions.len(), colour);
    for i in 0..(ends.len() as u32).saturating_sub(1) {
        for k in 0..2 {
            let (a, b) = (first + 3 * i + k, first + 3 * (i + 1) + k);
            solid.triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
        }
    }
}
