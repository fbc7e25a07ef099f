//! The report on all sizes of a pattern: which of them dresses clean, its ease, and which fits a body best.

use serde::Serialize;

use crate::cli::failure::Failure;
use crate::pattern::Pattern;
use crate::session::size_fit::{self, SizeFit};

/// All sizes.
#[derive(Debug, Serialize)]
pub struct SizeReport {
    version: &'static str,
    name: String,
    base: String,
    sizes: Vec<SizeFit>,
    /// The size that fits the body best, where all sizes were put on one body.
    #[serde(skip_serializing_if = "Option::is_none")]
    best: Option<String>,
    #[serde(skip)]
    on_one_body: bool,
}

impl SizeReport {
    /// A report on sizes of `pattern` without any yet; `on_one_body` where all are put on the same.
    pub fn new(name: &str, pattern: &Pattern, on_one_body: bool) -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION"),
            name: name.to_owned(),
            base: pattern.sizes.base_name().to_owned(),
            sizes: Vec::new(),
            best: None,
            on_one_body,
        }
    }

    /// Adds a size.
    pub fn add(&mut self, size: SizeFit) {
        self.sizes.push(size);
        self.best = size_fit::best(&self.sizes).filter(|_| self.on_one_body).map(|size| size.size.clone());
    }

    /// It as JSON.
    pub fn json(&self) -> Result<String, Failure> {
        serde_json::to_string_pretty(self).map_err(|e| Failure::Internal(e.to_string()))
    }

    /// A row for each size.
    pub fn csv(&self) -> String {
        size_fit::csv(&self.sizes)
    }

    /// The result in one or two lines, for people.
    pub fn summary(&self) -> String {
        size_fit::summary(&self.sizes, self.on_one_body)
    }

    /// The sizes that are not dressed, in words; None when all are.
    pub fn failed(&self) -> Option<String> {
        let failed: Vec<&str> =
            self.sizes.iter().filter(|size| !size.is_clean()).map(|size| size.size.as_str()).collect();
        (!failed.is_empty()).then(|| format!("not dressed without a fault: {}", failed.join(", ")))
    }
}
