//! How long each phase took.

use serde::Serialize;

/// Wall-clock seconds by phase.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Seconds {
    /// Reading the input and making the body ready.
    pub load: f64,
    /// Triangulating, sewing and laying the root edges.
    pub build: f64,
    /// Ticks that grew cloth.
    pub grow: f64,
    /// Ticks that settled it.
    pub settle: f64,
    /// The longest of all ticks: so long a signal may have to wait.
    pub longest_tick: f64,
    /// Draping it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drape: Option<f64>,
    /// Carrying the cloth to another pose, with binding it to the body for the first one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub repose: Option<f64>,
    /// The whole of a replay, instead of those above.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub replay: Option<f64>,
    /// Reading the figures off.
    pub measure: f64,
    /// Drawing.
    pub picture: f64,
    /// From the first byte read to the last written, this file left out.
    pub total: f64,
    /// Ticks of each start that was tried.
    #[serde(skip)]
    pub starts: Vec<f64>,
}
