//! The scene file of `toile simulate`, read and checked.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

use crate::body::Surface;
use crate::cli::failure::Failure;
use crate::cli::files;
use crate::cloth::{Fabric, GRAVITY};
use crate::drape::forces::bands::Bands;
use crate::drape::forces::folds::Folds;
use crate::drape::{Elastic, Integrator, Method, Scene, Sheet};
use crate::geometry::mesh::TriMesh;
use crate::io::obj::ObjError;
use crate::io::{cloth_obj, obj};
use crate::pattern::{self, Fold};

/// Stiffness of the membrane under compression relative to its stiffness under tension.
const COMPRESSION: f64 = 0.1;
/// Largest number of frames of a scene.
const MOST_FRAMES: f64 = 100_000.0;

/// The contents of a scene file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneFile {
    cloth: PathBuf,
    #[serde(default)]
    pins: Vec<usize>,
    #[serde(default)]
    seams: Vec<[usize; 2]>,
    /// Fold lines.
    #[serde(default)]
    folds: Vec<FoldLine>,
    /// Elastic.
    #[serde(default)]
    elastics: Vec<ElasticLine>,
    #[serde(default)]
    collider: Option<Colliders>,
    #[serde(default)]
    fabric: Option<FabricChoice>,
    #[serde(default)]
    density_kg_per_m2: Option<f64>,
    #[serde(default = "gravity")]
    gravity: [f64; 3],
    pub seconds: f64,
    #[serde(default = "fps")]
    pub fps: f64,
    #[serde(default)]
    pub self_collision: bool,
    #[serde(default)]
    thickness_m: Option<f64>,
    /// Strain limit, in addition to the fabric's own strain; 0.01 when left out.
    #[serde(default)]
    pub strain: Option<f64>,
    /// The solver; chosen by the program when left out.
    #[serde(default)]
    pub solver: Option<SolverChoice>,
    /// Number of implicit steps per frame.
    #[serde(default = "one")]
    pub steps_per_frame: u32,
    #[serde(default)]
    pub integrator: Option<IntegratorChoice>,
    /// The membrane model of implicit steps; small steps always have springs.
    #[serde(default)]
    pub membrane: MembraneChoice,
}

/// A fold line along edges of the cloth.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct FoldLine {
    /// The vertices that it leads through, from 0.
    vertices: Vec<usize>,
    /// Angle at rest, -180..=180, positive towards the front of the cloth.
    angle_degrees: f64,
    /// Moment per length and radian, N; that of a pressed crease when left out.
    #[serde(default)]
    strength: Option<f64>,
}

/// Elastic along edges of the cloth.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ElasticLine {
    /// The vertices that it leads through, from 0.
    vertices: Vec<usize>,
    /// Length at rest as a share of that of the cloth, 0.3..=1.
    ratio: f64,
    /// Force at double length, N; that of a waistband when left out.
    #[serde(default)]
    tension: Option<f64>,
}

#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum Colliders {
    One(PathBuf),
    Frames(Vec<PathBuf>),
}

#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum FabricChoice {
    Preset(String),
    Own(Fabric),
}

/// The solver.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SolverChoice {
    Implicit,
    SmallSteps,
}

/// The membrane model, which resists stretching.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum MembraneChoice {
    /// Constant-strain triangles.
    #[default]
    Triangles,
    /// A spring along every edge (paper B).
    Springs,
}

/// The time integrator of implicit steps.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum IntegratorChoice {
    Euler,
    Bdf2,
}

impl From<SolverChoice> for Method {
    fn from(choice: SolverChoice) -> Self {
        match choice {
            SolverChoice::Implicit => Self::Implicit,
            SolverChoice::SmallSteps => Self::SmallSteps,
        }
    }
}

impl From<IntegratorChoice> for Integrator {
    fn from(choice: IntegratorChoice) -> Self {
        match choice {
            IntegratorChoice::Euler => Self::Euler,
            IntegratorChoice::Bdf2 => Self::Bdf2,
        }
    }
}

fn gravity() -> [f64; 3] {
    GRAVITY.to_array()
}

fn fps() -> f64 {
    60.0
}

fn one() -> u32 {
    1
}

/// A loaded scene.
pub struct Loaded {
    pub file: SceneFile,
    pub scene: Scene,
    pub positions: Vec<DVec3>,
    pub fabric: Fabric,
    /// Distance that the cloth keeps from bodies and from itself, metres.
    pub thickness: f64,
    /// The body in each frame; a single one stays in place, and the list may be empty.
    pub bodies: Vec<TriMesh>,
}

impl SceneFile {
    /// Number of frames after the start.
    pub fn frames(&self) -> usize {
        (self.seconds * self.fps).round() as usize
    }

    fn problem(&self) -> Option<String> {
        let range = |what: &str, value: f64, most: f64| {
            (!(value > 0.0 && value <= most))
                .then(|| format!("{what} is {value}, not above 0 and at most {most}"))
        };
        range("seconds", self.seconds, 1e5)
            .or_else(|| range("fps", self.fps, 1e5))
            .or_else(|| range("seconds times fps", self.seconds * self.fps, MOST_FRAMES))
            .or_else(|| range("strain", self.strain.unwrap_or(0.01), 0.5))
            .or_else(|| range("steps_per_frame", f64::from(self.steps_per_frame), 1e4))
            .or_else(|| {
                let known = self.gravity.iter().all(|g| g.is_finite() && g.abs() <= 1e4);
                (!known).then(|| "gravity is not three numbers within ±10000 m/s²".to_owned())
            })
            .or_else(|| {
                (!self.seams.is_empty()).then(|| "seams cannot be sewn here yet: leave them out".to_owned())
            })
    }
}

/// Reads the scene at `path` and the files it names, relative to its folder.
pub fn load(path: &Path) -> Result<Loaded, Failure> {
    let file: SceneFile = serde_json::from_slice(&files::read(path)?).map_err(|e| Failure::input(path, e))?;
    if let Some(words) = file.problem() {
        return Err(Failure::input(path, words));
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    let fabric = fabric_of(&file).map_err(|words| Failure::input(path, words))?;
    let place = folder.join(&file.cloth);
    let cloth = cloth_obj::read(&files::read(&place)?).map_err(|e| obj_failure(&place, e))?;
    let positions = cloth.mesh.positions.clone();
    let flat = || (0..cloth.mesh.triangles.len()).map(|t| laid_flat(cloth.mesh.corners(t))).collect();
    let rest = cloth.rest.clone().unwrap_or_else(flat);
    let sheet = Sheet::new(positions.len(), cloth.mesh.triangles.clone(), rest)
        .map_err(|e| Failure::input(&place, e))?;
    let mut pinned = vec![false; positions.len()];
    for &pin in &file.pins {
        let Some(held) = pinned.get_mut(pin) else {
            let words = format!("pin {pin}: the cloth has vertices 0 to {}", positions.len() - 1);
            return Err(Failure::input(path, words));
        };
        *held = true;
    }
    let bodies = bodies_of(&file, folder)?;
    let mass = sheet.vertex_area.iter().map(|a| a * fabric.density_kg_per_m2).collect();
    let (sheet, folds) = folded(sheet, &file.folds).map_err(|words| Failure::input(path, words))?;
    let mut elastic = match file.membrane {
        MembraneChoice::Triangles => Elastic::new(&sheet, &fabric, COMPRESSION),
        MembraneChoice::Springs => Elastic::of_springs(&sheet, &fabric),
    };
    elastic.folds = folds;
    elastic.bands = gathered(&sheet, &file.elastics).map_err(|words| Failure::input(path, words))?;
    let gravity = DVec3::from_array(file.gravity);
    let damping = fabric.damping_per_s;
    let scene = Scene { sheet, elastic, mass, pinned, gravity, damping, collider: None };
    let thickness = file.thickness_m.unwrap_or(fabric.thickness_m);
    Ok(Loaded { file, scene, positions, fabric, thickness, bodies })
}

/// The sheet creased along `lines`, and these folds. The error is in words.
fn folded(sheet: Sheet, lines: &[FoldLine]) -> Result<(Sheet, Folds), String> {
    let mut edges = Vec::new();
    for (number, line) in lines.iter().enumerate() {
        let fold =
            Fold { angle: line.angle_degrees.to_radians(), strength: line.strength.unwrap_or(Fold::PRESSED) };
        if let Some(words) = fold.problem() {
            return Err(format!("fold {number}: {words}"));
        }
        let along = edges_along(&sheet, &line.vertices).map_err(|words| format!("fold {number}: {words}"))?;
        edges.extend(along.into_iter().map(|ends| (ends, fold.angle, fold.strength)));
    }
    let sheet = sheet.creased(edges.iter().map(|(ends, ..)| *ends));
    let folds = Folds::new(&sheet, edges);
    Ok((sheet, folds))
}

/// The elastic along `lines`. The error is in words.
fn gathered(sheet: &Sheet, lines: &[ElasticLine]) -> Result<Bands, String> {
    let mut edges = Vec::new();
    for (number, line) in lines.iter().enumerate() {
        let tension = line.tension.unwrap_or(pattern::Elastic::WAISTBAND);
        let elastic = pattern::Elastic { ratio: line.ratio, tension };
        if let Some(words) = elastic.problem() {
            return Err(format!("elastic {number}: {words}"));
        }
        let along =
            edges_along(sheet, &line.vertices).map_err(|words| format!("elastic {number}: {words}"))?;
        edges.extend(along.into_iter().map(|ends| (ends, elastic.ratio, elastic.tension)));
    }
    Ok(Bands::new(sheet, edges))
}

/// The edges that lead through `vertices`. The error is in words.
fn edges_along(sheet: &Sheet, vertices: &[usize]) -> Result<Vec<[u32; 2]>, String> {
    let edge = |pair: &[usize]| {
        let ends = [pair[0], pair[1]].map(|v| u32::try_from(v).unwrap_or(u32::MAX));
        let is_known = ends.iter().all(|&v| (v as usize) < sheet.len());
        let found = is_known.then(|| sheet.edge_between(ends)).flatten();
        let words = || format!("no edge of the cloth joins the vertices {} and {}", pair[0], pair[1]);
        found.map(|_| ends).ok_or_else(words)
    };
    vertices.windows(2).map(edge).collect()
}

/// The corners of a triangle in its own plane, with its first side along x.
fn laid_flat([a, b, c]: [DVec3; 3]) -> [DVec2; 3] {
    let (u, w) = (b - a, c - a);
    let along = u.normalize_or_zero();
    let up = u.cross(w).cross(along).normalize_or_zero();
    [DVec2::ZERO, DVec2::new(u.length(), 0.0), DVec2::new(w.dot(along), w.dot(up))]
}

fn fabric_of(file: &SceneFile) -> Result<Fabric, String> {
    let mut fabric = match &file.fabric {
        None => Fabric::preset("cotton").cloned().ok_or("there is no preset cotton")?,
        Some(FabricChoice::Own(fabric)) => fabric.clone(),
        Some(FabricChoice::Preset(name)) => Fabric::preset(name).cloned().ok_or_else(|| {
            let names: Vec<&str> = Fabric::presets().iter().map(|f| f.name.as_str()).collect();
            format!("there is no fabric {name:?}; there are {}", names.join(", "))
        })?,
    };
    if let Some(density) = file.density_kg_per_m2 {
        fabric.density_kg_per_m2 = density;
    }
    if let Some(thickness) = file.thickness_m {
        fabric.thickness_m = thickness;
    }
    match fabric.problem() {
        Some(words) => Err(words),
        None => Ok(fabric),
    }
}

fn bodies_of(file: &SceneFile, folder: &Path) -> Result<Vec<TriMesh>, Failure> {
    let paths = match &file.collider {
        None => return Ok(Vec::new()),
        Some(Colliders::One(path)) => std::slice::from_ref(path),
        Some(Colliders::Frames(paths)) => paths.as_slice(),
    };
    let mut bodies: Vec<TriMesh> = Vec::new();
    for path in paths {
        let place = folder.join(path);
        let body = obj::read(&files::read(&place)?).map_err(|e| obj_failure(&place, e))?.mesh;
        if bodies.first().is_some_and(|first| first.triangles != body.triangles) {
            return Err(Failure::input(&place, "its triangles are not those of the first collider"));
        }
        bodies.push(body);
    }
    Ok(bodies)
}

/// The surface of a body, with what contact needs.
pub fn surface(path: &Path, body: &TriMesh) -> Result<Arc<Surface>, Failure> {
    let surface = Surface::new(body.clone());
    surface.map(Arc::new).ok_or_else(|| Failure::input(path, "a collider has no surface"))
}

fn obj_failure(path: &Path, error: ObjError) -> Failure {
    match error {
        ObjError::OverLimit(_) => Failure::Limit(format!("{}: {error}", path.display())),
        _ => Failure::input(path, error),
    }
}
