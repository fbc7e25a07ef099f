//! The part of a picture that is drawn at once: all of it, or one of its tiles.

use glam::UVec2;

/// Texels (2 x 2 pixels each) of ambient occlusion that are computed round those that a part shows: its blur and its interpolation
/// read them.
pub(super) const BLUR_REACH: u32 = 6;
/// Pixels round a tile that those texels take up, with some to spare; even.
pub(super) const BLUR_MARGIN: u32 = 2 * BLUR_REACH + 4;

/// A rectangle of the pixels of a picture, and the larger one round it that things are projected to and from which ambient
/// occlusion is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Part {
    /// Size of the whole picture, pixels.
    pub(super) whole: UVec2,
    /// Upper left corner, pixels; even.
    pub(super) at: UVec2,
    /// Size, pixels.
    pub(super) size: UVec2,
    /// Upper left corner of the part with its surroundings, pixels; even.
    pub(super) around_at: UVec2,
    /// Size of the part with its surroundings, pixels; even, and up to one pixel beyond the picture.
    pub(super) around_size: UVec2,
}

impl Part {
    /// All of a picture of `size` pixels.
    pub(super) fn all(size: UVec2) -> Self {
        Self { whole: size, at: UVec2::ZERO, size, around_at: UVec2::ZERO, around_size: even(size) }
    }

    /// Tiles with sides of at most `side` pixels that cover a picture of `whole` pixels, row by row, each with `margin` pixels of
    /// its surroundings. `side` and `margin` are even.
    pub(super) fn tiles(whole: UVec2, side: u32, margin: u32) -> Vec<Self> {
        let step = side.max(2) as usize;
        let corners =
            (0..whole.y).step_by(step).flat_map(|y| (0..whole.x).step_by(step).map(move |x| (x, y)));
        let tile = |(x, y)| {
            let at = UVec2::new(x, y);
            let size = (whole - at).min(UVec2::splat(side));
            let around_at = at.saturating_sub(UVec2::splat(margin));
            let end = (even(at + size) + margin).min(even(whole));
            Self { whole, at, size, around_at, around_size: end - around_at }
        };
        corners.map(tile).collect()
    }

    /// The same with `more` pixels on every side, as far as the picture goes. `more` is even.
    pub(super) fn widened(self, more: u32) -> Self {
        let more = UVec2::splat(more);
        let Self { whole, at, size, around_at, around_size } = self;
        let (from, around_from) = (at.saturating_sub(more), around_at.saturating_sub(more));
        let end = (at + size + more).min(whole);
        let around_end = (around_at + around_size + more).min(even(whole));
        Self {
            whole,
            at: from,
            size: end - from,
            around_at: around_from,
            around_size: around_end - around_from,
        }
    }

    /// The texels of the surroundings (half size: 2 x 2 pixels each) that the part itself needs, with `more` on every side: upper
    /// left corner and size.
    pub(super) fn needed(&self, more: u32) -> [UVec2; 2] {
        let inside = self.at - self.around_at;
        let first = (inside / 2).saturating_sub(UVec2::splat(more));
        let end = (even(inside + self.size) / 2 + more).min(self.around_size / 2);
        [first, end - first]
    }
}

/// Rounded up to even numbers.
fn even(size: UVec2) -> UVec2 {
    (size + 1) / 2 * 2
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tiles_cover_every_pixel_once_and_keep_to_the_picture() {
        for whole in [UVec2::new(640, 480), UVec2::new(65, 33), UVec2::new(64, 64), UVec2::ONE] {
            let tiles = Part::tiles(whole, 64, 20);
            let mut covered = vec![0; (whole.x * whole.y) as usize];
            for tile in &tiles {
                for y in tile.at.y..tile.at.y + tile.size.y {
                    for x in tile.at.x..tile.at.x + tile.size.x {
                        covered[(y * whole.x + x) as usize] += 1;
                    }
                }
                let end = tile.around_at + tile.around_size;
                assert!(tile.around_at.cmple(tile.at).all() && end.cmpge(tile.at + tile.size).all());
                assert!(end.cmple(even(whole)).all(), "{tile:?}");
                for number in [tile.at, tile.around_at, tile.around_size] {
                    assert_eq!(number % 2, UVec2::ZERO, "{tile:?}");
                }
                let [first, size] = tile.needed(4);
                assert!((first + size).cmple(tile.around_size / 2).all(), "{tile:?}");
            }
            assert!(covered.iter().all(|&times| times == 1), "{whole}");
        }
        let [first, ..] = Part::tiles(UVec2::new(640, 480), 64, 20)[..] else { panic!("tiles") };
        assert_eq!(first.widened(0), first);
        let wide = first.widened(8);
        assert_eq!((wide.at, wide.size), (UVec2::ZERO, UVec2::splat(72)));
        assert_eq!((wide.around_at, wide.around_size), (UVec2::ZERO, UVec2::splat(92)));
        let last = Part::tiles(UVec2::new(65, 33), 64, 20).pop().expect("a tile").widened(8);
        assert_eq!((last.at, last.size), (UVec2::new(56, 0), UVec2::new(9, 33)));
        assert_eq!((last.around_at, last.around_size), (UVec2::new(36, 0), UVec2::new(30, 34)));
        let [only] = Part::tiles(UVec2::new(65, 33), 128, 0)[..] else { panic!("one tile") };
        assert_eq!(only, Part::all(UVec2::new(65, 33)));
    }
}
