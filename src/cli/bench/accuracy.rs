//! Error against time: weightless cloth with a known exact solution, at decreasing edge lengths.

use serde::Serialize;

use crate::cli::bench::plot;
use crate::cli::bench::scenes::Scene;
use crate::cli::bench::tube::{Errors, Tube};
use crate::cli::failure::Failure;

/// Edge lengths of the triangles, metres.
const EDGES: [f64; 5] = [0.040, 0.028, 0.020, 0.014, 0.010];
/// The scenes: name, and circumference of the tube relative to that of the cylinder at the cloth's offset.
const TUBES: [(&str, f64); 2] = [("tube that fits a cylinder", 1.0), ("loose tube on a cylinder", 1.2)];

/// The result of one scene at one edge length.
#[derive(Clone, Debug, Serialize)]
pub struct Point {
    pub scene: &'static str,
    /// Edge length of the triangles, metres.
    pub edge_length: f64,
    pub triangles: usize,
    /// Number of runs.
    pub runs: usize,
    /// Median wall-clock seconds to rest, from pattern and marks.
    pub seconds: f64,
    /// 99th percentile of the edges' strain in excess of that of the exact solution's chords.
    pub excess_p99: f64,
    /// 99th percentile of the edges' strain.
    pub strain_p99: f64,
    /// 99th percentile of the strain of the exact solution's chords.
    pub chord_p99: f64,
    /// Largest distance of a vertex from the exact solution, edge lengths; only where the exact solution is unique.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub position: Option<f64>,
    /// Order of convergence of the excess, from the edge length before.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub order: Option<f64>,
    pub ticks: u64,
    pub threads: usize,
    pub hash: String,
}

/// The results of a scene at all edge lengths.
#[derive(Debug)]
pub struct Curve {
    pub scene: &'static str,
    pub points: Vec<Point>,
}

/// Plots error against time as SVG.
pub fn plotted(curves: &[Curve]) -> String {
    let point = |p: &Point| plot::Point {
        across: p.seconds,
        up: p.excess_p99,
        label: format!("{:.0} mm", p.edge_length * 1000.0),
    };
    let curve = |c: &Curve| plot::Curve { name: c.scene, points: c.points.iter().map(point).collect() };
    plot::svg(&plot::Plot {
        across: ("time to rest", plot::seconds),
        up: ("p99 strain in excess of the exact map's", plot::percent),
        curves: curves.iter().map(curve).collect(),
    })
}

/// Measures all scenes; `tell` is called with each result as it comes.
pub fn accuracy(
    runs: usize,
    mut tell: impl FnMut(&Point) -> Result<(), Failure>,
) -> Result<Vec<Curve>, Failure> {
    let mut curves = Vec::new();
    for (scene, loose) in TUBES {
        let tube = Tube::new(loose);
        let mut points: Vec<Point> = Vec::new();
        for edge_length in EDGES {
            let mut point = measured(scene, &tube, loose == 1.0, edge_length, runs)?;
            point.order = points.last().map(|before| {
                (before.excess_p99 / point.excess_p99).ln() / (before.edge_length / edge_length).ln()
            });
            tell(&point)?;
            points.push(point);
        }
        curves.push(Curve { scene, points });
    }
    Ok(curves)
}

fn measured(
    name: &'static str,
    tube: &Tube,
    only_one: bool,
    edge_length: f64,
    runs: usize,
) -> Result<Point, Failure> {
    let scene = Scene::tube(tube, edge_length)?.weightless();
    let (seconds, hash, wrapped) = scene.wraps(name, runs, |_, _, _, _| ())?;
    let errors = Errors::new(&wrapped.garment, &wrapped.state, &tube.exact(&wrapped.garment));
    Ok(Point {
        scene: name,
        edge_length,
        triangles: wrapped.garment.triangles.len(),
        runs,
        seconds,
        excess_p99: errors.excess,
        strain_p99: errors.strain,
        chord_p99: errors.chords,
        position: only_one.then(|| errors.position / wrapped.garment.mean_edge()),
        order: None,
        ticks: wrapped.ticks,
        threads: rayon::current_num_threads(),
        hash,
    })
}

impl std::fmt::Display for Point {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { scene, triangles, seconds, ticks, hash, .. } = self;
        let [excess, strain, chord] =
            [self.excess_p99, self.strain_p99, self.chord_p99].map(|share| share * 100.0);
        write!(
            f,
            "{scene:<26} {:>3.0} mm {triangles:>6} triangles {seconds:>7.3} s {ticks:>4} ticks  excess p99 {excess:.4} %  \
             strain {strain:.4} %  chords {chord:.4} %",
            self.edge_length * 1000.0
        )?;
        if let Some(position) = self.position {
            write!(f, "  position {position:.4} l")?;
        }
        if let Some(order) = self.order {
            write!(f, "  order {order:.1}")?;
        }
        write!(f, "  hash {hash}")
    }
}
