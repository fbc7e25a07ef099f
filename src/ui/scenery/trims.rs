//! Draws what is worked on the cloth: fold lines, topstitching, hems, elastic, piping, zips and buttons. No egui here: pictures
//! without a window use it too.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::Vec3;

use crate::cloth::cords::{Cord, Ends, is_piped};
use crate::cloth::dashes::dashes;
use crate::cloth::trim_shapes::{
    AROUND_BUTTON, GAP, SLIT, STITCH_SHARES, TAPE, TAPE_WIDTH, THREAD_THICKNESS, TOOTH, hem_layer,
    push_button, push_hem, shade,
};
use crate::cloth::{ClothState, FlatPlace, Garment, TrimShapes};
use crate::geometry::mesh::vertex_normals;
use crate::geometry::solid::Solid;
use crate::pattern::Pattern;
use crate::pattern::stitches::Thread;
use crate::render::{CLOTH_BACK, Mesh, Polyline, Rgb};
use crate::ui::scenery::fabric_looks::PieceLooks;

/// Colour of a crease, sRGB and opacity.
const CREASE: [u8; 4] = [40, 44, 48, 110];
/// Depth bias of a row, metres.
const LIFT: f32 = 0.0026;

/// Which lines along the cloth are drawn: of vertices that are seen, and not of these edges, which a cord covers.
pub type Lined<'a> = (&'a dyn Fn(u32) -> bool, &'a BTreeSet<Ends>);

/// Draws the trims of a garment; keeps where they are on it until garment or pattern change.
#[derive(Debug, Default)]
pub struct TrimScenery {
    places: Option<Places>,
}

#[derive(Debug)]
struct Places {
    garment: Arc<Garment>,
    pattern: Arc<Pattern>,
    shapes: TrimShapes,
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
            let shapes = TrimShapes::new(garment, pattern);
            self.places = Some(Places { garment: Arc::clone(garment), pattern: Arc::clone(pattern), shapes });
        }
        let Some(Places { shapes, .. }) = &self.places else { return (Vec::new(), Vec::new()) };
        let seen = |place: &FlatPlace| {
            let vertices = place.vertices(garment);
            let is_seen = vertices.iter().all(|&(v, _)| is_seen(v));
            place.point(garment, state).map(|p| p.as_vec3()).filter(|_| is_seen)
        };
        let mut lines = Vec::new();
        for (thread, row) in &shapes.rows {
            let points: Vec<Option<Vec3>> = row.iter().map(seen).collect();
            for run in points.split(Option::is_none).filter(|run| run.len() > 1) {
                let run: Vec<Vec3> = run.iter().flatten().copied().collect();
                lines.extend(threads(&run, *thread, scale));
            }
        }
        let is_flat = shapes.buttons.is_empty() && shapes.hems.is_empty();
        let normals = if is_flat { Vec::new() } else { normals(garment, state) };
        let normal_at = |place: &FlatPlace| {
            let vertices = place.vertices(garment);
            vertices.iter().map(|&(v, s)| normals[v as usize] * s as f32).sum::<Vec3>().normalize_or(Vec3::Z)
        };
        let mut solid = Solid::default();
        for button in &shapes.buttons {
            let slit: Vec<Vec3> = button.slit.iter().filter_map(seen).collect();
            if slit.len() == button.slit.len() {
                let around = opaque(shade(button.look.colour, AROUND_BUTTON[0]));
                lines.push(Polyline { points: slit, ..line(around, 2.2, SLIT, scale) });
            }
            let Some((place, at)) = button.shown().and_then(|place| Some((place, seen(place)?))) else {
                continue;
            };
            let normal = normal_at(place);
            let frame = [normal, normal.any_orthonormal_vector()];
            let threads = push_button(&mut solid, &button.look, at, frame, scale);
            let thread = opaque(shade(button.look.colour, AROUND_BUTTON[1]));
            let thread = line(thread, 2.0, THREAD_THICKNESS, scale);
            lines.extend(threads.map(|ends| Polyline { points: ends.to_vec(), ..thread.clone() }));
        }
        for (piece, pairs) in &shapes.hems {
            let own = looks.and_then(|looks| looks.get(piece)?.colours);
            let inside = own.map_or(CLOTH_BACK, |[_, inside]| inside);
            let ends: Vec<Option<[Vec3; 3]>> = pairs
                .iter()
                .map(|[edge, inner]| {
                    let on =
                        |place: &FlatPlace| Some([place.point(garment, state)?.as_vec3(), normal_at(place)]);
                    Some(hem_layer([on(edge)?, on(inner)?], scale))
                })
                .collect();
            for run in ends.split(Option::is_none) {
                push_hem(&mut solid, &run.iter().flatten().copied().collect::<Vec<_>>(), inside);
            }
        }
        let mut meshes = vec![plain(solid), tubes(&shapes.cords, state, is_seen, scale)];
        meshes.retain(|mesh| !mesh.triangles.is_empty());
        (lines, meshes)
    }
}

/// A solid in its own colours.
fn plain(solid: Solid) -> Mesh {
    let Solid { positions, normals, triangles, colours } = solid;
    Mesh { positions, normals, triangles, colours, front: [255; 3], back: [255; 3], ..Mesh::default() }
}

/// The tubes of `cords`, in cloth.
fn tubes(cords: &[Cord], state: &ClothState, is_seen: &dyn Fn(u32) -> bool, scale: f32) -> Mesh {
    let mut solid = Solid::default();
    let place = |v: u32| {
        let is_shown = state.mapped[v as usize] && is_seen(v);
        is_shown.then(|| [state.positions[v as usize].as_vec3(), Vec3::ZERO])
    };
    cords.iter().for_each(|cord| cord.push(&mut solid, place, scale));
    Mesh { cloth: 1.0, ..plain(solid) }
}

/// The lines of one row of stitches.
fn threads(points: &[Vec3], thread: Thread, scale: f32) -> Vec<Polyline> {
    let [stitches, unbroken] = STITCH_SHARES.map(|share| THREAD_THICKNESS * share);
    match thread {
        Thread::Stitches { length, colour } => {
            let length = length as f32 * scale;
            let (stitch, gap) = (length * (1.0 - GAP), length * GAP);
            let look = line(opaque(colour), 1.7, stitches, scale);
            dashes(points, stitch, gap)
                .into_iter()
                .map(|points| Polyline { points, ..look.clone() })
                .collect()
        }
        Thread::Line { colour } => {
            vec![Polyline { points: points.to_vec(), ..line(opaque(colour), 1.4, unbroken, scale) }]
        }
        Thread::Teeth { colour } => {
            let [tooth, gap, width] = TOOTH;
            let tape = Polyline {
                points: points.to_vec(),
                ..line(opaque(shade(colour, TAPE)), 9.0, width * TAPE_WIDTH, scale)
            };
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

fn normals(garment: &Garment, state: &ClothState) -> Vec<Vec3> {
    let is_laid = |t: &[u32; 3]| t.iter().all(|&v| state.mapped[v as usize]);
    let triangles: Vec<[u32; 3]> = garment.triangles.iter().copied().filter(is_laid).collect();
    vertex_normals(&state.positions, &triangles).iter().map(|n| n.as_vec3()).collect()
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
    use glam::DVec2;

    use super::*;
    use crate::cloth::build;
    use crate::pattern::{Button, Piece, PiecePoint, Piping, Topstitch};

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
            tack: false,
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
