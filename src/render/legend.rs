//! A legend drawn into a picture: the title, the unit, and a colour bar with values.

use image::{Rgba, RgbaImage};

use super::letters::{fill, width, write};
use super::palette::Palette;

const INK: Rgba<u8> = Rgba([40, 44, 52, 255]);
const PAPER: Rgba<u8> = Rgba([250, 250, 250, 255]);
/// Number of values written beside the bar.
const TICKS: u32 = 5;

/// The contents of a legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Legend {
    /// What the colours show.
    pub title: String,
    /// Unit of the values.
    pub unit: String,
    /// Values at the lower and the upper end of the bar, in that unit.
    pub range: [f64; 2],
    /// Colours of the bar.
    pub palette: Palette,
    /// Sign between the whole part of a value and its decimals.
    pub decimal_sign: char,
}

impl Legend {
    /// The values beside the bar, from its lower end up.
    pub fn ticks(&self) -> Vec<String> {
        let span = self.range[1] - self.range[0];
        let digits = if span >= 20.0 {
            0
        } else if span >= 2.0 {
            1
        } else {
            2
        };
        let value = |i: u32| self.range[0] + span * f64::from(i) / f64::from(TICKS - 1);
        let sign = self.decimal_sign.to_string();
        (0..TICKS).map(|i| format!("{:.digits$}", value(i) + 0.0).replace('.', &sign)).collect()
    }

    /// Draws the legend in the lower left corner, scaled to the picture.
    pub fn burn(&self, picture: &mut RgbaImage) {
        let letters = (picture.height() / 34).max(12);
        let line = (letters / 8).max(1);
        let title = format!("{} ({})", self.title, self.unit);
        let bar = [2 * letters, (picture.height() * 2 / 5).max(letters * 3 / 2 * TICKS)];
        let ticks = self.ticks();
        let widest = ticks.iter().map(|t| width(t, letters)).max().unwrap_or(0);
        let margin = letters * 3 / 4;
        let size = [
            width(&title, letters).max(bar[0] + margin + widest) + 2 * margin,
            bar[1] + 2 * letters + 3 * margin,
        ];
        let corner = [margin, picture.height().saturating_sub(size[1] + margin)];
        fill(picture, corner, size, PAPER);
        write(picture, &title, [corner[0] + margin, corner[1] + margin], letters, INK);
        let top = [corner[0] + margin, corner[1] + 2 * margin + 2 * letters];
        for row in 0..bar[1] {
            let share = f64::from(bar[1] - 1 - row) / f64::from(bar[1] - 1);
            let value = self.range[0] + (self.range[1] - self.range[0]) * share;
            let [r, g, b] = self.palette.colour(value, self.range);
            fill(picture, [top[0], top[1] + row], [bar[0], 1], Rgba([r, g, b, 255]));
        }
        for (i, words) in (0u32..).zip(&ticks) {
            let y = top[1] + (bar[1] - 1) * (TICKS - 1 - i) / (TICKS - 1);
            fill(picture, [top[0] + bar[0], y], [margin / 2, line], INK);
            let at = [top[0] + bar[0] + margin, y.saturating_sub(letters / 2)];
            write(picture, words, at, letters, INK);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn legend(range: [f64; 2]) -> Legend {
        let (title, unit) = ("Warp strain: along the grain".to_owned(), "%".to_owned());
        Legend { title, unit, range, palette: Palette::Diverging, decimal_sign: '.' }
    }

    fn drawn(legend: &Legend) -> RgbaImage {
        let mut picture = RgbaImage::from_pixel(640, 400, Rgba([1, 2, 3, 255]));
        legend.burn(&mut picture);
        picture
    }

    #[test]
    fn a_decimal_comma_and_german_words_are_drawn() {
        let english = legend([-4.0, 4.0]);
        let comma = Legend { decimal_sign: ',', ..english.clone() };
        assert_eq!(comma.ticks(), ["-4,0", "-2,0", "0,0", "2,0", "4,0"]);
        assert_ne!(drawn(&comma), drawn(&english), "the comma is in the picture");
        let named = |title: &str| drawn(&Legend { title: title.to_owned(), ..comma.clone() });
        let all = ["Größe: Dehnung", "Grosse: Dehnung", "Gro\u{1f600}e: Dehnung"].map(named);
        assert!(all[0] != all[1] && all[0] != all[2], "umlauts are letters of their own, no boxes");
    }

    #[test]
    fn ticks_run_over_the_range() {
        assert_eq!(legend([-4.0, 4.0]).ticks(), ["-4.0", "-2.0", "0.0", "2.0", "4.0"]);
        assert_eq!(legend([0.0, 80.0]).ticks(), ["0", "20", "40", "60", "80"]);
    }

    #[test]
    fn the_colours_of_both_ends_are_in_the_picture() {
        let mut picture = RgbaImage::from_pixel(640, 400, Rgba([1, 2, 3, 255]));
        legend([-1.0, 1.0]).burn(&mut picture);
        for value in [-1.0, 1.0] {
            let [r, g, b] = Palette::Diverging.colour(value, [-1.0, 1.0]);
            assert!(picture.pixels().any(|p| *p == Rgba([r, g, b, 255])), "{value}");
        }
        assert!(picture.pixels().filter(|p| p[0] < 128 && p[2] < 128).count() > 400);
        // The right of the picture is left alone; a tiny one ends nothing.
        assert_eq!(picture.get_pixel(600, 200), &Rgba([1, 2, 3, 255]));
        legend([0.0, 0.0]).burn(&mut RgbaImage::new(3, 2));
    }
}
