//! The legend of a map on the fit report: colour bar, values, and a histogram.

use maud::{Markup, html};

use crate::render::{Legend, Rgb};
use crate::ui::fit_page::facts::MapFacts;
use crate::ui::language::{decimal_sign, say, tr};
use crate::ui::scenery::map_colours::palette;

/// Width of the drawing, SVG units.
const WIDTH: f64 = 320.0;
/// Height of the histogram, SVG units.
const BARS: f64 = 56.0;
/// Top and height of the colour bar, SVG units.
const STRIPE: (f64, f64) = (60.0, 11.0);

/// SVG of the legend: histogram, colour bar, tick labels.
pub fn legend(map: &MapFacts) -> Markup {
    let kind = map.map.kind;
    let (unit, times) = kind.unit();
    let (palette, range) = (palette(kind), map.range);
    let legend = Legend {
        title: tr(kind.title()).to_owned(),
        unit: unit.to_owned(),
        range: range.map(|v| v * times),
        palette,
        decimal_sign: decimal_sign(),
    };
    let histogram = map.map.histogram(range);
    let count = histogram.counts.len().max(1);
    let most = histogram.counts.iter().copied().max().unwrap_or(0).max(1) as f64;
    let width = WIDTH / count as f64;
    let value = |i: usize| range[0] + (range[1] - range[0]) * (i as f64 + 0.5) / count as f64;
    let ticks = legend.ticks();
    let last = ticks.len().saturating_sub(1).max(1);
    let [from, to] = [&ticks[0], &ticks[ticks.len() - 1]];
    let words = say!("{map}, {from} to {to} {unit}", map = legend.title, from, to, unit);
    html! {
        svg.legend viewBox={ "0 0 " (WIDTH) " 92" } role="img" aria-label=(words) {
            @for (i, &n) in histogram.counts.iter().enumerate() {
                @let (x, ink) = (format!("{:.1}", i as f64 * width), css(palette.colour(value(i), range)));
                @let height = BARS * n as f64 / most;
                rect.bar x=(x) y=(format!("{:.1}", BARS - height)) width=(format!("{:.1}", width - 1.0))
                    height=(format!("{height:.1}")) fill=(ink) {}
                rect x=(x) y=(STRIPE.0) width=(format!("{:.2}", width + 0.3)) height=(STRIPE.1) fill=(ink) {}
            }
            @for (i, tick) in ticks.iter().enumerate() {
                @let x = WIDTH * i as f64 / last as f64;
                @let anchor = if i == 0 { "start" } else if i == last { "end" } else { "middle" };
                text x=(format!("{x:.1}")) y="86" text-anchor=(anchor) {
                    (minus(tick)) @if i == last { " " (unit) }
                }
            }
        }
    }
}

fn css([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A number with a typographic minus sign, as wide as a plus; a zero has no sign.
pub fn minus(number: &str) -> String {
    let digits = number.trim_start_matches(['-', '+']);
    let is_nothing = !digits.contains(|c: char| c.is_ascii_digit() && c != '0');
    if is_nothing { digits.to_owned() } else { number.replace('-', "\u{2212}") }
}
