//! Random damage to bytes and text, whatever the format.

use std::ops::Range;

use crate::geometry::random::Random;

/// Most bytes of a damaged file: a file that is slow only because it is long shows nothing.
pub const MOST_BYTES: usize = 256 << 10;

/// Odd numbers that replace numbers in a text.
const NUMBERS: [&str; 32] = [
    "nan",
    "NaN",
    "inf",
    "-Infinity",
    "1e999",
    "-1e999",
    "1e308",
    "-1e300",
    "1e30",
    "1e9",
    "1e6",
    "100000",
    "-1",
    "-2",
    "-0",
    "0",
    "1",
    "2",
    "255",
    "65536",
    "2147483648",
    "4294967295",
    "9223372036854775808",
    "99999999999999999999999",
    "1e-320",
    "1e-30",
    "0.5",
    "1,5",
    "--1",
    "+",
    "",
    "0x10",
];

/// Odd byte sequences that are inserted into a text.
const WORDS: [&[u8]; 16] = [
    b"\0",
    b"\xef\xbb\xbf",
    b"\xff\xfe",
    b"\xc3",
    "\u{202e}".as_bytes(),
    b"\\",
    b"\\\n",
    b"\r",
    b"\"",
    b"{",
    b"]",
    b"&a;",
    b"<!--",
    b"../../evil",
    b"/etc/passwd",
    b"file:///etc/passwd",
];

/// Odd integers that overwrite one, two, four or eight bytes, little-endian.
const WHOLE: [u64; 10] = [0, 1, 2, 0x7f, 0xff, 0xffff, 0x7fff_ffff, 0xffff_ffff, 0x8000_0000, u64::MAX];
/// Odd numbers that overwrite four bytes, in single precision.
const FLOATS: [f32; 10] =
    [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, -1e30, 1e9, 1e-40, -0.0, 0.0, 0.5];

/// Ranges of words: letters, digits and the other characters of numbers.
fn words(bytes: &[u8]) -> Vec<Range<usize>> {
    let is_part = |b: &u8| b.is_ascii_alphanumeric() || b"_.+-#".contains(b) || *b >= 0x80;
    let mut words = Vec::new();
    let mut start = None;
    for (i, byte) in bytes.iter().enumerate() {
        match (is_part(byte), start) {
            (true, None) => start = Some(i),
            (false, Some(from)) => {
                words.push(from..i);
                start = None;
            }
            _ => {}
        }
    }
    words.extend(start.map(|from| from..bytes.len()));
    words
}

fn is_number(word: &[u8]) -> bool {
    std::str::from_utf8(word).is_ok_and(|word| word.parse::<f64>().is_ok())
}

/// A random range of whole lines, or of bytes where there are few lines.
fn stretch(bytes: &[u8], random: &mut Random) -> Range<usize> {
    let starts: Vec<usize> = std::iter::once(0)
        .chain(bytes.iter().enumerate().filter(|(_, b)| **b == b'\n').map(|(i, _)| i + 1))
        .collect();
    if starts.len() < 4 || random.chance(0.2) {
        let from = random.below(bytes.len().max(1));
        return from..(from + 1 + random.below(64)).min(bytes.len());
    }
    let first = random.below(starts.len());
    let last = first + 1 + random.below(8);
    starts[first]..starts.get(last).copied().unwrap_or(bytes.len())
}

/// A random number that is odd for a reader, as text.
pub fn odd_number(random: &mut Random) -> &'static str {
    NUMBERS[random.below(NUMBERS.len())]
}

/// Makes one random change to a text; `other` is another valid file of its format.
pub fn text(bytes: &mut Vec<u8>, other: &[u8], random: &mut Random) {
    if bytes.is_empty() {
        return;
    }
    match random.below(14) {
        0..=3 => number(bytes, random),
        4..=5 => word(bytes, random),
        6 => {
            let taken = stretch(bytes, random);
            bytes.drain(taken);
        }
        7 => repeated(bytes, random),
        8 => {
            let (a, b) = (stretch(bytes, random), stretch(bytes, random));
            let (a, b) = if a.start <= b.start { (a, b) } else { (b, a) };
            if a.end <= b.start {
                let moved: Vec<u8> = bytes[b.clone()].to_vec();
                bytes.drain(b);
                bytes.splice(a.start..a.start, moved);
            }
        }
        9 => nested(bytes, random),
        10 => {
            let at = random.below(bytes.len() + 1);
            bytes.splice(at..at, WORDS[random.below(WORDS.len())].iter().copied());
        }
        11 => {
            let (cut, from) = (random.below(bytes.len() + 1), random.below(other.len() + 1));
            bytes.truncate(cut);
            bytes.extend_from_slice(&other[from..]);
        }
        12 => bytes.truncate(random.below(bytes.len())),
        _ => bits(bytes, random),
    }
    bytes.truncate(MOST_BYTES);
}

/// Replaces a random number in a text by an odd one.
pub fn number(bytes: &mut Vec<u8>, random: &mut Random) {
    let numbers: Vec<Range<usize>> =
        words(bytes).into_iter().filter(|w| is_number(&bytes[w.clone()])).collect();
    if let Some(at) = numbers.get(random.below(numbers.len().max(1))) {
        bytes.splice(at.clone(), odd_number(random).bytes());
    }
}

/// Replaces a random word by another one of the file, or exchanges the two. Where the format refers by names or numbers,
/// something may then refer to itself.
fn word(bytes: &mut Vec<u8>, random: &mut Random) {
    let words = words(bytes);
    if words.is_empty() {
        return;
    }
    let [a, b] = [(); 2].map(|()| words[random.below(words.len())].clone());
    let (first, second) = if a.start <= b.start { (a, b) } else { (b, a) };
    let [was_first, was_second] = [&first, &second].map(|w| bytes[w.clone()].to_vec());
    if random.chance(0.5) && first.end <= second.start {
        bytes.splice(second, was_first);
        bytes.splice(first, was_second);
    } else {
        bytes.splice(first, was_second);
    }
}

/// Repeats a random range many times.
fn repeated(bytes: &mut Vec<u8>, random: &mut Random) {
    let taken = stretch(bytes, random);
    let chunk = bytes[taken.clone()].to_vec();
    let room = MOST_BYTES.saturating_sub(bytes.len()) / chunk.len().max(1);
    let times = [1, 2, 10, 100, 1_000, 100_000][random.below(6)].min(room);
    bytes.splice(taken.end..taken.end, chunk.repeat(times));
}

/// Repeats a short range that begins with an opening bracket, which nests it in itself.
fn nested(bytes: &mut Vec<u8>, random: &mut Random) {
    let openers: Vec<usize> =
        bytes.iter().enumerate().filter(|(_, b)| b"{[<(".contains(b)).map(|(i, _)| i).collect();
    let Some(&from) = openers.get(random.below(openers.len().max(1))) else { return };
    let end = match bytes[from] {
        b'<' => bytes[from..].iter().position(|b| *b == b'>').map_or(from + 1, |length| from + length + 1),
        _ => from + 1 + if random.chance(0.5) { 0 } else { random.below(16) },
    };
    let chunk = bytes[from..end.min(bytes.len())].to_vec();
    let room = MOST_BYTES.saturating_sub(bytes.len()) / chunk.len().max(1);
    let times = [1, 10, 100, 150, 1_000, 100_000][random.below(6)].min(room);
    bytes.splice(from..from, chunk.repeat(times));
}

/// Flips a few bits.
fn bits(bytes: &mut [u8], random: &mut Random) {
    for _ in 0..=random.below(4) {
        let at = random.below(bytes.len().max(1));
        if let Some(byte) = bytes.get_mut(at) {
            *byte ^= 1 << random.below(8);
        }
    }
}

/// Makes one random change to bytes that hold numbers.
pub fn binary(bytes: &mut Vec<u8>, random: &mut Random) {
    if bytes.is_empty() {
        return;
    }
    let at = random.below(bytes.len());
    match random.below(8) {
        0..=2 => overwrite(bytes, at & !3, &FLOATS[random.below(FLOATS.len())].to_le_bytes()),
        3..=4 => {
            let width = [1, 2, 4, 8][random.below(4)];
            let whole = WHOLE[random.below(WHOLE.len())].to_le_bytes();
            overwrite(bytes, at & !(width - 1), &whole[..width]);
        }
        5 => bytes.truncate(at),
        6 => {
            let end = (at + 1 + random.below(64)).min(bytes.len());
            let chunk = bytes[at..end].to_vec();
            bytes.splice(at..at, chunk);
        }
        _ => bits(bytes, random),
    }
}

fn overwrite(bytes: &mut [u8], at: usize, by: &[u8]) {
    for (byte, new) in bytes.iter_mut().skip(at).zip(by) {
        *byte = *new;
    }
}
