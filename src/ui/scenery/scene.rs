//! Builds the renderer's scene from body, marks and cloth. No egui here: pictures without a window use it too.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DVec2, DVec3, Vec2, Vec3};

use crate::body::Surface;
use crate::cloth::cords::{is_piped, piped};
use crate::cloth::{ClothState, FlatPiece, FlatPlace, Garment};
use crate::contact::Bone;
use crate::geometry::adjacency::NONE;
use crate::geometry::ids::{MarkId, PieceId};
use crate::geometry::mesh::vertex_normals;
use crate::pattern::Pattern;
use crate::pattern::activity::Activity;
use crate::render::{CLOTH_BACK, CLOTH_FRONT, Ground, Label, Mesh, Polyline, Rgb, Scene, mark_colour};
use crate::ui::scenery::body_look::BodyLook;
use crate::ui::scenery::covered::covered;
use crate::ui::scenery::fabric_looks::PieceLooks;
use crate::ui::scenery::mapped::in_colours;
use crate::ui::scenery::parted::{deactivated, painted, parted};
use crate::ui::scenery::rims::{open_edges, rims};
use crate::ui::scenery::stitches::stitched;
use crate::ui::scenery::trims::{Lined, TrimScenery, fold_lines};
use crate::wrap::{ClothMark, Marks};

/// The look of a pin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PinLook {
    /// Whether the pin is locked, so that it can be neither moved nor removed.
    pub locked: bool,
    /// Whether the pin is selected.
    pub selected: bool,
}

/// The contents of a scene.
#[derive(Clone, Copy, Debug, Default)]
pub struct Shown<'a> {
    /// The body.
    pub body: Option<&'a Arc<Surface>>,
    /// How the body is shown.
    pub body_look: BodyLook,
    /// Draw seams as lines alone, as in a picture of the garment, not with stitches, by which they are known in editing.
    pub plain_seams: bool,
    /// The garment, and its positions.
    pub cloth: Option<(&'a Arc<Garment>, &'a Arc<ClothState>)>,
    /// The pattern, whose stitches, zips and buttons are drawn on the cloth.
    pub pattern: Option<&'a Arc<Pattern>>,
    /// Marks of the document.
    pub marks: Option<&'a Arc<Marks>>,
    /// The stroke being painted on the body.
    pub stroke: &'a [DVec3],
    /// The stroke painted at the same time on the far side of the body; it shows through the body.
    pub far_stroke: &'a [DVec3],
    /// The mark under the pointer.
    pub near: Option<MarkId>,
    /// Vertices under the pins.
    pub pinned: &'a [Option<u32>],
    /// Looks of the pins, in the same order; further pins have the default look.
    pub pins: &'a [PinLook],
    /// Bones, which show through the body.
    pub bones: &'a [Bone],
    /// Pieces that are not active.
    pub activities: Option<&'a BTreeMap<PieceId, Activity>>,
    /// Appearance of each piece; None: the colours of the layers, without a weave.
    pub looks: Option<&'a Arc<PieceLooks>>,
    /// The garment including its deactivated pieces, where `cloth` lacks them.
    pub whole: Option<(&'a Arc<Garment>, &'a Arc<ClothState>)>,
    /// Fraction of a drag's motion that reaches each vertex of the cloth, 0..=1.
    pub dragged: Option<&'a Arc<Vec<f32>>>,
    /// Colours of a map, one for each vertex of the cloth; None: its own colours.
    pub map: Option<&'a Arc<Vec<Rgb>>>,
    /// Meshes of another garment and its body.
    pub beside: &'a [Arc<Mesh>],
    /// The emphasised mark.
    pub selected: Option<MarkId>,
    /// Proposed marks that are not accepted yet.
    pub ghosts: Option<&'a Marks>,
    /// Emphasised lines of pieces, each in its piece's own plane; a line of one point is a dot.
    pub outlines: &'a [(PieceId, Vec<DVec2>)],
}

impl Shown<'_> {
    /// Width of the line of a mark, logical pixels.
    fn width(&self, mark: MarkId) -> f32 {
        let stands_out = [self.near, self.selected].contains(&Some(mark));
        if stands_out { MARK_WIDTH + 2.0 } else { MARK_WIDTH }
    }
}

/// Builds scenes; parts that did not change since the last scene are kept.
#[derive(Debug, Default)]
pub struct Scenery {
    body: Option<(Arc<Surface>, BodyLook, Arc<Mesh>)>,
    cloth: Option<DrawnCloth>,
    places: Option<MarkPlaces>,
    trims: TrimScenery,
}

#[derive(Debug)]
struct DrawnCloth {
    garment: Arc<Garment>,
    state: Arc<ClothState>,
    dragged: Option<Arc<Vec<f32>>>,
    map: Option<Arc<Vec<Rgb>>>,
    plain_seams: bool,
    activities: BTreeMap<PieceId, Activity>,
    looks: Option<Arc<PieceLooks>>,
    /// Meshes of the cloth, which share their vertices.
    meshes: Vec<Arc<Mesh>>,
    lines: Vec<Polyline>,
    /// Whether each vertex is covered by another layer; empty: none is.
    hidden: Vec<bool>,
}

/// Position of each point of each cloth mark in the garment's mesh.
#[derive(Debug)]
struct MarkPlaces {
    garment: Arc<Garment>,
    marks: Arc<Marks>,
    places: Vec<Vec<FlatPlace>>,
}

const INK: u8 = 255;
const WHITE: [u8; 4] = [255, 255, 255, 235];
/// Opacity of proposed marks.
const GHOST: u8 = 160;
/// Width of the line of a mark, logical pixels.
const MARK_WIDTH: f32 = 3.2;
/// Depth bias of a line: metres on a body 1.5 m tall, and half widths of the line.
type Lift = (f32, f32);
const ON_SKIN: Lift = (0.0025, 1.6);
/// Less than the cloth's offset from the skin, so that cloth hides it.
const UNDER_CLOTH: Lift = (0.002, 0.0);
const ON_CLOTH: Lift = (0.003, 1.6);
const ABOVE_ALL: Lift = (0.03, 1.6);
/// More than a body is thick, so that what is behind the body shows through it.
const BEHIND: Lift = (0.6, 1.6);
const ABOVE_BEHIND: Lift = (0.7, 1.6);
/// Colour of seams and edges of the cloth, sRGB and opacity.
const SEAM: [u8; 4] = [62, 66, 70, 150];
/// Factor for the colour of cloth that a drag in progress does not reach, sRGB.
const UNREACHED: Rgb = [150, 158, 172];
/// Distance of a pin's head from the cloth, metres on a body 1.5 m tall.
const PIN_LENGTH: f32 = 0.014;
/// Half a diagonal of the square collar of a locked pin, metres on a body 1.5 m tall.
const COLLAR: f32 = 0.013;
const BONE: [u8; 4] = [250, 246, 228, 255];
const NEEDLE: [u8; 4] = [70, 74, 84, 255];
const PIN_HEAD: [u8; 4] = [214, 48, 49, 255];
/// Colour of emphasised lines, sRGB and opacity.
const STANDS_OUT: [u8; 4] = [20, 132, 214, 255];
/// Diameter of the dot at a point of an emphasised line, logical pixels.
const DOT: f32 = 9.0;
const HEM: [u8; 4] = [52, 58, 60, 170];

impl Scenery {
    /// The scene of `shown`.
    pub fn scene(&mut self, shown: &Shown<'_>) -> Scene {
        let mut scene = Scene::default();
        let scale = shown.body.map_or(1.0, |b| b.scale() as f32);
        if let Some(body) = shown.body {
            scene.meshes.push(self.body_mesh(body, shown.body_look));
            scene.ground = Some(ground(body));
        }
        let mut covered = 0;
        if let Some((garment, state)) = shown.cloth {
            self.draw_cloth(garment, state, shown, scale);
            if let Some(drawn) = &self.cloth {
                scene.meshes.extend(drawn.meshes.iter().cloned());
                scene.lines.extend(drawn.lines.iter().cloned());
                push_pins(shown, drawn, scale, &mut scene);
            }
            if let Some(pattern) = shown.pattern.filter(|_| state.positions.len() == garment.vertex_count) {
                let looks = shown.looks.map(|looks| &**looks);
                self.draw_trims(pattern, (garment, state), looks, scale, &mut scene);
            }
            push_outlines(garment, state, shown.outlines, scale, &mut scene);
            if let Some(marks) = shown.marks {
                self.find_places(garment, marks);
                covered = self.cloth_marks(garment, state, shown, scale, &mut scene);
            }
        }
        scene.meshes.extend(shown.beside.iter().cloned());
        push_bones(shown.bones, scale, &mut scene);
        if let Some(marks) = shown.marks {
            body_marks(marks, shown, covered, scale, &mut scene);
        }
        if let Some(ghosts) = shown.ghosts {
            body_ghosts(ghosts, scale, &mut scene);
        }
        scene
    }

    fn draw_trims(
        &mut self,
        pattern: &Arc<Pattern>,
        cloth: (&Arc<Garment>, &Arc<ClothState>),
        looks: Option<&PieceLooks>,
        scale: f32,
        scene: &mut Scene,
    ) {
        let hidden = self.cloth.as_ref().map_or(&[][..], |drawn| &drawn.hidden);
        let is_seen = |v: u32| !hidden.get(v as usize).is_some_and(|hidden| *hidden);
        let (lines, meshes) = self.trims.drawn(pattern, (cloth.0, cloth.1), (&is_seen, looks), scale);
        scene.lines.extend(lines);
        scene.meshes.extend(meshes.into_iter().map(Arc::new));
    }

    fn body_mesh(&mut self, body: &Arc<Surface>, look: BodyLook) -> Arc<Mesh> {
        match &self.body {
            Some((kept, of, mesh)) if Arc::ptr_eq(kept, body) && *of == look => Arc::clone(mesh),
            _ => {
                let mesh = Arc::new(body_mesh(body, look));
                self.body = Some((Arc::clone(body), look, Arc::clone(&mesh)));
                mesh
            }
        }
    }

    fn draw_cloth(&mut self, garment: &Arc<Garment>, state: &Arc<ClothState>, shown: &Shown<'_>, scale: f32) {
        let Shown { dragged, map, plain_seams, .. } = *shown;
        let activities = shown.activities.cloned().unwrap_or_default();
        let kept = self.cloth.as_ref().is_some_and(|c| {
            Arc::ptr_eq(&c.garment, garment)
                && Arc::ptr_eq(&c.state, state)
                && c.dragged.as_ref().map(Arc::as_ptr) == dragged.map(Arc::as_ptr)
                && c.map.as_ref().map(Arc::as_ptr) == map.map(Arc::as_ptr)
                && c.plain_seams == plain_seams
                && c.activities == activities
                && c.looks.as_ref() == shown.looks
        });
        if kept || state.positions.len() != garment.vertex_count {
            return;
        }
        let hidden = covered(garment, state, f64::from(scale));
        let is_seen = |v: u32| !hidden.get(v as usize).is_some_and(|hidden| *hidden);
        // A cord covers what would be drawn along its edges.
        let piped = piped(garment);
        let which: Lined<'_> = (&is_seen, &piped);
        let mut lines = seam_lines(garment, state, which, scale);
        if !plain_seams {
            lines = stitched(lines, scale);
        }
        lines.extend(hem_lines(garment, state, which, scale));
        lines.extend(fold_lines(garment, state, which, scale));
        let mesh = Mesh {
            colours: dragged.map(|shares| tints(shares, state)).unwrap_or_default(),
            ..cloth_mesh(garment, state)
        };
        let coloured =
            |mesh: Mesh| Arc::new(map.and_then(|colours| in_colours(&mesh, colours)).unwrap_or(mesh));
        let asleep = shown.whole.map(|(garment, state)| {
            Arc::new(deactivated(&cloth_mesh(garment, state), garment, state, &activities))
        });
        let asleep = asleep.filter(|mesh| !mesh.triangles.is_empty());
        let rims = match (map, dragged) {
            (None, None) => rims_of(garment, state, &mesh, &activities, shown.looks, &is_seen),
            _ => Vec::new(),
        };
        self.cloth = Some(DrawnCloth {
            garment: Arc::clone(garment),
            state: Arc::clone(state),
            dragged: dragged.cloned(),
            map: map.cloned(),
            plain_seams,
            meshes: parted(
                mesh,
                garment,
                state,
                &activities,
                shown.looks.map_or(&PieceLooks::new(), |looks| looks),
            )
            .into_iter()
            .map(coloured)
            .chain(asleep)
            .chain(rims.into_iter().map(Arc::new))
            .collect(),
            activities,
            looks: shown.looks.cloned(),
            lines,
            hidden,
        });
    }

    fn find_places(&mut self, garment: &Arc<Garment>, marks: &Arc<Marks>) {
        let kept = self
            .places
            .as_ref()
            .is_some_and(|p| Arc::ptr_eq(&p.garment, garment) && Arc::ptr_eq(&p.marks, marks));
        if !kept {
            let places = marks.cloth.iter().map(|m| places_of(garment, m)).collect();
            self.places = Some(MarkPlaces { garment: Arc::clone(garment), marks: Arc::clone(marks), places });
        }
    }

    /// Adds the marks of the cloth at their present position. Returns how many of the first ones have all their points on
    /// cloth that is there.
    fn cloth_marks(
        &self,
        garment: &Garment,
        state: &ClothState,
        shown: &Shown<'_>,
        scale: f32,
        scene: &mut Scene,
    ) -> usize {
        let Some(found) = &self.places else { return 0 };
        let mut covered = 0;
        for (i, places) in found.places.iter().enumerate() {
            let places = places.iter().map(|p| p.point(garment, state).map(|p| p.as_vec3()));
            let points: Option<Vec<Vec3>> = places.collect();
            if let Some(points) = points.filter(|p| !p.is_empty()) {
                push_mark(scene, points, i + 1, shown.width(found.marks.cloth[i].id), ON_CLOTH, scale);
                covered += usize::from(covered == i);
            }
        }
        covered
    }
}

/// The mesh of a body as it looks.
pub fn body_mesh(body: &Surface, look: BodyLook) -> Mesh {
    look.on(Mesh {
        positions: body.mesh.positions.iter().map(|p| p.as_vec3()).collect(),
        normals: body.vertex_normals.iter().map(|n| n.as_vec3()).collect(),
        triangles: body.mesh.triangles.clone(),
        ..Mesh::default()
    })
}

/// The mesh of the cloth that is placed on the body, in its own colours.
pub fn cloth_mesh(garment: &Garment, state: &ClothState) -> Mesh {
    let on_body = |t: &[u32; 3]| t.iter().all(|&v| state.mapped[v as usize]);
    let triangles: Vec<[u32; 3]> = garment.triangles.iter().copied().filter(on_body).collect();
    let normals = vertex_normals(&state.positions, &triangles);
    Mesh {
        positions: state.positions.iter().map(|p| p.as_vec3()).collect(),
        normals: normals.iter().map(|n| n.as_vec3()).collect(),
        triangles,
        front: CLOTH_FRONT,
        back: CLOTH_BACK,
        cloth: 1.0,
        ..Mesh::default()
    }
}

/// Vertex colours that make cloth lighter where a drag reaches it.
fn tints(shares: &[f32], state: &ClothState) -> Vec<Rgb> {
    let split = state.positions.len().saturating_sub(shares.len());
    // Vertices added on split edges are treated as reached by the drag.
    let shares = shares.iter().chain(std::iter::repeat_n(&1.0, split));
    let far: Vec<Rgb> = shares.map(|&s| UNREACHED.map(|c| c + ((255 - c) as f32 * s) as u8)).collect();
    if far.len() == state.positions.len() { far } else { Vec::new() }
}

/// Adds a needle with a head at each pinned vertex: the head is larger if the pin is selected, and a locked pin has a square
/// collar at its foot.
fn push_pins(shown: &Shown<'_>, cloth: &DrawnCloth, scale: f32, scene: &mut Scene) {
    let looks = shown.pins.iter().copied().chain(std::iter::repeat(PinLook::default()));
    let Some(mesh) = cloth.meshes.first() else { return };
    for (v, look) in shown.pinned.iter().zip(looks) {
        let v = v.map(|v| v as usize);
        let place = v.and_then(|v| Some((*mesh.positions.get(v)?, *mesh.normals.get(v)?)));
        let Some((at, normal)) = place else { continue };
        let head = at + normal * (PIN_LENGTH * scale);
        let line = |points, colour, width, lift| Polyline {
            points,
            colour,
            width,
            halo: WHITE,
            halo_width: 1.2,
            lift: lift * scale,
            lift_widths: 1.0,
            thickness: 0.0,
            closed: false,
        };
        if look.locked {
            let (side, up) = (normal.any_orthonormal_vector(), normal);
            let (one, other) = (side * (COLLAR * scale), up.cross(side) * (COLLAR * scale));
            let foot = at + normal * (0.001 * scale);
            let corners = vec![foot + one, foot + other, foot - one, foot - other];
            scene.lines.push(Polyline { closed: true, ..line(corners, NEEDLE, 3.0, 0.004) });
        }
        scene.lines.push(line(vec![at, head], NEEDLE, 1.6, 0.003));
        let (ink, width) = match look {
            PinLook { selected: true, .. } => (STANDS_OUT, 13.0),
            PinLook { locked: true, .. } => (NEEDLE, 9.0),
            _ => (PIN_HEAD, 9.0),
        };
        scene.lines.push(line(vec![head], ink, width, 0.006));
    }
}

/// Adds bones with a joint at either end; they show through everything in front of them.
fn push_bones(bones: &[Bone], scale: f32, scene: &mut Scene) {
    for bone in bones {
        let ends = bone.map(|p| p.as_vec3());
        let line = |points: Vec<Vec3>, width| Polyline {
            points,
            colour: BONE,
            width,
            halo: NEEDLE,
            halo_width: 1.2,
            lift: BEHIND.0 * scale,
            ..Polyline::default()
        };
        scene.lines.push(line(ends.to_vec(), 4.0));
        scene.lines.extend(ends.map(|end| line(vec![end], 9.0)));
    }
}

/// Adds emphasised lines of pieces at their position on the body; a line of one point is a dot.
fn push_outlines(
    garment: &Garment,
    state: &ClothState,
    outlines: &[(PieceId, Vec<DVec2>)],
    scale: f32,
    scene: &mut Scene,
) {
    for (piece, points) in outlines {
        let flat = FlatPiece::new(garment, *piece);
        let place = |p: &DVec2| Some(flat.nearest(garment, *p)?.point(garment, state)?.as_vec3());
        let width = if points.len() == 1 { DOT } else { 4.0 };
        let placed: Vec<Vec3> = points.iter().filter_map(place).collect();
        if placed.len() > 1 || (points.len() == 1 && placed.len() == 1) {
            let mut line = thin_line(placed, STANDS_OUT, width, scale);
            (line.lift, line.halo, line.halo_width) = (ON_CLOTH.0 * scale, WHITE, 1.2);
            scene.lines.push(line);
        }
    }
}

fn places_of(garment: &Garment, mark: &ClothMark) -> Vec<FlatPlace> {
    let piece = FlatPiece::new(garment, mark.piece);
    mark.points.iter().filter_map(|&p| piece.inside(garment, p)).collect()
}

fn seam_lines(
    garment: &Garment,
    state: &ClothState,
    (is_seen, piped): Lined<'_>,
    scale: f32,
) -> Vec<Polyline> {
    let is_drawn = |v: &u32| {
        state.mapped[*v as usize] && !garment.adjacency.vertex_triangles.of(*v).is_empty() && is_seen(*v)
    };
    let mut lines = Vec::new();
    for (_, pairs) in &garment.seam_pairs {
        let vertices: Vec<u32> = pairs.iter().map(|pair| garment.corners[pair[0] as usize].vertex).collect();
        let drawn = vertices.split(|v| !is_drawn(v));
        let plain = drawn.flat_map(|run| run.chunk_by(|&a, &b| !is_piped(piped, [a, b])));
        for run in plain.filter(|run| run.len() > 1) {
            let points = run.iter().map(|&v| state.positions[v as usize].as_vec3()).collect();
            lines.push(thin_line(points, SEAM, 1.3, scale));
        }
    }
    lines
}

/// The border of the cloth that is on the body: hems, and the front of a wrap in progress.
fn hem_lines(
    garment: &Garment,
    state: &ClothState,
    (is_seen, piped): Lined<'_>,
    scale: f32,
) -> Vec<Polyline> {
    let on_body =
        |t: u32| t != NONE && garment.triangles[t as usize].iter().all(|&v| state.mapped[v as usize]);
    let mut lines = Vec::new();
    for (t, vertices) in garment.triangles.iter().enumerate() {
        if !on_body(t as u32) {
            continue;
        }
        for k in 0..3 {
            let lonely =
                garment.adjacency.edge_triangles.of(garment.adjacency.triangle_edges[t][k]).len() == 1;
            let across = garment.adjacency.across[t][k];
            if lonely || (across != NONE && !on_body(across)) {
                let ends = [vertices[k], vertices[(k + 1) % 3]];
                if !ends.into_iter().all(is_seen) || is_piped(piped, ends) {
                    continue;
                }
                let points = ends.iter().map(|&v| state.positions[v as usize].as_vec3()).collect();
                lines.push(thin_line(points, HEM, 1.5, scale));
            }
        }
    }
    lines
}

/// The thickness of cloth at its open edges. A map or a drag, which colour vertices, are shown without.
fn rims_of(
    garment: &Garment,
    state: &ClothState,
    whole: &Mesh,
    activities: &BTreeMap<PieceId, Activity>,
    looks: Option<&Arc<PieceLooks>>,
    is_seen: &dyn Fn(u32) -> bool,
) -> Vec<Mesh> {
    let none = PieceLooks::new();
    let looks = looks.map_or(&none, |looks| looks);
    let edges = open_edges(garment, state, is_seen);
    let thickness = |piece| looks.get(&piece).map_or(0.0, |look| look.thickness as f32);
    rims(garment, whole, &edges, looks, thickness, |piece| painted(whole, garment, activities, looks, piece))
}

fn thin_line(points: Vec<Vec3>, colour: [u8; 4], width: f32, scale: f32) -> Polyline {
    Polyline { points, colour, width, lift: 0.002 * scale, lift_widths: 1.0, ..Polyline::default() }
}

/// Adds marks on the body. Those whose partner on the cloth covers them keep their line but have no number of their own.
fn body_marks(marks: &Marks, shown: &Shown<'_>, covered: usize, scale: f32, scene: &mut Scene) {
    for (i, mark) in marks.body.iter().enumerate() {
        let points: Vec<Vec3> = mark.points.iter().map(|p| p.as_vec3()).collect();
        let width = shown.width(mark.id);
        let lift = if i < covered { UNDER_CLOTH } else { ON_SKIN };
        push_mark(scene, points, i + 1, width, lift, scale);
        if i < covered {
            scene.labels.pop();
        }
    }
    let points = |stroke: &[DVec3]| stroke.iter().map(|p| p.as_vec3()).collect();
    if !shown.far_stroke.is_empty() {
        // From where it is painted, the far stroke is right behind the near one, so it is a broad band that shows on both sides
        // of it.
        push_ghost(scene, points(shown.far_stroke), marks.body.len() + 2, MARK_WIDTH * 3.0, BEHIND, scale);
        if let Some(label) = scene.labels.last_mut() {
            label.offset.x = -label.offset.x;
        }
    }
    if !shown.stroke.is_empty() {
        // It is drawn above cloth, so that the user sees the stroke.
        let lift = if shown.far_stroke.is_empty() { ABOVE_ALL } else { ABOVE_BEHIND };
        push_mark(scene, points(shown.stroke), marks.body.len() + 1, MARK_WIDTH, lift, scale);
    }
}

/// Adds proposed marks: thinner than marks, and half transparent.
fn body_ghosts(ghosts: &Marks, scale: f32, scene: &mut Scene) {
    for (mark, number) in ghosts.body.iter().zip(1..) {
        let points = mark.points.iter().map(|p| p.as_vec3()).collect();
        push_ghost(scene, points, number, MARK_WIDTH * 0.55, ABOVE_ALL, scale);
    }
}

fn push_ghost(scene: &mut Scene, points: Vec<Vec3>, number: usize, width: f32, lift: Lift, scale: f32) {
    let lines = scene.lines.len();
    push_mark(scene, points, number, width, lift, scale);
    for line in &mut scene.lines[lines..] {
        (line.colour[3], line.halo[3]) = (GHOST, GHOST / 2);
        if let Some(label) = scene.labels.last_mut() {
            (label.colour[3], label.halo[3]) = (GHOST, GHOST);
        }
    }
}

fn push_mark(scene: &mut Scene, points: Vec<Vec3>, number: usize, width: f32, lift: Lift, scale: f32) {
    let Some(&first) = points.first() else { return };
    let points = simplified(&points, 6e-4 * scale);
    let colour = opaque(mark_colour(number));
    let (lift, lift_widths) = (lift.0 * scale, lift.1);
    let width = if points.len() == 1 { width * 2.2 } else { width };
    scene.lines.push(Polyline {
        points,
        colour,
        width,
        halo: WHITE,
        halo_width: 1.8,
        lift,
        lift_widths,
        closed: false,
        thickness: 0.0,
    });
    scene.labels.push(Label {
        anchor: first,
        offset: Vec2::new(-11.0, 11.0),
        text: number.to_string(),
        height: 9.5,
        colour,
        halo: [255, 255, 255, 255],
        lift: lift + 0.05 * scale,
    });
}

/// A polyline with fewer points, within `tolerance` metres of the old ones (Ramer, Douglas and Peucker): many short capsules
/// would look like beads.
fn simplified(points: &[Vec3], tolerance: f32) -> Vec<Vec3> {
    let (Some(&first), Some(&last)) = (points.first(), points.last()) else { return Vec::new() };
    let along = last - first;
    let away = |p: Vec3| {
        let t = ((p - first).dot(along) / along.length_squared().max(1e-18)).clamp(0.0, 1.0);
        p.distance(first + along * t)
    };
    let farthest =
        (1..points.len().saturating_sub(1)).max_by(|&i, &j| away(points[i]).total_cmp(&away(points[j])));
    match farthest {
        Some(i) if away(points[i]) > tolerance => {
            let mut out = simplified(&points[..=i], tolerance);
            out.pop();
            out.extend(simplified(&points[i..], tolerance));
            out
        }
        _ if points.len() < 2 => points.to_vec(),
        _ => vec![first, last],
    }
}

fn opaque(c: Rgb) -> [u8; 4] {
    [c[0], c[1], c[2], INK]
}

fn ground(body: &Surface) -> Ground {
    let (lower, upper) = body.bounds();
    let middle = (lower + upper) / 2.0;
    Ground {
        height: body.floor().unwrap_or(lower.y) as f32,
        centre: Vec2::new(middle.x as f32, middle.z as f32),
        radius: ((upper - lower).max_element() * 1.15) as f32,
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::cloth::build;
    use crate::pattern::{EdgeRef, Piece, Seam};

    #[test]
    fn a_straight_line_needs_two_points_and_a_bend_keeps_its_corner() {
        let straight: Vec<Vec3> = (0..50).map(|i| Vec3::X * i as f32 * 0.01).collect();
        assert_eq!(simplified(&straight, 1e-4), [straight[0], straight[49]]);
        let mut bent = straight.clone();
        bent.extend((1..50).map(|i| straight[49] + Vec3::Y * i as f32 * 0.01));
        assert_eq!(simplified(&bent, 1e-4), [bent[0], bent[49], bent[98]]);
        assert_eq!(simplified(&bent[..1], 1e-4), [bent[0]]);
    }

    #[test]
    fn a_laser_stroke_is_seen_on_both_sides_while_it_is_painted() {
        let marks = Arc::new(Marks::default());
        let line = |z: f64| [DVec3::new(0.0, 0.0, z), DVec3::new(0.0, 0.1, z)];
        let (near, far) = (line(0.1), line(-0.1));
        let shown = Shown { marks: Some(&marks), stroke: &near, far_stroke: &far, ..Shown::default() };
        let scene = Scenery::default().scene(&shown);
        let [far, near] = &scene.lines[..] else { panic!("{} lines", scene.lines.len()) };
        assert!(far.points[0].z < 0.0 && far.lift > 0.3, "it is drawn before the body it lies behind");
        assert!(far.lift < near.lift && far.width > near.width, "on both sides of the near one");
        assert!(far.colour[3] < near.colour[3], "and fainter");
        let numbers: Vec<&str> = scene.labels.iter().map(|label| label.text.as_str()).collect();
        assert_eq!(numbers, ["2", "1"]);
    }

    #[test]
    fn seams_are_lines_with_stitches_or_alone_and_nothing_where_a_cord_lies() {
        let mut pattern = Pattern::default();
        let corners = [(0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.0, 0.1)].map(DVec2::from);
        let ids = [0, 1].map(|_| pattern.add_piece(Piece::polygon("square", &corners)));
        let sides = [EdgeRef { piece: ids[0], edge: 1 }, EdgeRef { piece: ids[1], edge: 3 }];
        pattern.add_seam(Seam::of_edges(sides, false));
        let garment = Arc::new(build(&pattern, 0.02).0);
        let count = garment.vertex_count;
        let mut state = ClothState { positions: vec![DVec3::ZERO; count], mapped: vec![true; count] };
        garment.corners.iter().for_each(|c| state.positions[c.vertex as usize] = c.uv.extend(0.0));
        let state = Arc::new(state);
        let pairs = &garment.seam_pairs[0].1;
        let along: Vec<[u32; 2]> = pairs
            .windows(2)
            .map(|w| [w[0], w[1]].map(|pair| garment.corners[pair[0] as usize].vertex))
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect();
        let sides = |piped: &[[u32; 2]]| -> Vec<usize> {
            let piped = piped.iter().copied().collect();
            let lines = seam_lines(&garment, &state, (&|_| true, &piped), 1.0);
            lines.iter().map(|line| line.points.len() - 1).collect()
        };
        assert_eq!(along.len(), 5);
        assert_eq!((sides(&[]), sides(&along[..2])), (vec![5], vec![3]));
        assert_eq!((sides(&along[2..3]), sides(&along)), (vec![2, 2], vec![]));
        let open = |piped: &BTreeSet<[u32; 2]>| hem_lines(&garment, &state, (&|_| true, piped), 1.0).len();
        let all = open(&BTreeSet::new());
        let lowest = |v: u32| garment.corners.iter().any(|c| c.vertex == v && c.uv.y == 0.0);
        let ends = garment.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        let lower: BTreeSet<[u32; 2]> =
            ends.map(|[a, b]| [a.min(b), a.max(b)]).filter(|ends| ends.iter().all(|&v| lowest(v))).collect();
        assert_eq!((all, open(&lower)), (30, 20), "the lower edges of both have 10 sides");
        let mut scenery = Scenery::default();
        let [alone, stitched, again] = [true, false, true].map(|plain_seams| {
            let shown = Shown { cloth: Some((&garment, &state)), plain_seams, ..Shown::default() };
            scenery.scene(&shown).lines.len()
        });
        assert!(stitched > alone + 5 && again == alone, "{alone}, {stitched}, {again}");
    }
}
