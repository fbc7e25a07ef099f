//! Error against time as a picture: SVG, both axes by powers of ten.

use std::fmt::Write;

use crate::cli::bench::accuracy::Curve;

const SIZE: [f64; 2] = [720.0, 460.0];
/// Left, top, right, bottom.
const MARGIN: [f64; 4] = [70.0, 40.0, 30.0, 60.0];
const COLOURS: [&str; 4] = ["#0b6aa2", "#b5541c", "#3c7d3c", "#77488f"];

/// Powers of ten that hold all values, at least one apart.
fn decades(values: impl Iterator<Item = f64>) -> [i32; 2] {
    let logs = values.filter(|v| *v > 0.0 && v.is_finite()).map(f64::log10);
    let (low, high) = logs.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (v.min(a), v.max(b)));
    if low > high {
        return [-1, 0];
    }
    let low = low.floor() as i32;
    [low, (high.ceil() as i32).max(low + 1)]
}

/// `value` from 0 to 1 between two powers of ten.
fn share(value: f64, [low, high]: [i32; 2]) -> f64 {
    (value.log10() - f64::from(low)) / f64::from(high - low)
}

/// The picture.
pub fn svg(curves: &[Curve]) -> String {
    let points = || curves.iter().flat_map(|c| &c.points);
    let (times, errors) = (decades(points().map(|p| p.seconds)), decades(points().map(|p| p.excess_p99)));
    let ([width, height], [left, top, right, bottom]) = (SIZE, MARGIN);
    let x = |seconds: f64| left + share(seconds, times) * (width - left - right);
    let y = |error: f64| height - bottom - share(error, errors) * (height - top - bottom);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" \
         font-size=\"12\">\n<rect width=\"{width}\" height=\"{height}\" fill=\"white\"/>\n"
    );
    let mut line = |words: std::fmt::Arguments<'_>| {
        // Writing to a String cannot fail.
        svg.write_fmt(words).and_then(|()| svg.write_char('\n')).ok();
    };
    for power in times[0]..=times[1] {
        let (x, low) = (x(10f64.powi(power)), height - bottom);
        line(format_args!("<path d=\"M{x:.1} {top}V{low}\" stroke=\"#ddd\"/>"));
        let words = seconds_words(power);
        line(format_args!("<text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{words}</text>", low + 18.0));
    }
    for power in errors[0]..=errors[1] {
        let (y, end) = (y(10f64.powi(power)), width - right);
        line(format_args!("<path d=\"M{left} {y:.1}H{end}\" stroke=\"#ddd\"/>"));
        let (x, y) = (left - 8.0, y + 4.0);
        let percent = 10f64.powi(power + 2);
        line(format_args!("<text x=\"{x}\" y=\"{y:.1}\" text-anchor=\"end\">{percent} %</text>"));
    }
    let (middle, low) = ((left + width - right) / 2.0, height - 18.0);
    line(format_args!("<text x=\"{middle}\" y=\"{low}\" text-anchor=\"middle\">time to rest</text>"));
    line(format_args!("<text x=\"{left}\" y=\"20\">p99 strain in excess of the exact map's</text>"));
    for (i, curve) in curves.iter().enumerate() {
        let colour = COLOURS[i % COLOURS.len()];
        let drawn = curve.points.iter().filter(|p| p.seconds > 0.0 && p.excess_p99 > 0.0);
        let places: Vec<String> =
            drawn.clone().map(|p| format!("{:.1},{:.1}", x(p.seconds), y(p.excess_p99))).collect();
        let path = places.join(" ");
        line(format_args!(
            "<polyline points=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"/>"
        ));
        for p in drawn {
            let (x, y) = (x(p.seconds), y(p.excess_p99));
            line(format_args!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4\" fill=\"{colour}\"/>"));
            let (x, y, mm) = (x + 7.0, y - 7.0, p.edge_length * 1000.0);
            line(format_args!("<text x=\"{x:.1}\" y=\"{y:.1}\" fill=\"{colour}\">{mm:.0} mm</text>"));
        }
        let (x, y) = (width - right, top + 16.0 * (i as f64 + 1.0));
        line(format_args!(
            "<text x=\"{x}\" y=\"{y}\" text-anchor=\"end\" fill=\"{colour}\">{}</text>",
            curve.scene
        ));
    }
    svg.push_str("</svg>\n");
    svg
}

fn seconds_words(power: i32) -> String {
    if power < 0 { format!("{} ms", 10f64.powi(power + 3)) } else { format!("{} s", 10f64.powi(power)) }
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
        let svg = svg(&[]);
        assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n") && !svg.contains("NaN"));
    }
}
