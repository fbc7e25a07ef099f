//! Times of the phases of a command.

use std::time::Instant;

use serde::Serialize;

use crate::cli::simulate::times::cpu_seconds;

/// When some work began, by the clock on the wall and by that of the processor.
#[derive(Clone, Copy, Debug)]
pub struct Begun {
    at: Instant,
    processor: Option<f64>,
}

impl Begun {
    pub fn now() -> Self {
        Self { at: Instant::now(), processor: cpu_seconds() }
    }

    /// Wall-clock time since, seconds.
    pub fn seconds(&self) -> f64 {
        self.at.elapsed().as_secs_f64()
    }

    /// Processor time of all threads since, seconds; None where the system does not tell.
    pub fn processor_seconds(&self) -> Option<f64> {
        self.processor.zip(cpu_seconds()).map(|(before, now)| now - before)
    }
}

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
    /// Processor time of all threads in that time.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub processor: Option<f64>,
    /// Ticks of each start that was tried, in order.
    #[serde(skip)]
    pub starts: Vec<f64>,
}
