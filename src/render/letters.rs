//! Letters of five by seven dots, drawn for this program: words in pictures without a window.

use image::{Rgba, RgbaImage};

/// Dots a letter is wide and high, and from one to the next.
const SIZE: [u32; 3] = [5, 7, 6];

/// Each row of a letter from the top, five dots, the leftmost worth 16. Small letters are drawn as capitals.
const LETTERS: [(char, [u8; 7]); 45] = [
    ('0', [14, 17, 19, 21, 25, 17, 14]),
    ('1', [4, 12, 4, 4, 4, 4, 14]),
    ('2', [14, 17, 1, 2, 4, 8, 31]),
    ('3', [31, 2, 4, 2, 1, 17, 14]),
    ('4', [2, 6, 10, 18, 31, 2, 2]),
    ('5', [31, 16, 30, 1, 1, 17, 14]),
    ('6', [6, 8, 16, 30, 17, 17, 14]),
    ('7', [31, 1, 2, 4, 8, 8, 8]),
    ('8', [14, 17, 17, 14, 17, 17, 14]),
    ('9', [14, 17, 17, 15, 1, 2, 12]),
    ('A', [14, 17, 17, 31, 17, 17, 17]),
    ('B', [30, 17, 17, 30, 17, 17, 30]),
    ('C', [14, 17, 16, 16, 16, 17, 14]),
    ('D', [28, 18, 17, 17, 17, 18, 28]),
    ('E', [31, 16, 16, 30, 16, 16, 31]),
    ('F', [31, 16, 16, 30, 16, 16, 16]),
    ('G', [14, 17, 16, 23, 17, 17, 15]),
    ('H', [17, 17, 17, 31, 17, 17, 17]),
    ('I', [14, 4, 4, 4, 4, 4, 14]),
    ('J', [7, 2, 2, 2, 2, 18, 12]),
    ('K', [17, 18, 20, 24, 20, 18, 17]),
    ('L', [16, 16, 16, 16, 16, 16, 31]),
    ('M', [17, 27, 21, 21, 17, 17, 17]),
    ('N', [17, 17, 25, 21, 19, 17, 17]),
    ('O', [14, 17, 17, 17, 17, 17, 14]),
    ('P', [30, 17, 17, 30, 16, 16, 16]),
    ('Q', [14, 17, 17, 17, 21, 18, 13]),
    ('R', [30, 17, 17, 30, 20, 18, 17]),
    ('S', [15, 16, 16, 14, 1, 1, 30]),
    ('T', [31, 4, 4, 4, 4, 4, 4]),
    ('U', [17, 17, 17, 17, 17, 17, 14]),
    ('V', [17, 17, 17, 17, 17, 10, 4]),
    ('W', [17, 17, 17, 21, 21, 21, 10]),
    ('X', [17, 17, 10, 4, 10, 17, 17]),
    ('Y', [17, 17, 17, 10, 4, 4, 4]),
    ('Z', [31, 1, 2, 4, 8, 16, 31]),
    ('.', [0, 0, 0, 0, 0, 12, 12]),
    (',', [0, 0, 0, 0, 12, 4, 8]),
    (':', [0, 12, 12, 0, 12, 12, 0]),
    ('-', [0, 0, 0, 31, 0, 0, 0]),
    ('+', [0, 4, 4, 31, 4, 4, 0]),
    ('%', [24, 25, 2, 4, 8, 19, 3]),
    ('/', [0, 1, 2, 4, 8, 16, 0]),
    ('(', [2, 4, 8, 8, 8, 4, 2]),
    (')', [8, 4, 2, 2, 2, 4, 8]),
];

/// How wide `words` are when a dot is `dot` pixels, pixels.
pub fn width(words: &str, dot: u32) -> u32 {
    words.chars().count() as u32 * SIZE[2] * dot
}

/// How high letters are when a dot is `dot` pixels, pixels.
pub fn height(dot: u32) -> u32 {
    SIZE[1] * dot
}

/// Writes `words` with the upper left corner at `at`, a dot `dot` pixels large. What lies beyond the picture is left out;
/// letters that are not known leave a gap.
pub fn write(picture: &mut RgbaImage, words: &str, at: [u32; 2], dot: u32, colour: Rgba<u8>) {
    for (i, letter) in words.chars().enumerate() {
        let Some((_, rows)) = LETTERS.iter().find(|(c, _)| *c == letter.to_ascii_uppercase()) else {
            continue;
        };
        let left = at[0] + i as u32 * SIZE[2] * dot;
        for (row, dots) in (0u32..).zip(rows) {
            for column in (0..SIZE[0]).filter(|column| dots >> (SIZE[0] - 1 - column) & 1 == 1) {
                fill(picture, [left + column * dot, at[1] + row * dot], [dot, dot], colour);
            }
        }
    }
}

/// Fills a rectangle as far as it lies in the picture.
pub fn fill(picture: &mut RgbaImage, at: [u32; 2], size: [u32; 2], colour: Rgba<u8>) {
    for y in at[1]..(at[1].saturating_add(size[1])).min(picture.height()) {
        for x in at[0]..(at[0].saturating_add(size[0])).min(picture.width()) {
            picture.put_pixel(x, y, colour);
        }
    }
}
