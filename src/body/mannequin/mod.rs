//! The built-in mannequin: a dressmaker's full figure, made to measurements by our own formulas.
//!
//! `proportions` draws a figure as tables of sections, `figure` stretches them, `childhood` tells what differs on children, `field` joins them to one smooth skin,
//! `fit` corrects the stretch until the tape reads what was asked for, `polygonise` and `remesh` turn the skin's left
//! half into even triangles, which are mirrored. The same measurements give the same bits.

mod childhood;
mod counterpart;
mod editing;
mod field;
mod figure;
mod fit;
mod hand;
mod landmarks;
mod limits;
mod loft;
mod measurements;
mod partial;
mod polygonise;
mod proportions;
mod remesh;
mod smooth;
mod spline;

use std::sync::{Arc, Mutex, OnceLock};

use glam::DVec3;

pub use counterpart::Counterpart;
pub use limits::OutOfRange;
pub use measurements::Measurements;

use super::closest::closest_on_triangle;
use super::landmarks::Landmarks;
use super::measure::Tape;
use super::skeleton::Skeleton;
use crate::geometry::mesh::TriMesh;
use crate::geometry::words::{Words, words};
use field::Field;
use figure::Figure;
use polygonise::Grid;

/// Edge length on trunk and limbs, metres on a figure of default height.
const EDGE: f64 = 0.0150;
/// Edge length on fingers, metres on a figure of default height.
const FINGER_EDGE: f64 = 0.0050;

/// A body built to measurements.
#[derive(Clone, Debug, PartialEq)]
pub struct Mannequin {
    /// The skin: closed, manifold, facing outward, symmetric in x; feet on y = 0, facing +z, metres.
    pub mesh: TriMesh,
    /// The skeleton in the pose it was built in.
    pub skeleton: Skeleton,
    /// Landmarks on the skin.
    pub landmarks: Landmarks,
    /// Tapes of its girths.
    pub tapes: Vec<Tape>,
    /// The measurements it was built from.
    pub measurements: Measurements,
}

/// Error: there is no such mannequin.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", self.words())]
pub enum MannequinError {
    /// A measurement that no body has.
    OutOfRange(OutOfRange),
    /// The figure could not reach all measurements at once.
    Unreachable,
}

impl MannequinError {
    /// The error in words.
    pub fn words(&self) -> Words {
        match self {
            Self::OutOfRange(error) => error.words(),
            Self::Unreachable => {
                words!("no figure has these measurements together: change the girths towards each other")
            }
        }
    }
}

impl From<OutOfRange> for MannequinError {
    fn from(error: OutOfRange) -> Self {
        Self::OutOfRange(error)
    }
}

/// The mannequin with measurements `m`. Cached: built once in a process for each set of measurements (the last eight are kept).
pub fn mannequin(m: &Measurements) -> Result<Arc<Mannequin>, MannequinError> {
    static KEPT: Mutex<Vec<Arc<Mannequin>>> = Mutex::new(Vec::new());
    if *m == Measurements::default() {
        return Ok(default());
    }
    let mut kept = KEPT.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
    if let Some(found) = kept.iter().find(|k| k.measurements == *m) {
        return Ok(found.clone());
    }
    let built = Arc::new(built(m)?);
    if kept.len() == 8 {
        kept.remove(0);
    }
    kept.push(built.clone());
    Ok(built)
}

/// The mannequin with the default measurements, built once in a process.
pub fn default() -> Arc<Mannequin> {
    static DEFAULT: OnceLock<Arc<Mannequin>> = OnceLock::new();
    DEFAULT
        .get_or_init(|| {
            Arc::new(built(&Measurements::default()).expect("the default measurements make a body"))
        })
        .clone()
}

/// Builds the mannequin with measurements `m`, without the cache.
pub fn built(m: &Measurements) -> Result<Mannequin, MannequinError> {
    m.check()?;
    let factors = fit::factors(m, wanted_edge).ok_or(MannequinError::Unreachable)?;
    let figure = Figure::new(factors);
    let field = Field::new(&figure);
    let half = polygonise::polygonised(&field, &grid(&figure));
    let half = remesh::remeshed(half, &field, |p| wanted_edge(&figure, p));
    let mesh = remesh::mirrored(&half);
    if !remesh::is_ball(&mesh) {
        return Err(MannequinError::Unreachable);
    }
    let landmarks = landmarks::landmarks(&figure, &field).map(|p| on_mesh(&mesh, p));
    let skeleton = landmarks::skeleton(&figure, &field);
    let tapes = landmarks::tapes(&figure, &field);
    Ok(Mannequin { mesh, skeleton, landmarks, tapes, measurements: *m })
}

/// Wanted edge length near `p`, metres: short on fingers, toes and face.
fn wanted_edge(figure: &Figure, p: DVec3) -> f64 {
    let k = figure.small();
    let [hip, bust] = [5, 8].map(|i| figure.factors.girth[i]);
    let plain = EDGE * (0.5 * (hip + bust) / k).sqrt();
    let q = DVec3::new(p.x.abs(), p.y, p.z) - figure.shoulder_joint();
    let beyond_forearm = (q.dot(figure.arm_direction()) - figure.along_arm(0.46)) / k;
    // A child's legs are further out than its shoulder joints.
    let beside = figure.factors.child.mixed(0.0, 0.10 * k);
    let arm = if q.x > beside { plain - 0.062 * beyond_forearm.max(0.0) } else { plain };
    let foot = 0.0085 + 0.05 * (p.y / k - 0.05).max(0.0);
    let face = if p.z > 0.0 { 0.010 - 0.03 * p.z } else { 0.010 };
    let face = face * figure.factors.child.head;
    let head = face + 0.06 * (figure.y(proportions::level::CHIN) - p.y).max(0.0) / k;
    k * arm.min(foot).min(head).clamp(FINGER_EDGE, plain)
}

/// The grid for polygonising: cells of 12 mm, 3.6 mm at the hands, so that fingers stay apart.
fn grid(figure: &Figure) -> Grid {
    let k = figure.small();
    let (coarse, fine) = (0.012 * k, 0.0036 * k);
    let wrist = figure.shoulder_joint() + figure.arm_direction() * figure.along_arm(0.60);
    let tips = figure.shoulder_joint() + figure.arm_direction() * figure.along_arm(0.79);
    let across = Grid::planes(0.0, tips.x + 0.05 * k, |x| if x > wrist.x - 0.02 { fine } else { coarse });
    let hands = tips.y - 0.01..wrist.y + 0.02;
    let up = Grid::planes(-0.03 * k, figure.y(proportions::level::CROWN) + 0.03 * k, |y| {
        if hands.contains(&y) { fine } else { coarse }
    });
    let palm = figure.shoulder_joint().z + 0.03 * k..figure.shoulder_joint().z + 0.16 * k;
    let deep = Grid::planes(-0.26 * k, 0.30 * k, |z| if palm.contains(&z) { fine } else { coarse });
    Grid { planes: [across, up, deep] }
}

/// The point of `mesh` nearest to `p`, by testing every triangle.
fn on_mesh(mesh: &TriMesh, p: DVec3) -> DVec3 {
    (0..mesh.triangles.len())
        .map(|t| {
            let [a, b, c] = mesh.corners(t);
            closest_on_triangle(p, a, b, c).0
        })
        .min_by(|a, b| a.distance_squared(p).total_cmp(&b.distance_squared(p)))
        .unwrap_or(p)
}

#[cfg(test)]
mod tests;
