//! Draws what is worked on the cloth: fold lines, topstitching, hems, elastic, piping, zips and buttons. No egui here: pictures
//! without a window use it too.

use std::sync::Arc;

use glam::{DVec2, Vec3};

use crate::cloth::{ClothState, FlatPiece, FlatPlace, Garment};
use crate::geometry::ids::PieceId;
use crate::geometry::mesh::vertex_normals;
use crate::pattern::stitches::{Row, Thread, hems, rows};
use crate::pattern::{Button, Pattern};
use crate::render::{CLOTH_BACK, Mesh, Polyline, Rgb};
use crate::ui::scenery::cords::{Cord, Lined, cords, is_piped};
use crate::ui::scenery::fabric_looks::PieceLooks;
use crate::ui::scenery::stitches::{THREAD_THICKNESS, dashes};

/// Colour of a crease, sRGB and opacity.
const CREASE: [u8; 4] = [40, 44, 48, 110];
/// Share of a stitch's length that is the gap after it.
const GAP: f32 = 0.35;
/// Length of a tooth of a zip and of the gap to the next, and its real width, metres.
const TOOTH: [f32; 3] = [0.0016, 0.0012, 0.0035];
/// Colour of the tape of a zip, as a share of that of the teeth.
const TAPE: f32 = 0.35;
/// Height of a button, metres, and of its middle above the cloth.
const BUTTON_HEIGHT: [f32; 2] = [0.0025, 0.0022];
/// Corners of a button.
const ROUND: usize = 20;
/// Distance of the holes of a button from its middle, in diameters, and their size.
const HOLES: f32 = 0.14;
/// By how much a buttonhole is longer than the button, metres.
const HOLE_EASE: f64 = 0.003;
/// Distance of the layer of a hem from the cloth, on its inner side, metres.
const HEM_LAYER: f32 = 0.0012;
/// Depth bias of a row, metres.
const LIFT: f32 = 0.0026;

/// Draws the trims of a garment; keeps where they are on it until garment or pattern change.
#[derive(Debug, Default)]
pub struct TrimScenery {
    places: Option<Places>,
}

#[derive(Debug)]
struct Places {
    garment: Arc<Garment>,
    pattern: Arc<Pattern>,
    rows: Vec<(Thread, Vec<FlatPlace>)>,
    buttons: Vec<ButtonPlaces>,
    /// For each hem its piece, and pairs of a point of the edge and one of where it ends.
    hems: Vec<(PieceId, Vec<[FlatPlace; 2]>)>,
    cords: Vec<Cord>,
}

#[derive(Debug)]
struct ButtonPlaces {
    look: Button,
    /// The button's own place, that of its hole, and the ends of the buttonhole.
    button: Option<FlatPlace>,
    hole: Option<FlatPlace>,
    slit: Vec<FlatPlace>,
}

impl TrimScenery {
    /// Lines and meshes of the trims of `pattern` on the cloth of `garment`; `is_seen` tells which vertices are not covered.
    pub fn drawn(
        &mut self,
        pattern: &Arc<Pattern>,
        (garment, state): (&Arc<Garment>, &ClothState),
        (is_seen, looks): (&dyn Fn(u32) -> bool, Option<&PieceLooks>),
        scale: f32,
    ) -> (Vec<Polyline>, Vec<Mesh>) {
        let is_known = self
            .places
            .as_ref()
            .is_some_and(|p| Arc::ptr_eq(&p.garment, garment) && Arc::ptr_eq(&p.pattern, pattern));
        if !is_known {
            self.places = Some(Places::new(garment, pattern));
        }
        let Some(places) = &self.places else { return (Vec::new(), Vec::new()) };
        let seen = |place: &FlatPlace| {
            let vertices = place.vertices(garment);
            let is_seen = vertices.iter().all(|&(v, _)| is_seen(v));
            place.point(garment, state).map(|p| p.as_vec3()).filter(|_| is_seen)
        };
        let mut lines = Vec::new();
        for (thread, row) in &places.rows {
            let points: Vec<Option<Vec3>> = row.iter().map(seen).collect();
            for run in points.split(Option::is_none).filter(|run| run.len() > 1) {
                let run: Vec<Vec3> = run.iter().flatten().copied().collect();
                lines.extend(threads(&run, *thread, scale));
            }
        }
        let is_flat = places.buttons.is_empty() && places.hems.is_empty();
        let normals = if is_flat { Vec::new() } else { normals(garment, state) };
        let normal_at = |place: &FlatPlace| {
            let vertices = place.vertices(garment);
            vertices.iter().map(|&(v, s)| normals[v as usize] * s as f32).sum::<Vec3>().normalize_or(Vec3::Z)
        };
        let mut mesh = Mesh { front: [255; 3], back: [255; 3], ..Mesh::default() };
        for button in &places.buttons {
            let slit: Vec<Vec3> = button.slit.iter().filter_map(seen).collect();
            if slit.len() == button.slit.len() {
                lines.push(Polyline { points: slit, ..line(dark(button.look.colour), 2.2, 0.0016, scale) });
            }
            let at = if button.look.open { &button.button } else { &button.hole };
            let Some((place, at)) = at.as_ref().and_then(|place| Some((place, seen(place)?))) else {
                continue;
            };
            let normal =
                place.vertices(garment).iter().map(|&(v, s)| normals[v as usize] * s as f32).sum::<Vec3>();
            let normal = normal.normalize_or(Vec3::Z);
            lines.extend(push_button(&mut mesh, &button.look, at, normal, scale));
        }
        for (piece, pairs) in &places.hems {
            let own = looks.and_then(|looks| looks.get(piece)?.colours);
            let inside = own.map_or(CLOTH_BACK, |[_, inside]| inside);
            let ends: Vec<Option<[Vec3; 3]>> = pairs
                .iter()
                .map(|[edge, inner]| {
                    let point = |place: &FlatPlace| place.point(garment, state).map(|p| p.as_vec3());
                    let (edge_at, inner_at) = (point(edge)?, point(inner)?);
                    let [below, under] = [edge, inner].map(|place| normal_at(place) * (HEM_LAYER * scale));
                    Some([edge_at, edge_at - below, inner_at - under])
                })
                .collect();
            for run in ends.split(Option::is_none) {
                push_hem(&mut mesh, &run.iter().flatten().copied().collect::<Vec<_>>(), inside);
            }
        }
        let mut meshes = vec![mesh, tubes(&places.cords, state, is_seen, scale)];
        meshes.retain(|mesh| !mesh.triangles.is_empty());
        (lines, meshes)
    }
}

impl Places {
    fn new(garment: &Arc<Garment>, pattern: &Arc<Pattern>) -> Self {
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
        let cords = cords(garment, pattern);
        Self { garment: Arc::clone(garment), pattern: Arc::clone(pattern), rows, buttons, hems, cords }
    }
}

/// The tubes of `cords`, in cloth.
fn tubes(cords: &[Cord], state: &ClothState, is_seen: &dyn Fn(u32) -> bool, scale: f32) -> Mesh {
    let mut mesh = Mesh { front: [255; 3], back: [255; 3], cloth: 1.0, ..Mesh::default() };
    let place = |v: u32| {
        let is_shown = state.mapped[v as usize] && is_seen(v);
        is_shown.then(|| state.positions[v as usize].as_vec3())
    };
    cords.iter().for_each(|cord| cord.push(&mut mesh, place, scale));
    mesh
}

/// The lines of one row of stitches.
fn threads(points: &[Vec3], thread: Thread, scale: f32) -> Vec<Polyline> {
    match thread {
        Thread::Stitches { length, colour } => {
            let length = length as f32 * scale;
            let (stitch, gap) = (length * (1.0 - GAP), length * GAP);
            let look = line(opaque(colour), 1.7, THREAD_THICKNESS * 0.7, scale);
            dashes(points, stitch, gap)
                .into_iter()
                .map(|points| Polyline { points, ..look.clone() })
                .collect()
        }
        Thread::Line { colour } => {
            vec![Polyline {
                points: points.to_vec(),
                ..line(opaque(colour), 1.4, THREAD_THICKNESS * 0.6, scale)
            }]
        }
        Thread::Teeth { colour } => {
            let [tooth, gap, width] = TOOTH;
            let tape =
                Polyline { points: points.to_vec(), ..line(shade(colour, TAPE), 9.0, width * 2.0, scale) };
            let look = Polyline { lift: LIFT * 1.3 * scale, ..line(opaque(colour), 6.0, width, scale) };
            let teeth = dashes(points, tooth * scale, gap * scale).into_iter();
            std::iter::once(tape).chain(teeth.map(|points| Polyline { points, ..look.clone() })).collect()
        }
    }
}

fn line(colour: [u8; 4], width: f32, thickness: f32, scale: f32) -> Polyline {
    Polyline {
        colour,
        width,
        lift: LIFT * scale,
        lift_widths: 1.0,
        thickness: thickness * scale,
        ..Polyline::default()
    }
}

fn opaque(colour: Rgb) -> [u8; 4] {
    [colour[0], colour[1], colour[2], 245]
}

/// A colour at this share of its brightness.
fn shade(colour: Rgb, share: f32) -> [u8; 4] {
    opaque(colour.map(|c| (f32::from(c) * share) as u8))
}

fn dark(colour: Rgb) -> [u8; 4] {
    shade(colour, 0.45)
}

fn normals(garment: &Garment, state: &ClothState) -> Vec<Vec3> {
    let is_laid = |t: &[u32; 3]| t.iter().all(|&v| state.mapped[v as usize]);
    let triangles: Vec<[u32; 3]> = garment.triangles.iter().copied().filter(is_laid).collect();
    vertex_normals(&state.positions, &triangles).iter().map(|n| n.as_vec3()).collect()
}

/// Adds a round button on the cloth at `at`, and gives the thread that holds it.
fn push_button(mesh: &mut Mesh, look: &Button, at: Vec3, normal: Vec3, scale: f32) -> Vec<Polyline> {
    let radius = look.diameter as f32 / 2.0 * scale;
    let [height, above] = BUTTON_HEIGHT.map(|h| h * scale);
    let side = normal.any_orthonormal_vector();
    let other = normal.cross(side);
    let around = |i: usize, r: f32, up: f32| {
        let (sin, cos) = (std::f32::consts::TAU * i as f32 / ROUND as f32).sin_cos();
        at + normal * up + (side * cos + other * sin) * r
    };
    let (low, high) = (above - height / 2.0, above + height / 2.0);
    // Rings from below: the foot, the rim, its upper edge, and the dip within it.
    let rings =
        [(radius * 0.9, low), (radius, above), (radius * 0.9, high), (radius * 0.7, high - height * 0.25)];
    let first = mesh.positions.len() as u32;
    for (r, up) in rings {
        mesh.positions.extend((0..ROUND).map(|i| around(i, r, up)));
    }
    let top = mesh.positions.len() as u32;
    mesh.positions.push(at + normal * (high - height * 0.25));
    mesh.colours.resize(mesh.positions.len(), look.colour);
    let n = ROUND as u32;
    for ring in 0..rings.len() as u32 - 1 {
        for i in 0..n {
            let (a, b) = (first + ring * n + i, first + ring * n + (i + 1) % n);
            mesh.triangles.extend([[a, b, b + n], [a, b + n, a + n]]);
        }
    }
    let last = first + (rings.len() as u32 - 1) * n;
    mesh.triangles.extend((0..n).map(|i| [last + i, last + (i + 1) % n, top]));
    let reach = radius * 2.0 * HOLES;
    let hole = |x: f32, y: f32| at + normal * (high - height * 0.1) + (side * x + other * y) * reach;
    let thread = line(shade(look.colour, 0.55), 2.0, THREAD_THICKNESS, scale);
    [[(-1.0, -1.0), (1.0, 1.0)], [(-1.0, 1.0), (1.0, -1.0)]]
        .map(|ends| Polyline { points: ends.map(|(x, y)| hole(x, y)).to_vec(), ..thread.clone() })
        .to_vec()
}

/// Adds the layer of a hem: along it the edge of the cloth, the edge of the layer, and its inner border.
fn push_hem(mesh: &mut Mesh, ends: &[[Vec3; 3]], colour: Rgb) {
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(ends.iter().flatten());
    mesh.colours.resize(mesh.positions.len(), colour);
    for i in 0..(ends.len() as u32).saturating_sub(1) {
        for k in 0..2 {
            let (a, b) = (first + 3 * i + k, first + 3 * (i + 1) + k);
            mesh.triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
        }
    }
}

/// Lines along the folds of the cloth that is on the body, without those that are `piped`; `is_seen` tells which vertices are not
/// covered.
pub fn fold_lines(
    garment: &Garment,
    state: &ClothState,
    (is_seen, piped): Lined<'_>,
    scale: f32,
) -> Vec<Polyline> {
    let crease = |corners: [u32; 2]| {
        let ends = corners.map(|c| garment.corners[c as usize].vertex);
        let is_laid = ends.iter().all(|&v| state.mapped.get(v as usize).copied().unwrap_or(false));
        let is_drawn = is_laid && ends.into_iter().all(is_seen) && !is_piped(piped, ends);
        is_drawn.then(|| Polyline {
            points: ends.map(|v| state.positions[v as usize].as_vec3()).to_vec(),
            ..line(CREASE, 1.2, 0.0, scale)
        })
    };
    garment.trims.folds.iter().filter_map(|fold| crease(fold.corners)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cloth::build;
    use crate::pattern::{Piece, PiecePoint, Piping, Topstitch};

    /// The garment of `pattern`, flat, 1 m up and 3 m in front.
    fn hung(pattern: &Pattern) -> (Arc<Garment>, ClothState) {
        let garment = Arc::new(build(pattern, 0.02).0);
        let mut state = ClothState {
            positions: vec![glam::DVec3::ZERO; garment.vertex_count],
            mapped: vec![true; garment.vertex_count],
        };
        for c in &garment.corners {
            state.positions[c.vertex as usize] = glam::DVec3::new(c.uv.x, 1.0 + c.uv.y, 3.0);
        }
        (garment, state)
    }

    #[test]
    fn stitches_and_buttons_lie_on_the_cloth_wherever_it_goes() {
        let corners = [(0.0, 0.0), (0.2, 0.0), (0.2, 0.1), (0.0, 0.1)].map(DVec2::from);
        let mut piece = Piece::polygon("front", &corners);
        piece.outline[0].trims.topstitch =
            Some(Topstitch { distance: 0.01, rows: 2, ..Topstitch::default() });
        let mut pattern = Pattern::default();
        let piece = pattern.add_piece(piece);
        let at = |x: f64| PiecePoint { piece, at: DVec2::new(x, 0.05) };
        let button = Button {
            button: at(0.05),
            hole: at(0.15),
            diameter: Button::SHIRT,
            colour: Button::PEARL,
            open: false,
        };
        pattern.add_button(button);
        let (garment, state) = hung(&pattern);
        let mut scenery = TrimScenery::default();
        let (lines, meshes) = scenery.drawn(&Arc::new(pattern), (&garment, &state), (&|_| true, None), 1.0);
        let stitches: Vec<&Polyline> = lines.iter().filter(|l| l.colour[..3] == [246, 243, 232]).collect();
        assert_eq!(stitches.len(), 2 * 67, "a stitch each 3 mm of two rows of 20 cm");
        let height = |l: &&Polyline| (l.points[0].y - 1.01).abs().min((l.points[0].y - 1.016).abs());
        assert!(stitches.iter().all(|l| height(l) < 1e-5));
        let [mesh] = &meshes[..] else { panic!("a button, not {} meshes", meshes.len()) };
        let far = mesh.positions.iter().map(|p| p.distance(Vec3::new(0.15, 1.05, 3.0))).fold(0.0, f32::max);
        assert!((0.005..0.008).contains(&far), "fastened it is on its hole: {far}");
        assert!(mesh.positions.iter().all(|p| p.z > 3.0), "on the outer side");
    }

    #[test]
    fn piping_is_a_tube_along_its_edge_and_dyed_without_new_cloth() {
        let corners = [(0.0, 0.0), (0.2, 0.0), (0.2, 0.1), (0.0, 0.1)].map(DVec2::from);
        let mut piece = Piece::polygon("front", &corners);
        let piping = Piping { radius: 0.002, colour: [10, 20, 30] };
        piece.outline[0].trims.piping = Some(piping);
        let mut pattern = Pattern::default();
        let id = pattern.add_piece(piece);
        let (garment, state) = hung(&pattern);
        let mut scenery = TrimScenery::default();
        let mut drawn = |pattern: &Pattern, scale: f32| {
            let pattern = Arc::new(pattern.clone());
            let (lines, meshes) = scenery.drawn(&pattern, (&garment, &state), (&|_| true, None), scale);
            assert!(lines.is_empty());
            let [tube] = &meshes[..] else { panic!("a tube, not {} meshes", meshes.len()) };
            tube.clone()
        };
        for scale in [1.0, 2.0] {
            let tube = drawn(&pattern, scale);
            let lowest = tube.positions.iter().map(|p| p.z).fold(f32::MAX, f32::min);
            let highest = tube.positions.iter().map(|p| p.z).fold(0.0, f32::max);
            assert!((highest - 3.0 - 0.002 * scale).abs() < 1.2e-4 * scale, "half above: {highest}");
            assert!((3.0 - lowest - 0.002 * scale).abs() < 1.2e-4 * scale, "half below: {lowest}");
            assert!(tube.positions.iter().all(|p| (p.y - 1.0).abs() < 0.00201 * scale));
            assert!(
                tube.colours.iter().all(|c| *c == [10, 20, 30]) && tube.normals.len() == tube.colours.len()
            );
        }
        let dyed = Some(Piping { colour: [200, 0, 0], ..piping });
        Arc::make_mut(pattern.pieces.get_mut(&id).expect("the piece")).outline[0].trims.piping = dyed;
        assert!(drawn(&pattern, 1.0).colours.iter().all(|c| *c == [200, 0, 0]));
    }
}
