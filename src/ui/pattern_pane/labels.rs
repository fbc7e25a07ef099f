//! Places of texts on the table, so that none covers another.

use egui::{Pos2, Rect, Vec2};

/// Places on the screen that are taken.
#[derive(Debug, Default)]
pub struct Labels {
    texts: Vec<Rect>,
    /// Numbers of marks, which texts avoid where they can.
    numbers: Vec<Rect>,
}

impl Labels {
    /// Labels beside these numbers of marks.
    pub fn beside(numbers: Vec<Rect>) -> Self {
        Self { texts: Vec::new(), numbers }
    }

    /// The first of `places` that covers neither a text nor a number, else the first that covers no text; None where each does. It
    /// is taken from now on.
    pub fn take(&mut self, places: &[Rect]) -> Option<Rect> {
        let is_free = |taken: &[Rect], place: &Rect| !taken.iter().any(|other| other.intersects(*place));
        let free = || places.iter().copied().filter(|place| is_free(&self.texts, place));
        let place = free().find(|place| is_free(&self.numbers, place)).or_else(|| free().next())?;
        self.texts.push(place);
        Some(place)
    }
}

/// The point of a polyline at a share (0..=1) of its length, and its direction there; None without any length.
pub fn along(points: &[Pos2], share: f32) -> Option<(Pos2, Vec2)> {
    let sides = || points.windows(2).map(|w| (w[0], w[1] - w[0])).filter(|(_, side)| side.length() > 0.0);
    let mut left = sides().map(|(_, side)| side.length()).sum::<f32>() * share;
    for (from, side) in sides() {
        let length = side.length();
        if left <= length {
            return Some((from + side * (left / length), side / length));
        }
        left -= length;
    }
    sides().next_back().map(|(from, side)| (from + side, side.normalized()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f32) -> Rect {
        Rect::from_min_size(Pos2::new(x, 0.0), Vec2::splat(10.0))
    }

    #[test]
    fn no_text_covers_another_and_numbers_are_avoided_where_there_is_room() {
        let mut labels = Labels::beside(vec![square(0.0), square(40.0)]);
        assert_eq!(labels.take(&[square(5.0), square(20.0)]), Some(square(20.0)));
        assert_eq!(labels.take(&[square(25.0), square(5.0)]), Some(square(5.0)), "over a number");
        assert_eq!(labels.take(&[square(25.0), square(0.0)]), None);
        assert_eq!(labels.take(&[]), None);
    }

    #[test]
    fn places_along_a_line_are_told_by_its_length() {
        let line = [[0.0, 0.0], [0.0, 0.0], [1.0, 0.0], [1.0, 3.0]].map(Pos2::from);
        assert_eq!(along(&line, 0.5), Some((Pos2::new(1.0, 1.0), Vec2::Y)));
        assert_eq!(along(&line, 1.0), Some((Pos2::new(1.0, 3.0), Vec2::Y)));
        assert_eq!(along(&line[..2], 0.5), None);
    }
}
