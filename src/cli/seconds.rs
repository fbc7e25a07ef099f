//! Times of the phases of a command.

use serde::Serialize;

/// Wall-clock time of each phase, seconds.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Seconds {
    /// Reading the input and preparing the body.
    pub load: f64,
    /// Triangulating, sewing and placing the root edges.
    pub build: f64,
    /// Ticks in which cloth was grown.
    pub grow: f64,
    /// Ticks in which the cloth settled.
    pub settle: f64,
    /// The longest tick of all; a signal may have to wait for it.
    pub longest_tick: f64,
    /// Draping.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub drape: Option<f64>,
    /// Carrying the cloth to another pose; for the first pose this includes binding it to the body.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub repose: Option<f64>,
    /// The whole replay, instead of the phases above.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub replay: Option<f64>,
    /// Measuring the result.
    pub measure: f64,
    /// Drawing the picture.
    pub picture: f64,
    /// From the first byte read to the last written, without the report itself.
    pub total: f64,
    /// Ticks of each start that was tried, in order.
    #[serde(skip)]
    pub starts: Vec<f64>,
}
