//! Reads motion capture from Biovision hierarchy files (BVH): a skeleton, then one row of channel values per frame.
//!
//! The format is described in Meredith and Maddock 2001, "Motion Capture File Formats Explained" (University of Sheffield,
//! CS-01-11). The reader is our own: the format is a page long, and the existing crate (`bvh_anim`) has had no release since 2020
//! and does not name the line of every fault.

use glam::DVec3;

use crate::body::pose::motion::{Channel, Clip, ClipJoint};
use crate::geometry::words::{Value, Words, within_quotes, words};
use crate::io::Limits;
use crate::io::words::line;

/// Largest number of joints of a skeleton.
const MOST_JOINTS: usize = 2000;
/// Largest nesting depth of joints.
const DEEPEST: usize = 200;
/// Largest number of channels of a joint.
const MOST_CHANNELS: usize = 6;
/// Largest number of channel values in all frames together.
const MOST_VALUES: usize = 50_000_000;
/// Largest absolute value of a number in the file.
const LARGEST: f64 = 1e7;
/// Accepted time from frame to frame, seconds.
const FRAME_TIME: std::ops::RangeInclusive<f64> = 1e-4..=100.0;

/// Why a file cannot be read as a motion.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.words())]
pub enum BvhError {
    /// A fault in one line.
    Line {
        /// Line number, from 1.
        line: usize,
        /// What is wrong.
        words: Words,
    },
    /// The file exceeds a limit of this reader; the text names the limit.
    OverLimit(Words),
}

impl BvhError {
    /// The error in words.
    pub fn words(&self) -> Words {
        match self {
            Self::Line { line: number, words } => line(*number).and(": ", words.clone()),
            Self::OverLimit(what) => words!("over the limit: {what}", what),
        }
    }
}

/// Whether `bytes` begin like a BVH file.
pub fn is_bvh(bytes: &[u8]) -> bool {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
    bytes.get(..9).is_some_and(|head| head.eq_ignore_ascii_case(b"HIERARCHY"))
}

/// Reads a motion, in the unit and axes of the file.
pub fn read(bytes: &[u8]) -> Result<Clip, BvhError> {
    let most = Limits::default().file_bytes;
    if bytes.len() > most {
        return Err(BvhError::OverLimit(words!("the file has more than {most} bytes", most)));
    }
    // Only names may be in another encoding than UTF-8.
    let text = String::from_utf8_lossy(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes));
    let mut lines = Lines::new(&text);
    let joints = hierarchy(&mut lines)?;
    let (frames, seconds_per_frame) = header(&mut lines)?;
    let mut clip = Clip { joints, seconds_per_frame, values: Vec::new() };
    rows(&mut lines, frames, &mut clip)?;
    Ok(clip)
}

/// The non-empty lines of the file, with their line numbers from 1.
struct Lines<'a> {
    rest: Vec<(usize, &'a str)>,
    next: usize,
}

impl<'a> Lines<'a> {
    fn new(text: &'a str) -> Self {
        // Line ends of old Macintosh files (CR alone) are accepted too.
        let numbered = text.split('\n').enumerate().map(|(i, line)| (i + 1, line.trim()));
        let ends = !text.contains('\n') && text.contains('\r');
        let rest = match ends {
            true => text.split('\r').enumerate().map(|(i, line)| (i + 1, line.trim())).collect::<Vec<_>>(),
            false => numbered.collect(),
        };
        Self { rest: rest.into_iter().filter(|(_, line)| !line.is_empty()).collect(), next: 0 }
    }

    /// The number of the line read last, from 1; before any line is read, that of the first.
    fn number(&self) -> usize {
        let last = self.next.saturating_sub(1).min(self.rest.len().saturating_sub(1));
        self.rest.get(last).map_or(1, |(number, _)| *number)
    }

    fn fault(&self, words: Words) -> BvhError {
        BvhError::Line { line: self.number(), words }
    }

    /// The next line, which should hold the sign or the word `expected`.
    fn line(&mut self, expected: &str) -> Result<&'a str, BvhError> {
        self.line_of(|| Words::plain(expected))
    }

    /// The next line, which should be what `expected` says.
    fn line_of(&mut self, expected: impl FnOnce() -> Words) -> Result<&'a str, BvhError> {
        let Some((_, line)) = self.rest.get(self.next) else {
            let expected = expected();
            return Err(self.fault(words!("the file ends here, where {expected} should follow", expected)));
        };
        self.next += 1;
        Ok(line)
    }

    fn peek(&self) -> Option<&'a str> {
        self.rest.get(self.next).map(|(_, line)| *line)
    }
}

/// The rest of `line` after `keyword`, which may be in capital or small letters; None if the line begins with another word.
fn after<'a>(line: &'a str, keyword: &str) -> Option<&'a str> {
    let head = line.get(..keyword.len()).filter(|head| head.eq_ignore_ascii_case(keyword))?;
    let rest = &line[head.len()..];
    (rest.is_empty() || rest.starts_with(|c: char| c.is_whitespace() || c == '{' || c == ':'))
        .then_some(rest.trim())
}

/// The beginning of `word` as it stands between quotes.
fn short(word: &str) -> Value {
    let short: String = word.chars().filter(|c| !c.is_control()).take(40).collect();
    within_quotes(&short)
}

/// That another word than `expected` was found.
fn unlike(expected: &str, found: &str) -> Words {
    words!("expected {expected}, found \"{found}\"", expected, found = short(found))
}

fn number(lines: &Lines<'_>, word: &str) -> Result<f64, BvhError> {
    match word.parse::<f64>() {
        Ok(x) if x.is_finite() && x.abs() <= LARGEST => Ok(x),
        Ok(x) => Err(lines.fault(words!("{x} is out of range", x))),
        Err(_) => Err(lines.fault(words!("\"{value}\" is no number", value = short(word)))),
    }
}

fn hierarchy(lines: &mut Lines<'_>) -> Result<Vec<ClipJoint>, BvhError> {
    let first = lines.line("HIERARCHY")?;
    if after(first, "HIERARCHY").is_none() {
        let words = words!("a motion begins with HIERARCHY, not with \"{found}\"", found = short(first));
        return Err(lines.fault(words));
    }
    let line = lines.line("ROOT")?;
    let name = after(line, "ROOT").ok_or_else(|| lines.fault(unlike("ROOT", line)))?;
    let mut joints = Vec::new();
    // Indices of the joints whose braces are still open, outermost first.
    let mut open = vec![begin(lines, &mut joints, name, None)?];
    while let Some(&joint) = open.last() {
        let line = lines.line_of(|| words!("a joint, its offset, its channels or {brace}", brace = "}"))?;
        if line == "}" {
            open.pop();
        } else if let Some(numbers) = after(line, "OFFSET") {
            joints[joint].offset = offset(lines, numbers)?;
        } else if let Some(words) = after(line, "CHANNELS") {
            joints[joint].channels = channels(lines, words)?;
        } else if let Some(name) = after(line, "JOINT") {
            if open.len() == DEEPEST {
                let words = words!("more than {most} joints inside each other", most = DEEPEST);
                return Err(BvhError::OverLimit(words));
            }
            open.push(begin(lines, &mut joints, name, Some(joint))?);
        } else if after(line, "End").is_some() {
            let end = end(lines, line)?;
            joints[joint].ends.push(end);
        } else {
            let words = words!(
                "expected JOINT, End Site, OFFSET, CHANNELS or {brace}, found \"{found}\"",
                found = short(line),
                brace = "}"
            );
            return Err(lines.fault(words));
        }
    }
    Ok(joints)
}

/// Reads the name and the opening brace of a joint, adds the joint to `joints` and returns its index.
fn begin(
    lines: &mut Lines<'_>,
    joints: &mut Vec<ClipJoint>,
    name: &str,
    parent: Option<usize>,
) -> Result<usize, BvhError> {
    let (name, has_brace) = name.strip_suffix('{').map_or((name, false), |name| (name.trim(), true));
    let name: String = name.chars().filter(|c| !c.is_control()).collect();
    if name.is_empty() {
        return Err(lines.fault(words!("a joint without a name")));
    }
    if name.len() > Limits::default().name_bytes {
        return Err(lines.fault(words!("the name of the joint is too long")));
    }
    if joints.len() == MOST_JOINTS {
        return Err(BvhError::OverLimit(words!("more than {most} joints", most = MOST_JOINTS)));
    }
    if !has_brace {
        brace(lines)?;
    }
    joints.push(ClipJoint { name, parent, offset: DVec3::ZERO, channels: Vec::new(), ends: Vec::new() });
    Ok(joints.len() - 1)
}

fn brace(lines: &mut Lines<'_>) -> Result<(), BvhError> {
    match lines.line("{")? {
        "{" => Ok(()),
        line => Err(lines.fault(unlike("{", line))),
    }
}

/// Reads an end site, "End Site { OFFSET x y z }", and returns its offset from the joint.
fn end(lines: &mut Lines<'_>, line: &str) -> Result<DVec3, BvhError> {
    if !line.ends_with('{') {
        brace(lines)?;
    }
    let line = lines.line("OFFSET")?;
    let numbers = after(line, "OFFSET").ok_or_else(|| lines.fault(unlike("OFFSET", line)))?;
    let offset = offset(lines, numbers)?;
    match lines.line("}")? {
        "}" => Ok(offset),
        line => Err(lines.fault(unlike("}", line))),
    }
}

fn offset(lines: &Lines<'_>, numbers: &str) -> Result<DVec3, BvhError> {
    let numbers: Vec<f64> =
        numbers.split_whitespace().map(|word| number(lines, word)).collect::<Result<_, _>>()?;
    match numbers[..] {
        [x, y, z] => Ok(DVec3::new(x, y, z)),
        _ => Err(lines.fault(words!("an offset has three numbers, this one {n}", n = numbers.len()))),
    }
}

fn channels(lines: &Lines<'_>, words: &str) -> Result<Vec<Channel>, BvhError> {
    let mut words = words.split_whitespace();
    let count = words.next().and_then(|word| word.parse::<usize>().ok());
    let count = count.filter(|&count| count <= MOST_CHANNELS);
    let count = count.ok_or_else(|| {
        lines.fault(words!("CHANNELS takes a number from 0 to {most} first", most = MOST_CHANNELS))
    })?;
    let mut channels = Vec::new();
    for word in words {
        let channel = match word.to_ascii_lowercase().as_str() {
            "xposition" => Channel::Position(0),
            "yposition" => Channel::Position(1),
            "zposition" => Channel::Position(2),
            "xrotation" => Channel::Rotation(0),
            "yrotation" => Channel::Rotation(1),
            "zrotation" => Channel::Rotation(2),
            _ => return Err(lines.fault(words!("there is no channel \"{name}\"", name = short(word)))),
        };
        if channels.contains(&channel) {
            return Err(lines.fault(words!("the channel {name} is there twice", name = word)));
        }
        channels.push(channel);
    }
    match channels.len() == count {
        true => Ok(channels),
        false => Err(lines.fault(words!(
            "{count} channels are announced, {n} are named",
            count,
            n = channels.len()
        ))),
    }
}

/// Reads the lines "MOTION", "Frames: 60" and "Frame Time: 0.0333"; returns the number of frames and the seconds between them.
fn header(lines: &mut Lines<'_>) -> Result<(usize, f64), BvhError> {
    let line = lines.line("MOTION")?;
    if after(line, "MOTION").is_none() {
        let words = match after(line, "ROOT") {
            Some(_) => words!("a second ROOT: only files of one skeleton are read"),
            None => unlike("MOTION", line),
        };
        return Err(lines.fault(words));
    }
    let frames = told(lines, "Frames")?;
    if frames < 1.0 || frames.fract() != 0.0 {
        return Err(lines.fault(words!("a motion has one frame or more")));
    }
    let time = told(lines, "Frame Time")?;
    match FRAME_TIME.contains(&time) {
        true => Ok((frames as usize, time)),
        false => Err(lines.fault(words!("{time} is no number of seconds from frame to frame", time))),
    }
}

/// Reads a line "NAME: number" and returns the number.
fn told(lines: &mut Lines<'_>, name: &str) -> Result<f64, BvhError> {
    let line = lines.line(name)?;
    let value = after(line, name).and_then(|rest| rest.strip_prefix(':'));
    let value = value.ok_or_else(|| lines.fault(unlike(&format!("\"{name}:\""), line)))?;
    number(lines, value.trim())
}

fn rows(lines: &mut Lines<'_>, frames: usize, clip: &mut Clip) -> Result<(), BvhError> {
    let channels = clip.channels();
    if channels == 0 {
        return Err(lines.fault(words!("no joint has a channel: nothing moves")));
    }
    if frames.saturating_mul(channels) > MOST_VALUES {
        return Err(BvhError::OverLimit(words!(
            "more than {most} numbers in all frames",
            most = MOST_VALUES
        )));
    }
    for frame in 0..frames {
        let line = lines.line_of(|| words!("frame {n} of {frames}", n = frame + 1, frames))?;
        let before = clip.values.len();
        for word in line.split_whitespace() {
            let value = number(lines, word)?;
            if clip.values.len() - before == channels {
                return Err(lines.fault(words!("a frame has {channels} numbers, this one more", channels)));
            }
            clip.values.push(value);
        }
        let found = clip.values.len() - before;
        if found < channels {
            return Err(lines.fault(words!(
                "a frame has {channels} numbers, this one {found}",
                channels,
                found
            )));
        }
    }
    if let Some(line) = lines.peek() {
        lines.next += 1;
        return Err(lines.fault(words!(
            "{frames} frames are announced, and still \"{found}\" follows",
            frames,
            found = short(line)
        )));
    }
    Ok(())
}

#[cfg(test)]
#[path = "bvh_tests.rs"]
mod tests;
