//! The measured result of a scene, for people and as JSON.

use serde::Serialize;

use crate::cloth::Counters;

/// The result of one scene.
#[derive(Debug, Serialize)]
pub struct Row {
    pub scene: &'static str,
    pub triangles: usize,
    /// Number of runs.
    pub runs: usize,
    /// Median wall-clock seconds of a run.
    pub seconds: f64,
    /// Number of threads for parallel steps.
    pub threads: usize,
    pub checks: Vec<Check>,
    /// Further figures, without limits.
    pub figures: Vec<Figure>,
    /// Counters of the work done in a run, where the simulation counts it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub counters: Option<Counters>,
    /// Hash of the final state, the same for every run.
    pub hash: String,
}

/// A figure with its limits.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Check {
    pub what: &'static str,
    pub value: f64,
    #[serde(flatten)]
    pub limits: Limits,
    pub met: Met,
    pub unit: Unit,
}

/// A figure without limits.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Figure {
    pub what: &'static str,
    pub value: f64,
    pub unit: Unit,
}

/// Limits of a figure. Lower values are better, but for rates higher ones.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Limits {
    /// The figure is acceptable from this value on.
    pub solid: f64,
    /// The figure is good from this value on.
    pub goal: f64,
}

/// The stricter limit that was met.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Met {
    Goal,
    Solid,
    Neither,
}

/// Unit of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Unit {
    Seconds,
    /// A fraction; 0.01 is one percent.
    Share,
    Count,
    /// A rate; higher values are better.
    PerSecond,
    EdgeLengths,
    Metres,
}

impl Check {
    /// A figure compared with its limits.
    pub fn new(what: &'static str, value: f64, unit: Unit, solid: f64, goal: f64) -> Self {
        let meets = |limit: f64| if unit == Unit::PerSecond { value >= limit } else { value <= limit };
        let met = match (meets(goal), meets(solid)) {
            (true, _) => Met::Goal,
            (_, true) => Met::Solid,
            _ => Met::Neither,
        };
        Self { what, value, limits: Limits { solid, goal }, met, unit }
    }
}

impl Unit {
    /// `value` with its unit, for people.
    pub fn words(self, value: f64) -> String {
        match self {
            Self::Seconds if value < 0.1 => format!("{:.2} ms", value * 1e3),
            Self::Seconds => format!("{value:.3} s"),
            Self::Share => format!("{:.3} %", value * 100.0),
            Self::Count => format!("{value:.0}"),
            Self::PerSecond => format!("{:.2} M/s", value / 1e6),
            Self::EdgeLengths => format!("{value:.3} l"),
            Self::Metres => format!("{:.2} mm", value * 1e3),
        }
    }
}

impl std::fmt::Display for Row {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { scene, triangles, runs, seconds, threads, checks, figures, counters, hash } = self;
        let median = Unit::Seconds.words(*seconds);
        write!(
            f,
            "{scene}\n    {triangles} triangles, median of {runs}: {median}, threads {threads}, hash {hash}"
        )?;
        for Check { what, value, limits, met, unit } in checks {
            let [value, solid, goal] = [*value, limits.solid, limits.goal].map(|v| unit.words(v));
            let met = match met {
                Met::Goal => "goal met",
                Met::Solid => "solid",
                Met::Neither => "NOT solid",
            };
            write!(f, "\n  * {what:<42} {value:>12}   solid {solid:>10}   goal {goal:>10}   {met}")?;
        }
        for Figure { what, value, unit } in figures {
            write!(f, "\n    {what:<42} {:>12}", unit.words(*value))?;
        }
        if let Some(c) = counters {
            write!(
                f,
                "\n    work: solves {}, factorisations {}, contact queries {} of {} and {} gaps, \
                 walks {}, face queries {} for {}, self tests {}, local triangles {}, grown vertices {}, \
                 drag vertices {}",
                c.solves,
                c.factorisations,
                c.contact_queries,
                c.contact_checks,
                c.contact_gaps,
                c.contact_walks,
                c.face_queries,
                c.face_checks,
                c.self_tests,
                c.local_triangles,
                c.grown_vertices,
                c.drag_vertices
            )?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_hold_from_below_but_for_rates() {
        let met = |value, unit| {
            Check::new("", value, unit, 2.0, if unit == Unit::PerSecond { 3.0 } else { 1.0 }).met
        };
        assert_eq!([0.5, 1.5, 2.5].map(|v| met(v, Unit::Seconds)), [Met::Goal, Met::Solid, Met::Neither]);
        assert_eq!([3.5, 2.5, 1.5].map(|v| met(v, Unit::PerSecond)), [Met::Goal, Met::Solid, Met::Neither]);
        assert_eq!(met(f64::NAN, Unit::Share), Met::Neither);
    }
}
