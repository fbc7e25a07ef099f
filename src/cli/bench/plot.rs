//! Curves as an SVG plot with logarithmic axes.

use std::fmt::Write;

const SIZE: [f64; 2] = [720.0, 460.0];
/// Margins left, top, right and bottom, pixels.
const MARGIN: [f64; 4] = [70.0, 40.0, 30.0, 60.0];
const COLOURS: [&str; 4] = ["#0b6aa2", "#b5541c", "#3c7d3c", "#77488f"];

/// A plot of several curves.
pub struct Plot<'a> {
    /// Title of the horizontal axis, and the label of a power of ten on it.
    pub across: (&'a str, fn(i32) -> String),
    /// Title of the vertical axis, and the label of a power of ten on it.
    pub up: (&'a str, fn(i32) -> String),
    pub curves: Vec<Curve<'a>>,
}

/// A named curve: points joined in order.
pub struct Curve<'a> {
    pub name: &'a str,
    pub points: Vec<Point>,
}

/// A point of a curve; drawn only if both values are positive.
pub struct Point {
    pub across: f64,
    pub up: f64,
    pub label: String,
}

/// The powers of ten that enclose all values, at least one apart.
fn decades(values: impl Iterator<Item = f64>) -> [i32; 2] {
    let logs = values.filter(|v| *v > 0.0 && v.is_finite()).map(f64::log10);
    let (low, high) = logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (v.min(a), v.max(b)));
    if low > high {
        return [-1, 0];
    }
    let low = low.floor() as i32;
    [low, (high.ceil() as i32).max(low + 1)]
}

/// Position of `value` on a logarithmic axis between two powers of ten, 0 to 1.
fn share(value: f64, [low, high]: [i32; 2]) -> f64 {
    (value.log10() - f64::from(low)) / f64::from(high - low)
}

/// The plot as SVG.
pub fn svg(plot: &Plot<'_>) -> String {
    let points = || plot.curves.iter().flat_map(|c| &c.points);
    let (columns, rows) = (decades(points().map(|p| p.across)), decades(points().map(|p| p.up)));
    let ([width, height], [left, top, right, bottom]) = (SIZE, MARGIN);
    let x = |across: f64| left + share(across, columns) * (width - left - right);
    let y = |up: f64| height - bottom - share(up, rows) * (height - top - bottom);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" \
         font-size=\"12\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n"
    );
    let mut line = |words: std::fmt::Arguments<'_>| {
        // Writing to a String cannot fail.
        svg.write_fmt(words).and_then(|()| svg.write_char('\n')).ok();
    };
    for power in columns[0]..=columns[1] {
        let (x, low) = (x(10f64.powi(power)), height - bottom);
        line(format_args!("<path d=\"M{x:.1} {top}V{low}\" stroke=\"#ddd\"/>"));
        let words = plot.across.1(power);
        line(format_args!("<text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{words}</text>", low + 18.0));
    }
    for power in rows[0]..=rows[1] {
        let (y, end) = (y(10f64.powi(power)), width - right);
        line(format_args!("<path d=\"M{left} {y:.1}H{end}\" stroke=\"#ddd\"/>"));
        let (x, y) = (left - 8.0, y + 4.0);
        let words = plot.up.1(power);
        line(format_args!("<text x=\"{x}\" y=\"{y:.1}\" text-anchor=\"end\">{words}</text>"));
    }
    let (middle, low) = ((left + width - right) / 2.0, height - 18.0);
    line(format_args!("<text x=\"{middle}\" y=\"{low}\" text-anchor=\"middle\">{}</text>", plot.across.0));
    line(format_args!("<text x=\"{left}\" y=\"20\">{}</text>", plot.up.0));
    for (i, curve) in plot.curves.iter().enumerate() {
        let colour = COLOURS[i % COLOURS.len()];
        let drawn = curve.points.iter().filter(|p| p.across > 0.0 && p.up > 0.0);
        let places: Vec<String> =
            drawn.clone().map(|p| format!("{:.1},{:.1}", x(p.across), y(p.up))).collect();
        let path = places.join(" ");
        line(format_args!(
            "<polyline points=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"/>"
        ));
        for p in drawn {
            let (x, y) = (x(p.across), y(p.up));
            line(format_args!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"{colour}\"/>"));
            let (x, y, words) = (x + 7.0, y - 7.0, &p.label);
            line(format_args!("<text x=\"{x:.1}\" y=\"{y:.1}\" fill=\"{colour}\">{words}</text>"));
        }
        let (x, y) = (width - right, top + 16.0 * (i as f64 + 1.0));
        line(format_args!(
            "<text x=\"{x}\" y=\"{y}\" text-anchor=\"end\" fill=\"{colour}\">{}</text>",
            curve.name
        ));
    }
    svg.push_str("</svg>\n");
    svg
}

/// A label of a time axis: 10 to this power, in seconds.
pub fn seconds(power: i32) -> String {
    if power < 0 { format!("{} ms", 10f64.powi(power + 3)) } else { format!("{} s", 10f64.powi(power)) }
}

/// A label of a percentage axis: 10 to this power, as a percentage.
pub fn percent(power: i32) -> String {
    format!("{} %", 10f64.powi(power + 2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decades_hold_what_they_are_of() {
        assert_eq!(decades([0.02, 3.0].into_iter()), [-2, 1]);
        assert_eq!(decades([0.1].into_iter()), [-1, 0]);
        assert_eq!(decades([0.0, f64::NAN].into_iter()), [-1, 0]);
        assert!((share(1.0, [-2, 2]) - 0.5).abs() < 1e-12);
    }

    #[test]
    fn without_curves_there_are_axes() {
        let svg = svg(&Plot { across: ("time", seconds), up: ("error", percent), curves: Vec::new() });
        assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n") && !svg.contains("NaN"));
    }
}
