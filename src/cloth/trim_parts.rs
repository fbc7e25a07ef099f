//! Trims as solid shapes in true size, for files: parts of one kind and colour, each with the same triangles wherever the cloth
//! goes.

use std::collections::BTreeMap;

use glam::{DVec3, Vec3};

use crate::cloth::cords::Cord;
use crate::cloth::dashes::{Station, dash_stations};
use crate::cloth::trim_shapes::{
    AROUND_BUTTON, GAP, SLIT, STITCH_SHARES, TAPE, TAPE_WIDTH, THREAD_THICKNESS, TOOTH, hem_layer,
    push_button, push_hem, shade,
};
use crate::cloth::{ClothState, FlatPlace, Garment, TrimShapes};
use crate::geometry::ids::PieceId;
use crate::geometry::solid::{Section, Solid};
use crate::pattern::Button;
use crate::pattern::stitches::Thread;

/// Largest number of vertices of all rows of stitches, threads and teeth of cloth that stands still.
pub const MOST_STILL: usize = 400_000;
/// The same of cloth that moves, whose vertices are written for each frame.
pub const MOST_MOVING: usize = 100_000;
/// Corners of the cross section of threads and teeth, and where there would be too many vertices.
const SIDES: [u32; 2] = [6, 3];
/// Half heights of a tooth of a zip, of its tape, and of what edges a buttonhole, metres. The picture draws them flat.
const HALF_HEIGHTS: [f32; 3] = [0.0009, 0.0003, 0.0004];

/// What a part is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum TrimKind {
    /// Cords covered with cloth.
    Piping,
    /// Buttons.
    Button,
    /// The threads that hold buttons.
    ButtonThread,
    /// What edges buttonholes.
    Buttonhole,
    /// Topstitching, the stitches of hems and of elastic.
    Stitches,
    /// The tapes of zips.
    ZipTape,
    /// The teeth of zips.
    ZipTeeth,
    /// The layer of cloth that is turned in.
    Hem,
}

impl TrimKind {
    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Piping => "Piping",
            Self::Button => "Button",
            Self::ButtonThread => "Button thread",
            Self::Buttonhole => "Buttonhole",
            Self::Stitches => "Stitches",
            Self::ZipTape => "Zip tape",
            Self::ZipTeeth => "Zip teeth",
            Self::Hem => "Hem",
        }
    }
}

/// The colour of a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Paint {
    /// Its own, sRGB.
    Colour([u8; 3]),
    /// That of the inner side of a piece.
    Inside(PieceId),
}

/// All trims of one kind and colour.
#[derive(Clone, Debug)]
pub struct TrimPart {
    /// What they are.
    pub kind: TrimKind,
    /// Their colour.
    pub paint: Paint,
    items: Vec<Item>,
    /// Number of its vertices.
    vertices: usize,
}

/// The trims of a garment as parts, in the order of their kinds and colours.
#[derive(Clone, Debug, Default)]
pub struct TrimParts {
    /// The parts.
    pub parts: Vec<TrimPart>,
    /// Number of rows of stitches, threads and teeth that are left out, as there would be too many vertices.
    pub left_out: usize,
}

#[derive(Clone, Debug)]
enum Item {
    Cord(Cord),
    Button(Button, FlatPlace),
    ButtonThread(Button, FlatPlace),
    Rods(Rods),
    Hem(Vec<[FlatPlace; 2]>),
}

/// Rods along a line on the cloth.
#[derive(Clone, Debug)]
struct Rods {
    places: Vec<FlatPlace>,
    /// The points of each rod on the line through `places`.
    dashes: Vec<Vec<Station>>,
    section: Section,
}

/// A part of a part: rods, what they are, and their colour.
type Painted = (TrimKind, [u8; 3], Rods);

impl Rods {
    fn vertices(&self) -> usize {
        self.dashes.iter().map(|dash| self.section.vertices(dash.len())).sum()
    }

    fn push(&self, solid: &mut Solid, cloth: &Laid<'_>) {
        let points: Vec<Vec3> = self.places.iter().map(|place| cloth.point(place)).collect();
        let normals: Vec<Vec3> = self.places.iter().map(|place| cloth.normal(place)).collect();
        for dash in &self.dashes {
            let on = |all: &[Vec3]| -> Vec<Vec3> { dash.iter().map(|station| station.on(all)).collect() };
            solid.push_rod(&on(&points), &on(&normals), self.section);
        }
    }
}

/// Cloth on the body with its normals.
struct Laid<'a> {
    garment: &'a Garment,
    state: &'a ClothState,
    normals: &'a [DVec3],
}

impl Laid<'_> {
    fn point(&self, place: &FlatPlace) -> Vec3 {
        let vertices = place.vertices(self.garment);
        vertices.iter().map(|&(v, share)| self.state.positions[v as usize] * share).sum::<DVec3>().as_vec3()
    }

    fn normal(&self, place: &FlatPlace) -> Vec3 {
        let vertices = place.vertices(self.garment);
        let normal: DVec3 = vertices.iter().map(|&(v, share)| self.normals[v as usize] * share).sum();
        normal.normalize_or(DVec3::Z).as_vec3()
    }

    /// The normal at `place`, and a unit vector across it that goes along with the cloth.
    fn frame(&self, place: &FlatPlace) -> [Vec3; 2] {
        let normal = self.normal(place);
        let [a, b, _] = self.garment.triangles[place.triangle as usize];
        let side = (self.state.positions[b as usize] - self.state.positions[a as usize]).as_vec3();
        let side = side.reject_from_normalized(normal).try_normalize();
        [normal, side.unwrap_or_else(|| normal.any_orthonormal_vector())]
    }

    /// A vertex that is on the body, and its normal.
    fn vertex(&self, v: u32) -> Option<[Vec3; 2]> {
        let is_laid = self.state.mapped.get(v as usize) == Some(&true);
        is_laid.then(|| [self.state.positions[v as usize].as_vec3(), self.normals[v as usize].as_vec3()])
    }
}

impl TrimParts {
    /// The parts of `shapes` that are on the body in `state`. Rows of stitches, threads and teeth have at most `most` vertices
    /// together: where they would have more, they are three-sided instead of six-sided, and if that is not enough the last rows are
    /// left out. Stitches are as long as they should be in `state`.
    pub fn new(shapes: &TrimShapes, garment: &Garment, state: &ClothState, most: usize) -> Self {
        let is_laid = |place: &FlatPlace| place.point(garment, state).is_some();
        let mut items: BTreeMap<(TrimKind, Paint), Vec<Item>> = BTreeMap::new();
        let mut put = |kind: TrimKind, paint: Paint, item: Item| {
            items.entry((kind, paint)).or_default().push(item);
        };
        for cord in &shapes.cords {
            put(TrimKind::Piping, Paint::Colour(cord.look.colour), Item::Cord(cord.clone()));
        }
        for button in &shapes.buttons {
            let look = button.look;
            if let Some(&place) = button.shown().filter(|place| is_laid(place)) {
                let thread = Paint::Colour(shade(look.colour, AROUND_BUTTON[1]));
                put(TrimKind::Button, Paint::Colour(look.colour), Item::Button(look, place));
                put(TrimKind::ButtonThread, thread, Item::ButtonThread(look, place));
            }
            if button.slit.len() > 1 && button.slit.iter().all(is_laid) {
                let around = Paint::Colour(shade(look.colour, AROUND_BUTTON[0]));
                put(TrimKind::Buttonhole, around, Item::Rods(slit(&button.slit)));
            }
        }
        let (rows, left_out) = rows(shapes, garment, state, most);
        for (kind, colour, rods) in rows {
            put(kind, Paint::Colour(colour), Item::Rods(rods));
        }
        for (piece, pairs) in &shapes.hems {
            let is_whole = |pair: &[FlatPlace; 2]| pair.iter().all(is_laid);
            for run in pairs.split(|pair| !is_whole(pair)).filter(|run| run.len() > 1) {
                put(TrimKind::Hem, Paint::Inside(*piece), Item::Hem(run.to_vec()));
            }
        }
        // How many vertices there are does not depend on the normals.
        let normals = vec![DVec3::Z; garment.vertex_count];
        let counted = |((kind, paint), items)| {
            let part = TrimPart { kind, paint, items, vertices: 0 };
            let vertices = part.solid(garment, state, &normals).positions.len();
            TrimPart { vertices, ..part }
        };
        let mut parts: Vec<TrimPart> = items.into_iter().map(counted).collect();
        parts.retain(|part| part.vertices > 0);
        Self { parts, left_out }
    }

    /// Number of vertices of all parts.
    pub fn vertices(&self) -> usize {
        self.parts.iter().map(|part| part.vertices).sum()
    }
}

impl TrimPart {
    /// The part on cloth in `state`, which has the same vertices on the body as the state for which it was made; `normals` are those
    /// of all vertices of the garment. All vertices have normals; there are no colours.
    pub fn solid(&self, garment: &Garment, state: &ClothState, normals: &[DVec3]) -> Solid {
        let cloth = Laid { garment, state, normals };
        let mut solid = Solid::default();
        for item in &self.items {
            let first = solid.triangles.len();
            match item {
                Item::Cord(cord) => cord.push(&mut solid, |v| cloth.vertex(v), 1.0),
                Item::Rods(rods) => rods.push(&mut solid, &cloth),
                Item::Button(look, place) => {
                    push_button(&mut solid, look, cloth.point(place), cloth.frame(place), 1.0);
                }
                Item::ButtonThread(look, place) => push_threads(&mut solid, look, place, &cloth),
                Item::Hem(pairs) => push_hem(&mut solid, &layer(pairs, &cloth), [0; 3]),
            }
            solid.complete_normals(first);
        }
        solid.colours.clear();
        solid
    }
}

fn push_threads(solid: &mut Solid, look: &Button, place: &FlatPlace, cloth: &Laid<'_>) {
    let frame = cloth.frame(place);
    let half = THREAD_THICKNESS / 2.0;
    let section = Section { half_width: half, half_height: half, sides: SIDES[0] };
    for thread in push_button(&mut Solid::default(), look, cloth.point(place), frame, 1.0) {
        solid.push_rod(&thread, &[frame[0]; 2], section);
    }
}

/// The layer of a hem as [`push_hem`] takes it.
fn layer(pairs: &[[FlatPlace; 2]], cloth: &Laid<'_>) -> Vec<[Vec3; 3]> {
    let on = |place: &FlatPlace| [cloth.point(place), cloth.normal(place)];
    pairs.iter().map(|[edge, inner]| hem_layer([on(edge), on(inner)], 1.0)).collect()
}

/// What edges a buttonhole.
fn slit(places: &[FlatPlace]) -> Rods {
    let section = Section { half_width: SLIT / 2.0, half_height: HALF_HEIGHTS[2], sides: SIDES[0] };
    Rods { places: places.to_vec(), dashes: vec![whole(places.len())], section }
}

/// A rod along the whole of a line of two points or more.
fn whole(points: usize) -> Vec<Station> {
    let start = Station { side: 0, share: 0.0 };
    let ends = (0..points.saturating_sub(1) as u32).map(|side| Station { side, share: 1.0 });
    std::iter::once(start).chain(ends).collect()
}

/// The rods of all rows with at most `most` vertices, and the number of rows that are left out.
fn rows(shapes: &TrimShapes, garment: &Garment, state: &ClothState, most: usize) -> (Vec<Painted>, usize) {
    let row = |(thread, places): &(Thread, Vec<FlatPlace>)| -> Vec<Painted> {
        let points: Vec<Option<Vec3>> =
            places.iter().map(|place| place.point(garment, state).map(|p| p.as_vec3())).collect();
        let mut rods = Vec::new();
        let mut first = 0;
        for run in points.split(Option::is_none) {
            let line: Vec<Vec3> = run.iter().flatten().copied().collect();
            if line.len() > 1 {
                rods.extend(threads(&places[first..first + line.len()], &line, *thread));
            }
            first += run.len() + 1;
        }
        rods
    };
    let mut rows: Vec<Vec<Painted>> = shapes.rows.iter().map(row).filter(|row| !row.is_empty()).collect();
    let count = |rods: &[Painted]| -> usize { rods.iter().map(|(_, _, rods)| rods.vertices()).sum() };
    if rows.iter().map(|row| count(row)).sum::<usize>() > most {
        rows.iter_mut().flatten().for_each(|(_, _, rods)| rods.section.sides = SIDES[1]);
    }
    let mut left = most;
    let kept = rows.iter().take_while(|row| {
        let after = left.checked_sub(count(row));
        left = after.unwrap_or_default();
        after.is_some()
    });
    let kept = kept.count();
    let left_out = rows.len() - kept;
    (rows.into_iter().take(kept).flatten().collect(), left_out)
}

/// The rods of a row of stitches through `places`, which are at `points`.
fn threads(places: &[FlatPlace], points: &[Vec3], thread: Thread) -> Vec<Painted> {
    let rods = |[half_width, half_height]: [f32; 2], dashes: Vec<Vec<Station>>| {
        let section = Section { half_width, half_height, sides: SIDES[0] };
        Rods { places: places.to_vec(), dashes, section }
    };
    let [stitch, line] = STITCH_SHARES.map(|share| [THREAD_THICKNESS * share / 2.0; 2]);
    match thread {
        Thread::Stitches { length, colour } => {
            let length = length as f32;
            let dashes = dash_stations(points, length * (1.0 - GAP), length * GAP);
            vec![(TrimKind::Stitches, colour, rods(stitch, dashes))]
        }
        Thread::Line { colour } => {
            vec![(TrimKind::Stitches, colour, rods(line, vec![whole(points.len())]))]
        }
        Thread::Teeth { colour } => {
            let [tooth, gap, width] = TOOTH;
            let [high, flat, _] = HALF_HEIGHTS;
            let tape = rods([width * TAPE_WIDTH / 2.0, flat], vec![whole(points.len())]);
            let teeth = rods([width / 2.0, high], dash_stations(points, tooth, gap));
            vec![(TrimKind::ZipTape, shade(colour, TAPE), tape), (TrimKind::ZipTeeth, colour, teeth)]
        }
    }
}

#[cfg(test)]
#[path = "trim_parts_tests.rs"]
mod tests;
