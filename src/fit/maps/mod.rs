//! Maps over dressed cloth: a scalar for each triangle and each vertex, computed on demand.

mod curvature;
mod kind;
mod pressure;
mod stats;
mod strain;

#[cfg(test)]
pub(super) mod tests;

pub use kind::MapKind;
pub use stats::{Histogram, MapStats, PieceStats};

use std::cell::OnceCell;
use std::collections::BTreeMap;

use glam::DVec3;
use rayon::prelude::*;

use crate::body::{Nearest, Surface};
use crate::cloth::{ClothState, Fabric, Garment};
use crate::geometry::ids::PieceId;
use crate::geometry::parallel::LEAST_SHARE;
use crate::pattern::Pattern;

/// Values of a map; NaN where there is none: cloth that is not laid, borders where a curvature is undefined.
#[derive(Clone, Debug, PartialEq)]
pub struct Map {
    /// Quantity shown.
    pub kind: MapKind,
    /// A value per sewn vertex, in the unit of the kind.
    pub vertices: Vec<f64>,
    /// A value per triangle: its own where the kind has one, else the mean over its corners.
    pub triangles: Vec<f64>,
}

/// Dressed cloth with all that maps are computed from.
#[derive(Clone, Copy, Debug)]
pub struct Worn<'a> {
    /// Pattern of the garment; its pieces define the grain.
    pub pattern: &'a Pattern,
    /// The cloth.
    pub garment: &'a Garment,
    /// Positions of the cloth.
    pub state: &'a ClothState,
    /// The body.
    pub surface: &'a Surface,
    /// Fabric of each piece; pieces without one get no pressure.
    pub fabrics: &'a BTreeMap<PieceId, Fabric>,
    /// Offset from the skin that a wrap keeps, metres.
    pub offset: f64,
}

/// Computes several maps of the same cloth. What several kinds need is computed once: nearest points of the skin and how triangles are
/// deformed.
#[derive(Debug)]
pub struct MapReader<'a> {
    worn: Worn<'a>,
    skin: OnceCell<Vec<Option<Nearest>>>,
    images: OnceCell<Vec<Option<strain::Images>>>,
}

impl<'a> MapReader<'a> {
    /// A reader that has computed nothing yet.
    pub fn new(worn: Worn<'a>) -> Self {
        Self { worn, skin: OnceCell::new(), images: OnceCell::new() }
    }

    /// The map of `kind`. Same input, same bits, on any number of threads.
    pub fn map(&self, kind: MapKind) -> Map {
        let worn = self.worn;
        match kind {
            MapKind::Warp | MapKind::Weft | MapKind::Shear | MapKind::Area => {
                let images = self.images.get_or_init(|| strain::all_images(worn));
                Map::of_triangles(kind, worn, strain::strain(kind, images))
            }
            MapKind::Ease => Map::of_vertices(kind, worn, ease(self.skin())),
            MapKind::Curvature => Map::of_vertices(kind, worn, curvature::largest_angle(worn)),
            MapKind::MeanCurvature => Map::of_vertices(kind, worn, curvature::mean(worn)),
            MapKind::Seams => Map::of_vertices(kind, worn, strain::seams(worn)),
            MapKind::Pressure => Map::of_vertices(kind, worn, pressure::pressure(worn, self.skin())),
        }
    }

    /// Nearest point of the skin to each laid vertex.
    fn skin(&self) -> &[Option<Nearest>] {
        self.skin.get_or_init(|| {
            let places = &self.worn.state.positions;
            of_laid(self.worn, |v| self.worn.surface.nearest(places[v as usize]))
        })
    }
}

impl Map {
    /// The map of `kind` over `worn`, without sharing work with other maps.
    pub fn new(kind: MapKind, worn: Worn<'_>) -> Self {
        MapReader::new(worn).map(kind)
    }

    /// A map with values per triangle; vertices get the mean of their triangles, weighted by flat area.
    fn of_triangles(kind: MapKind, worn: Worn<'_>, triangles: Vec<f64>) -> Self {
        let garment = worn.garment;
        let mean = |v: u32| {
            let around = garment.adjacency.vertex_triangles.of(v).iter();
            let valued = around.map(|&t| t as usize).filter(|&t| triangles[t].is_finite());
            let (sum, weights) = valued.fold((0.0, 0.0), |(sum, weights), t| {
                let [a, b, c] = garment.rest[t];
                let area = (b - a).perp_dot(c - a) / 2.0;
                (sum + triangles[t] * area, weights + area)
            });
            if weights > 0.0 { sum / weights } else { f64::NAN }
        };
        let vertices = per_vertex(worn, mean);
        Self { kind, vertices, triangles }
    }

    fn of_vertices(kind: MapKind, worn: Worn<'_>, vertices: Vec<f64>) -> Self {
        Self::between(kind, worn.garment, vertices)
    }

    /// A map with values per vertex; triangles get the mean of their vertices.
    pub(super) fn between(kind: MapKind, garment: &Garment, vertices: Vec<f64>) -> Self {
        let mean = |vs: &[u32; 3]| vs.iter().map(|&v| vertices[v as usize]).sum::<f64>() / 3.0;
        Self { kind, triangles: garment.triangles.iter().map(mean).collect(), vertices }
    }
}

/// A value for each laid vertex, NaN for the others.
fn per_vertex(worn: Worn<'_>, value: impl Fn(u32) -> f64 + Sync) -> Vec<f64> {
    of_laid(worn, value).into_iter().map(|value| value.unwrap_or(f64::NAN)).collect()
}

/// The result of `tell` for each laid vertex, None for the others.
fn of_laid<T: Send>(worn: Worn<'_>, tell: impl Fn(u32) -> T + Sync) -> Vec<Option<T>> {
    let laid = |v: u32| worn.state.mapped.get(v as usize) == Some(&true);
    (0..worn.garment.vertex_count as u32)
        .into_par_iter()
        .with_min_len(LEAST_SHARE)
        .map(|v| laid(v).then(|| tell(v)))
        .collect()
}

/// Positions of the corners of triangle `t`; None where one of them is not laid.
fn laid_corners(worn: Worn<'_>, t: usize) -> Option<[DVec3; 3]> {
    let vs = worn.garment.triangles[t];
    let laid = vs.iter().all(|&v| worn.state.mapped.get(v as usize) == Some(&true));
    laid.then(|| vs.map(|v| worn.state.positions[v as usize]))
}

/// Ease: distance from the body, metres; negative inside.
fn ease(skin: &[Option<Nearest>]) -> Vec<f64> {
    skin.iter().map(|skin| skin.map_or(f64::NAN, |skin| skin.distance)).collect()
}
