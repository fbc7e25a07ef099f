//! A marker that is laid out, with its report, ready to be shown and written: the same from the window and the command line.

use crate::io::pdf::{Paper, PdfError};
use crate::language::said;
use crate::marker::layout::{Marker, make};
use crate::marker::nest::Watch;
use crate::marker::order::{MarkerError, Order};
use crate::marker::report::MarkerReport;
use crate::marker::write::{MarkerFormat, write};
use crate::pattern::Pattern;

/// A marker with its report.
#[derive(Clone, Debug)]
pub struct FinishedMarker {
    pub marker: Marker,
    pub report: MarkerReport,
}

impl FinishedMarker {
    /// Lays out `order` of the pattern called `name`. `watch` tells of its progress and may stop it.
    ///
    /// # Errors
    /// What cannot be laid out, in words, or a stop.
    pub fn new(name: &str, pattern: &Pattern, order: &Order, watch: &Watch) -> Result<Self, MarkerError> {
        let marker = make(pattern, order, watch)?;
        let report = MarkerReport::new(name, pattern, &marker);
        Ok(Self { marker, report })
    }

    /// The file to cut from, with the report below the cloth in the language that is shown. `paper` is for PDF only.
    ///
    /// # Errors
    /// Why no PDF can be made of it.
    pub fn file(&self, format: MarkerFormat, paper: Paper) -> Result<Vec<u8>, PdfError> {
        let words: Vec<String> = self.report.words().iter().map(said).collect();
        write(format, &self.marker, &self.report.name, &words, paper)
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::geometry::words::Words;
    use crate::marker::nest::Effort;
    use crate::pattern::Piece;

    fn pattern() -> Pattern {
        let mut pattern = Pattern::default();
        let corners = [DVec2::ZERO, DVec2::X * 0.3, DVec2::new(0.3, 0.2), DVec2::new(0.0, 0.2)];
        pattern.add_piece(Piece::polygon("front", &corners));
        pattern
    }

    #[test]
    fn the_watch_tells_how_far_it_is_and_stops_it() {
        let effort = Effort { seconds: 0.2, seed: 1 };
        let order = Order { garments: vec![(String::new(), 9)], effort, ..Order::default() };
        let watch = Watch::default();
        let made = FinishedMarker::new("a", &pattern(), &order, &watch).expect("a marker");
        assert!((0.0..=1.0).contains(&watch.share()));
        assert_eq!((made.report.places.len(), made.marker.placed.len()), (9, 9));
        watch.stop();
        let stopped = FinishedMarker::new("a", &pattern(), &order, &watch).err();
        assert_eq!(stopped, Some(MarkerError::Stopped));
    }

    #[test]
    fn a_piece_that_is_too_wide_is_told_in_any_unit() {
        let order = Order { garments: vec![(String::new(), 1)], width: 0.1, ..Order::default() };
        let error = make(&pattern(), &order, &Watch::default()).expect_err("too wide");
        assert_eq!(error.to_string(), "\"front\" needs cloth of 30.0 cm, and this is 10.0 cm wide");
        let inches = error.words_by(&|metres| Words::plain(format!("{:.1} in", metres / 0.0254)));
        assert_eq!(inches, "\"front\" needs cloth of 11.8 in, and this is 3.9 in wide");
    }
}
