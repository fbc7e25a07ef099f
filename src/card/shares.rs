//! How much of its correction a spring may make in a step in which all springs act at once.
//!
//! In one dimension and one pass a step reads xₙ₊₁ = (1 - κ)(2 xₙ - xₙ₋₁), where κ is an eigenvalue of the sum of all corrections.
//! It is stable while κ < 4/3. The largest κ is found by power iteration on the graph of springs, each taken as acting in every
//! direction: the true one, whatever shape the cloth takes, is smaller.

/// Share of the stability limit of 4/3 that is used.
const SAFE: f64 = 0.9;
/// Iterations for the largest eigenvalue; it is found from below, and [`SAFE`] makes up for what is missing.
const ITERATIONS: usize = 80;
/// Springs at a vertex of a regular mesh, for which a weight of 1 is used.
const REGULAR: f64 = 6.0;

/// A spring between two vertices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring {
    /// The vertices.
    pub ends: [u32; 2],
    /// Rest length, metres.
    pub length: f64,
    /// Stiffness, N/m.
    pub stiffness: f64,
}

/// Largest stable share of the full correction for each spring, 0..=1.
#[derive(Clone, Debug)]
pub struct Shares {
    /// One for each spring.
    pub most: Vec<f64>,
    /// Their mean. The strain that one pass leaves is inversely proportional to it.
    pub mean: f64,
}

impl Shares {
    /// The shares of `springs` between vertices with this inverse mass, 1/kg.
    pub fn new(springs: &[Spring], inverse_mass: &[f64]) -> Self {
        let mut degree = vec![0_usize; inverse_mass.len()];
        springs.iter().flat_map(|s| s.ends).for_each(|v| degree[v as usize] += 1);
        let degree_of = |spring: &Spring| spring.ends.map(|v| degree[v as usize]).into_iter().max();
        let weights: Vec<f64> =
            springs.iter().map(|s| REGULAR / degree_of(s).unwrap_or(1).max(1) as f64).collect();
        let largest = largest_eigenvalue(springs, &weights, inverse_mass);
        let limit = SAFE * 4.0 / 3.0 / largest.max(1e-9);
        let most: Vec<f64> = weights.iter().map(|weight| (weight * limit).min(1.0)).collect();
        let mean = most.iter().sum::<f64>() / most.len().max(1) as f64;
        Self { most, mean }
    }
}

fn largest_eigenvalue(springs: &[Spring], weights: &[f64], inverse_mass: &[f64]) -> f64 {
    // Neighbours with opposite signs, roughly: near the mode that is sought.
    let mut mode: Vec<f64> = (0..inverse_mass.len()).map(|v| (v as f64 * 2.399_963).sin() + 0.01).collect();
    let mut largest = 0.0;
    for _ in 0..ITERATIONS {
        let mut next = vec![0.0; mode.len()];
        for (spring, weight) in springs.iter().zip(weights) {
            let [a, b] = spring.ends.map(|v| v as usize);
            let [wa, wb] = [a, b].map(|v| inverse_mass[v]);
            if wa + wb > 0.0 {
                let pull = weight * (mode[a] - mode[b]) / (wa + wb);
                next[a] += pull * wa;
                next[b] -= pull * wb;
            }
        }
        let length = |of: &[f64]| of.iter().map(|x| x * x).sum::<f64>().sqrt();
        let (before, after) = (length(&mode), length(&next));
        if after == 0.0 {
            return largest;
        }
        largest = after / before;
        next.iter_mut().for_each(|x| *x /= after);
        mode = next;
    }
    largest
}
