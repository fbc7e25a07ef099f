//! Reads and writes meshes as Wavefront OBJ text.
//!
//! Reading has two layers. The first is our own: it goes over the text once, checks every number and index, names the line of a
//! fault, and rewrites `v` and `f` statements in their plainest form, which the crate tobj then reads. Groups, texture
//! coordinates, normals and materials are not read; files that the text names are never opened.

use std::fmt::Write as _;

use glam::DVec3;

use crate::cloth::{ClothState, Garment, Wedges};
use crate::geometry::mesh::TriMesh;
use crate::geometry::words::{Words, within_quotes, words};
use crate::io::Limits;
use crate::io::atlas::Atlas;
use crate::io::dressed::{Dressed, TrimArrays};
use crate::io::mtl::MaterialFile;
use crate::io::normals::Normals;
use crate::io::polygon;
use crate::io::words::line;
use crate::pattern::Pattern;

/// Budget of corner tests for ear clipping, for all concave faces of a file together; about half a second.
const EAR_TESTS: usize = 100_000_000;

/// Why a file is not a usable mesh.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.words())]
pub enum ObjError {
    /// A fault in one line.
    Line {
        /// Line number, from 1.
        line: usize,
        /// What is wrong.
        words: Words,
    },
    /// A fault of the whole file.
    File(Words),
    /// The file exceeds one of the [`Limits`]; the text names it.
    OverLimit(Words),
}

impl ObjError {
    /// The error in words.
    pub fn words(&self) -> Words {
        match self {
            Self::Line { line: number, words } => line(*number).and(": ", words.clone()),
            Self::File(words) => words.clone(),
            Self::OverLimit(what) => words!("over the limit: {what}", what),
        }
    }
}

/// Counts of what was left out or corrected while reading.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ObjNotes {
    /// Faces with fewer than three different corners; dropped.
    pub degenerate_faces: usize,
    /// Faces with more than three corners; they are triangulated.
    pub polygons: usize,
    /// Polygons (of those counted in `polygons`) that are not convex; they are triangulated by ear clipping.
    pub concave_polygons: usize,
    /// Objects and groups; all are read as one mesh.
    pub groups: usize,
    /// Lines that are no OBJ statement; they are skipped.
    pub unknown_lines: usize,
    /// The first line that is no OBJ statement: its number, from 1, and its first word.
    pub first_unknown: Option<(usize, String)>,
}

/// A mesh read from an OBJ file: vertices in the order and unit of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjMesh {
    /// Vertices in the file's unit, including those that no face uses.
    pub mesh: TriMesh,
    /// What was left out or corrected while reading.
    pub notes: ObjNotes,
}

/// Reads a mesh and triangulates its faces.
pub fn read(bytes: &[u8]) -> Result<ObjMesh, ObjError> {
    let limits = Limits::default();
    if bytes.len() > limits.file_bytes {
        let most = limits.file_bytes;
        return Err(ObjError::OverLimit(words!("the file has more than {most} bytes", most)));
    }
    if let Some(at) = bytes.iter().position(|&b| b == 0) {
        let words = words!("this is a binary file, no OBJ text (a zero at byte {n})", n = at);
        return Err(ObjError::File(words));
    }
    let mut scan = Scan::new(&limits);
    scan.read_all(bytes)?;
    scan.finish()
}

/// The first layer of reading: checks each statement and rewrites it for tobj.
struct Scan<'a> {
    limits: &'a Limits,
    vertices: usize,
    faces: usize,
    /// Largest vertex index used by a face, from 1, and its line.
    largest: (usize, usize),
    vertex_text: String,
    face_text: String,
    notes: ObjNotes,
    corners: Vec<usize>,
}

impl<'a> Scan<'a> {
    fn new(limits: &'a Limits) -> Self {
        Self {
            limits,
            vertices: 0,
            faces: 0,
            largest: (0, 0),
            vertex_text: String::new(),
            face_text: String::new(),
            notes: ObjNotes::default(),
            corners: Vec::new(),
        }
    }

    fn read_all(&mut self, bytes: &[u8]) -> Result<(), ObjError> {
        let mut rest = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let (mut line, mut joined) = (0, Vec::new());
        let mut first_of_joined = 1;
        while !rest.is_empty() {
            let (text, after) = split_line(rest);
            rest = after;
            line += 1;
            if text.len() + joined.len() > self.limits.line_bytes {
                let most = self.limits.line_bytes;
                let words = words!("line {number} has more than {most} bytes", number = line, most);
                return Err(ObjError::OverLimit(words));
            }
            if let Some(begun) = text.strip_suffix(b"\\") {
                if joined.is_empty() {
                    first_of_joined = line;
                }
                joined.extend_from_slice(begun);
                joined.push(b' ');
            } else if joined.is_empty() {
                self.statement(line, text)?;
            } else {
                joined.extend_from_slice(text);
                self.statement(first_of_joined, &joined)?;
                joined.clear();
            }
        }
        self.statement(first_of_joined, &joined)
    }

    fn statement(&mut self, line: usize, text: &[u8]) -> Result<(), ObjError> {
        // Only names and comments may be in another encoding than UTF-8, and they are not read.
        let text = String::from_utf8_lossy(text);
        let text = text.split('#').next().unwrap_or_default();
        let mut words = text.split_whitespace();
        let Some(keyword) = words.next() else {
            return Ok(());
        };
        let fault = |words: Words| ObjError::Line { line, words };
        match keyword {
            "v" if self.vertices == self.limits.vertices => {
                let words = words!("more than {most} vertices", most = self.limits.vertices);
                Err(over(line, words))
            }
            "v" => self.vertex(words).map_err(fault),
            "f" | "fo" => self.face(line, words),
            "o" | "g" => self.group(line),
            _ if is_statement(keyword) => Ok(()),
            _ => {
                self.notes.unknown_lines += 1;
                if self.notes.first_unknown.is_none() {
                    let word = keyword.chars().filter(|c| !c.is_control()).take(20).collect();
                    self.notes.first_unknown = Some((line, word));
                }
                Ok(())
            }
        }
    }

    fn vertex<'t>(&mut self, mut words: impl Iterator<Item = &'t str>) -> Result<(), Words> {
        let mut numbers = [""; 3];
        for slot in &mut numbers {
            let word = words.next().ok_or_else(|| words!("a vertex needs three numbers"))?;
            coordinate(word)?;
            *slot = word;
        }
        self.vertices += 1;
        let [x, y, z] = numbers;
        // tobj collects only vertices that a face uses, in the order of use. A face of one corner per vertex keeps all of them,
        // in the order of the file.
        let _ = writeln!(self.vertex_text, "v {x} {y} {z}\nf {}", self.vertices);
        Ok(())
    }

    fn face<'t>(&mut self, line: usize, words: impl Iterator<Item = &'t str>) -> Result<(), ObjError> {
        let mut corners = std::mem::take(&mut self.corners);
        corners.clear();
        for word in words {
            if corners.len() == self.limits.face_corners {
                let most = self.limits.face_corners;
                return Err(over(line, words!("a face with more than {most} corners", most)));
            }
            let corner = self.corner(word).map_err(|words| ObjError::Line { line, words })?;
            if corner > self.largest.0 {
                self.largest = (corner, line);
            }
            corners.push(corner);
        }
        corners.dedup();
        if corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
        if corners.len() < 3 {
            self.notes.degenerate_faces += 1;
        } else {
            self.faces += corners.len() - 2;
            if self.faces > self.limits.faces {
                let words = words!("more than {most} triangles", most = self.limits.faces);
                return Err(ObjError::OverLimit(words));
            }
            self.face_text.push('f');
            for corner in &corners {
                let _ = write!(self.face_text, " {corner}");
            }
            self.face_text.push('\n');
        }
        self.corners = corners;
        Ok(())
    }

    /// The vertex index of a face corner, from 1. Negative indices count back from the last vertex read.
    fn corner(&self, word: &str) -> Result<usize, Words> {
        let index = word.split('/').next().unwrap_or_default();
        let wrong = || words!("\"{word}\" is no vertex index", word = within_quotes(&short(word)));
        let number: i64 = index.parse().map_err(|_| wrong())?;
        if number == 0 {
            return Err(words!("vertex index 0: indices begin with 1"));
        }
        if number > 0 {
            return usize::try_from(number).map_err(|e| Words::plain(e.to_string()));
        }
        let back = usize::try_from(number.unsigned_abs()).map_err(|e| Words::plain(e.to_string()))?;
        (self.vertices + 1).checked_sub(back).filter(|&v| v > 0).ok_or_else(|| {
            let count = self.vertices;
            words!("vertex index {number} is out of range: {count} vertices were read so far", number, count)
        })
    }

    fn group(&mut self, line: usize) -> Result<(), ObjError> {
        self.notes.groups += 1;
        if self.notes.groups > self.limits.groups {
            let most = self.limits.groups;
            return Err(over(line, words!("more than {most} groups", most)));
        }
        Ok(())
    }

    fn finish(self) -> Result<ObjMesh, ObjError> {
        if self.vertices == 0 || self.faces == 0 {
            return Err(ObjError::File(self.nothing_to_read()));
        }
        let (largest, line) = self.largest;
        if largest > self.vertices {
            let words = words!(
                "vertex index {number} is out of range: the file has {count} vertices",
                number = largest,
                count = self.vertices
            );
            return Err(ObjError::Line { line, words });
        }
        let text = self.vertex_text + &self.face_text;
        let (mesh, arities) = load(&text)?;
        let mut notes = self.notes;
        let mesh = triangulated(mesh, &arities, &mut notes)?;
        if mesh.triangles.is_empty() {
            return Err(ObjError::File(words!("every face of the file is degenerate")));
        }
        Ok(ObjMesh { mesh, notes })
    }

    fn nothing_to_read(&self) -> Words {
        let what = match (self.vertices, self.notes.degenerate_faces) {
            (0, 0) => words!("the file has no vertices and no faces (no \"v\" and no \"f\" lines)"),
            (0, _) => words!("the file has no vertices (no \"v\" lines)"),
            (n, 0) => words!("the file has {n} vertices but no faces (no \"f\" lines)", n),
            (_, n) => words!("all {n} faces of the file are degenerate", n),
        };
        match &self.notes.first_unknown {
            None => what,
            Some((line, word)) => words!(
                "this is no OBJ mesh: {what}; line {number} begins with \"{word}\", which is no OBJ statement",
                what,
                number = line,
                word = within_quotes(word)
            ),
        }
    }
}

/// The error for what exceeds a limit in line `number`, from 1.
fn over(number: usize, words: Words) -> ObjError {
    ObjError::OverLimit(line(number).and(": ", words))
}

/// Splits off the first line, without its line end, from the rest. Line ends are LF, CR LF and CR.
fn split_line(bytes: &[u8]) -> (&[u8], &[u8]) {
    let Some(end) = bytes.iter().position(|&b| b == b'\n' || b == b'\r') else {
        return (bytes, &[]);
    };
    let after = &bytes[end + 1..];
    let after = if bytes[end] == b'\r' { after.strip_prefix(b"\n").unwrap_or(after) } else { after };
    (&bytes[..end], after)
}

/// Whether `keyword` begins an OBJ statement other than `v`, `f`, `o` and `g`.
fn is_statement(keyword: &str) -> bool {
    const KNOWN: [&str; 39] = [
        "vt",
        "vn",
        "vp",
        "l",
        "p",
        "s",
        "mg",
        "usemtl",
        "usemap",
        "mtllib",
        "maplib",
        "bevel",
        "c_interp",
        "d_interp",
        "lod",
        "shadow_obj",
        "trace_obj",
        "ctech",
        "stech",
        "cstype",
        "deg",
        "bmat",
        "step",
        "curv",
        "curv2",
        "surf",
        "parm",
        "trim",
        "hole",
        "scrv",
        "sp",
        "end",
        "con",
        "call",
        "csh",
        "bsp",
        "bzp",
        "cdc",
        "res",
    ];
    KNOWN.contains(&keyword)
}

fn coordinate(word: &str) -> Result<f64, Words> {
    /// Largest absolute coordinate, in the file's unit; a larger body is not one in any unit.
    const LARGEST: f64 = 1e9;
    let value = || within_quotes(&short(word));
    match word.parse::<f64>() {
        Ok(x) if x.is_nan() => Err(words!("a coordinate is not a number (NaN)")),
        Ok(x) if x.is_infinite() => Err(words!("the coordinate \"{value}\" is infinite", value = value())),
        Ok(x) if x.abs() > LARGEST => {
            Err(words!("the coordinate {number} is out of range", number = format!("{x:e}")))
        }
        Ok(x) => Ok(x),
        Err(_) if word.replace(',', ".").parse::<f64>().is_ok() => {
            Err(words!("\"{value}\" has a decimal comma; OBJ has decimal points", value = value()))
        }
        Err(_) => Err(words!("\"{value}\" is no number", value = value())),
    }
}

fn short(word: &str) -> String {
    word.chars().take(40).collect()
}

/// Lets tobj read the checked text; returns the mesh and the number of corners of each face.
fn load(text: &str) -> Result<(tobj::Mesh, Vec<u32>), ObjError> {
    let options = tobj::LoadOptions { ignore_lines: true, ..tobj::LoadOptions::default() };
    let mut reader = std::io::BufReader::new(text.as_bytes());
    let loaded = tobj::load_obj_buf(&mut reader, &options, |_| Err(tobj::LoadError::OpenFileFailed));
    let unread = |why: String| ObjError::File(words!("the file cannot be read: {why}", why));
    let (models, _) = loaded.map_err(|e| unread(e.to_string()))?;
    let [model] = <[tobj::Model; 1]>::try_from(models)
        .map_err(|models| ObjError::File(words!("{n} meshes where one was written", n = models.len())))?;
    let mut mesh = model.mesh;
    let arities = std::mem::take(&mut mesh.face_arities);
    Ok((mesh, arities))
}

fn triangulated(mesh: tobj::Mesh, arities: &[u32], notes: &mut ObjNotes) -> Result<TriMesh, ObjError> {
    let positions: Vec<DVec3> = mesh.positions.chunks_exact(3).map(DVec3::from_slice).collect();
    let mut triangles = Vec::new();
    let mut budget = EAR_TESTS;
    let mut start = 0;
    for &arity in arities {
        let corners = &mesh.indices[start..start + arity as usize];
        start += arity as usize;
        match *corners {
            [_] | [_, _] => {}
            [a, b, c] => triangles.push([a, b, c]),
            _ => {
                let points: Vec<DVec3> = corners.iter().map(|&v| positions[v as usize]).collect();
                let cut = polygon::triangles(&points, &mut budget)
                    .ok_or_else(|| ObjError::OverLimit(words!("its concave faces take too long to cut")))?;
                notes.polygons += 1;
                notes.concave_polygons += usize::from(cut.concave);
                triangles.extend(cut.triangles.iter().map(|t| t.map(|k| corners[k])));
            }
        }
    }
    let all = triangles.len();
    triangles.retain(|&[a, b, c]| a != b && b != c && c != a);
    notes.degenerate_faces += all - triangles.len();
    Ok(TriMesh { positions, triangles })
}

/// Materials that an OBJ file names.
#[derive(Clone, Copy, Debug)]
pub struct UsedMaterials<'a> {
    /// The materials.
    pub file: &'a MaterialFile,
    /// Name of the file they are in.
    pub file_name: &'a str,
    /// Texture coordinates; None: the pattern plane in metres.
    pub atlas: Option<&'a Atlas>,
}

/// Writes the draped garment: one object per piece, sewn vertices shared, `v` in metres, `vt` the pattern plane in metres and `vn`
/// the unit normals, both separate for each piece; the normals of both sides of a seam or fold line differ where it is folded
/// sharply. Triangles with a vertex that is not yet placed on the body are left out.
pub fn garment(garment: &Garment, state: &ClothState, pattern: &Pattern) -> String {
    let dressed = Dressed { garment, state, pattern, trims: &[] };
    let (laid, wedges) = (dressed.laid(), Wedges::new(garment));
    let normals = Normals::new(garment, &wedges, &state.positions, &laid);
    cloth(&dressed, &laid, (&wedges, &normals), None)
}

/// Writes the draped garment like [`garment`], with materials, and after its pieces its trims: one object for each kind and colour,
/// without texture coordinates.
pub fn garment_with(dressed: &Dressed<'_>, materials: UsedMaterials<'_>) -> String {
    let (laid, wedges) = (dressed.laid(), Wedges::new(dressed.garment));
    let normals = Normals::new(dressed.garment, &wedges, &dressed.state.positions, &laid);
    let mut text = cloth(dressed, &laid, (&wedges, &normals), Some(materials));
    let mut first = dressed.state.positions.len() as u32 + 1;
    let mut first_normal = normals.wedges.len() as u32 + 1;
    for (part, name) in dressed.trims.iter().zip(&materials.file.trims) {
        let TrimArrays { positions, normals, triangles } = TrimArrays::new(dressed, part, &normals);
        positions.iter().for_each(|p| write_vertex(&mut text, *p));
        normals.iter().for_each(|n| write_normal(&mut text, *n));
        let _ = writeln!(text, "o {}\nusemtl {name}", object_name(name));
        for t in triangles {
            text.push('f');
            for v in t {
                let _ = write!(text, " {}//{}", first + v, first_normal + v);
            }
            text.push('\n');
        }
        first += positions.len() as u32;
        first_normal += normals.len() as u32;
    }
    text
}

/// The cloth alone, of the triangles with the indices `laid`.
fn cloth(
    dressed: &Dressed<'_>,
    laid: &[usize],
    (wedges, normals): (&Wedges, &Normals),
    materials: Option<UsedMaterials<'_>>,
) -> String {
    let Dressed { garment, state, pattern, trims: _ } = *dressed;
    let atlas = materials.and_then(|used| used.atlas);
    let mut text = match atlas {
        None => String::from("# garment; v in metres, vt in metres of the pattern plane\n"),
        Some(_) => String::from("# garment; v in metres, vt in the textures\n"),
    };
    if let Some(used) = materials {
        let _ = writeln!(text, "mtllib {}", used.file_name);
    }
    for p in &state.positions {
        write_vertex(&mut text, *p);
    }
    for corner in &garment.corners {
        let pose = pattern.pieces.get(&corner.piece).map(|piece| piece.pose).unwrap_or_default();
        let p = match atlas {
            None => pose.plane_from_piece(corner.uv),
            Some(atlas) => atlas.uv(corner.piece, corner.uv),
        };
        let _ = writeln!(text, "vt {:.9} {:.9}", p.x, p.y);
    }
    normals.wedges.iter().for_each(|n| write_normal(&mut text, *n));
    for (id, name) in &garment.pieces {
        let _ = writeln!(text, "o {}", object_name(name));
        if let Some(material) = materials.and_then(|used| used.file.names.get(id)) {
            let _ = writeln!(text, "usemtl {material}");
        }
        for &t in laid.iter().filter(|&&t| garment.triangle_pieces[t] == *id) {
            text.push('f');
            let flat = garment.triangle_corners[t].iter().zip(&wedges.triangles[t]);
            for (v, (corner, wedge)) in garment.triangles[t].iter().zip(flat) {
                let _ = write!(text, " {}/{}/{}", v + 1, corner + 1, wedge + 1);
            }
            text.push('\n');
        }
    }
    text
}

/// Writes a plain mesh in metres as one object.
pub fn mesh(name: &str, mesh: &TriMesh) -> String {
    let mut text = format!("# metres\no {}\n", object_name(name));
    for p in &mesh.positions {
        write_vertex(&mut text, *p);
    }
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|v| v + 1);
        let _ = writeln!(text, "f {a} {b} {c}");
    }
    text
}

fn write_vertex(text: &mut String, p: DVec3) {
    let _ = writeln!(text, "v {:.9} {:.9} {:.9}", p.x, p.y, p.z);
}

fn write_normal(text: &mut String, n: DVec3) {
    let _ = writeln!(text, "vn {:.6} {:.6} {:.6}", n.x, n.y, n.z);
}

fn object_name(name: &str) -> String {
    let name: String =
        name.trim().chars().map(|c| if c.is_control() || c.is_whitespace() { '_' } else { c }).collect();
    if name.is_empty() { "piece".to_owned() } else { name }
}

#[cfg(test)]
#[path = "obj_tests.rs"]
mod tests;
