//! Fields and sliders whose numbers have the decimal sign of the language, and in which both a point and a comma may be typed.

use std::ops::RangeInclusive;

use egui::emath::{Numeric, format_with_decimals_in_range};
use egui::{DragValue, Slider};

use crate::ui::language::{localised, parsed};

/// A field of a number that is typed or dragged.
pub fn drag_value<N: Numeric>(value: &mut N) -> DragValue<'_> {
    DragValue::new(value).custom_formatter(text).custom_parser(parsed)
}

/// A slider with a field of its number.
pub fn slider<N: Numeric>(value: &mut N, range: RangeInclusive<N>) -> Slider<'_> {
    Slider::new(value, range).custom_formatter(text).custom_parser(parsed)
}

/// A number with as many digits as it needs, of those in `digits`.
fn text(value: f64, digits: RangeInclusive<usize>) -> String {
    localised(&format_with_decimals_in_range(value, digits))
}
