//! Damage to the structure of formats: values of JSON, lines, chunks of GLB, entries of zips. Lengths and checksums are correct
//! afterwards, so that the damage gets past the outermost check.

use std::io::{Cursor, Read, Write};

use serde_json::Value;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

use super::damage::{self, MOST_BYTES};
use crate::geometry::random::Random;
use crate::io::glb::container;

/// Structure of a format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Lines, words and numbers.
    Text,
    /// Pairs of lines, a code and a value: DXF.
    Tags,
    /// A single JSON value.
    Json,
    /// A JSON value on each line.
    Lines,
    /// A JSON value on each line, preceded by its checksum.
    Journal,
    /// Binary glTF: a JSON chunk, then a chunk of numbers.
    Glb,
    /// Zip with entries of JSON or numbers.
    Zip,
    /// Unknown structure.
    Bytes,
}

/// Makes one random change to a file of structure `form`; `other` is another valid file.
pub fn change(form: Form, bytes: Vec<u8>, other: &[u8], random: &mut Random) -> Vec<u8> {
    // The outermost check is also tested.
    let is_outer = random.chance(0.25);
    match form {
        Form::Tags if !is_outer => tags(bytes, random),
        Form::Json if !is_outer => json(bytes, random),
        Form::Lines if !is_outer => line(bytes, random, json),
        Form::Journal if !is_outer => line(bytes, random, summed),
        Form::Glb if !is_outer => glb(bytes, random),
        Form::Zip if !is_outer => zip(bytes, random),
        Form::Glb | Form::Zip | Form::Bytes => binary(bytes, random),
        Form::Text | Form::Tags | Form::Json | Form::Lines | Form::Journal => {
            let mut bytes = bytes;
            damage::text(&mut bytes, other, random);
            bytes
        }
    }
}

fn binary(mut bytes: Vec<u8>, random: &mut Random) -> Vec<u8> {
    damage::binary(&mut bytes, random);
    bytes
}

/// Changes a code or value of a DXF file, or removes, repeats or reorders pairs; every value stays behind a code.
fn tags(bytes: Vec<u8>, random: &mut Random) -> Vec<u8> {
    let lines: Vec<&[u8]> = bytes.split(|b| *b == b'\n').collect();
    let mut tags: Vec<[Vec<u8>; 2]> =
        lines.as_chunks::<2>().0.iter().map(|pair| pair.map(<[u8]>::to_vec)).collect();
    if tags.is_empty() {
        return bytes;
    }
    let [at, other] = [(); 2].map(|()| random.below(tags.len()));
    let end = (at + 1 + random.below(30)).min(tags.len());
    match random.below(9) {
        0..=2 => tags[at][1] = damage::odd_number(random).as_bytes().to_vec(),
        3 => tags[at][1] = tags[other][1].clone(),
        4 => tags[at][0] = tags[other][0].clone(),
        5 => _ = tags.drain(at..end),
        6 => tags.swap(at, other),
        7 => tags.truncate(at),
        _ => {
            let chunk = tags[at..end].to_vec();
            let room = MOST_BYTES / (16 * chunk.len());
            let times = [1, 10, 1_000, 100_000][random.below(4)].min(room);
            tags.splice(end..end, std::iter::repeat_n(chunk, times).flatten());
        }
    }
    let mut written = tags.into_iter().flatten().collect::<Vec<_>>().join(&b'\n');
    written.push(b'\n');
    written
}

/// Changes a line by `change`, or removes, repeats or reorders lines.
fn line(bytes: Vec<u8>, random: &mut Random, change: fn(Vec<u8>, &mut Random) -> Vec<u8>) -> Vec<u8> {
    let mut lines: Vec<Vec<u8>> = bytes.split(|b| *b == b'\n').map(<[u8]>::to_vec).collect();
    let at = random.below(lines.len());
    match random.below(8) {
        0 => _ = lines.remove(at),
        1 => lines.insert(at, lines[random.below(lines.len())].clone()),
        2 => {
            let other = random.below(lines.len());
            lines.swap(at, other);
        }
        _ => lines[at] = change(std::mem::take(&mut lines[at]), random),
    }
    lines.join(&b'\n')
}

/// Changes the JSON of a journal line "1234abcd {...}", and writes the checksum of the result.
fn summed(bytes: Vec<u8>, random: &mut Random) -> Vec<u8> {
    let json = json(bytes.get(9..).unwrap_or_default().to_vec(), random);
    let mut summed = format!("{:08x} ", crc32fast::hash(&json)).into_bytes();
    summed.extend(json);
    summed
}

/// Changes one random value. Bytes that are not JSON are changed as text.
pub fn json(mut bytes: Vec<u8>, random: &mut Random) -> Vec<u8> {
    let Ok(mut root) = serde_json::from_slice::<Value>(&bytes) else {
        damage::text(&mut bytes, &[], random);
        return bytes;
    };
    let count = size(&root);
    let mut nth = random.below(count);
    let other = {
        let mut nth = random.below(count);
        picked(&mut root, &mut nth).map(|value| value.clone()).unwrap_or_default()
    };
    if let Some(value) = picked(&mut root, &mut nth) {
        change_value(value, other, random);
    }
    let mut written = serde_json::to_vec(&root).unwrap_or_default();
    if random.chance(0.2) {
        // Numbers that a JSON value cannot hold, such as 1e999 and NaN.
        damage::number(&mut written, random);
    }
    if written.len() > MOST_BYTES.max(4 * bytes.len()) { bytes } else { written }
}

fn size(value: &Value) -> usize {
    1 + match value {
        Value::Array(items) => items.iter().map(size).sum(),
        Value::Object(fields) => fields.values().map(size).sum(),
        _ => 0,
    }
}

/// The `nth` value, counted depth first from the outermost.
fn picked<'a>(value: &'a mut Value, nth: &mut usize) -> Option<&'a mut Value> {
    if *nth == 0 {
        return Some(value);
    }
    *nth -= 1;
    match value {
        Value::Array(items) => items.iter_mut().find_map(|item| picked(item, nth)),
        Value::Object(fields) => fields.values_mut().find_map(|field| picked(field, nth)),
        _ => None,
    }
}

fn change_value(value: &mut Value, other: Value, random: &mut Random) {
    match (random.below(6), &mut *value) {
        (0, _) => *value = other,
        (1, _) => {
            let depth = [1, 2, 30, 100][random.below(4)];
            *value = (0..depth).fold(value.take(), |inner, _| Value::Array(vec![inner]));
        }
        (2, _) => *value = odd_value(random),
        (_, Value::Number(_)) => *value = odd_value(random),
        (_, Value::String(text)) => *text = odd_text(text, random),
        (_, Value::Array(items)) => change_items(items, other, random),
        (_, Value::Object(fields)) => {
            let keys: Vec<String> = fields.keys().cloned().collect();
            let Some(key) = keys.get(random.below(keys.len().max(1))) else { return };
            match random.below(3) {
                0 => _ = fields.insert(key.clone(), other),
                1 => {
                    let held = fields.remove(key).unwrap_or_default();
                    fields.insert(odd_text(key, random), held);
                }
                _ => _ = fields.remove(key),
            }
        }
        (_, Value::Null | Value::Bool(_)) => *value = odd_value(random),
    }
}

fn change_items(items: &mut Vec<Value>, other: Value, random: &mut Random) {
    let at = random.below(items.len().max(1));
    match random.below(6) {
        0 => items.clear(),
        1 if !items.is_empty() => _ = items.remove(at),
        2 if !items.is_empty() => {
            let item = items[at].clone();
            let room = MOST_BYTES / (8 * size(&item));
            items.extend(std::iter::repeat_n(item, [1, 3, 100, 5_000][random.below(4)].min(room)));
        }
        3 => items.reverse(),
        4 => items.truncate(at),
        _ => items.push(other),
    }
}

fn odd_value(random: &mut Random) -> Value {
    match random.below(12) {
        0 => Value::Null,
        1 => Value::Bool(true),
        2 => Value::String(String::new()),
        3 => Value::Array(Vec::new()),
        4 => Value::Object(serde_json::Map::new()),
        5 => Value::from(u64::MAX),
        6 => Value::from(i64::MIN),
        _ => Value::from(
            [
                0.0,
                -1.0,
                1.0,
                0.5,
                2.0,
                1e-300,
                1e-9,
                1e-3,
                100.0,
                1e4,
                1e6,
                1e9,
                1e20,
                1e308,
                -1e308,
                4294967295.0,
            ][random.below(16)],
        ),
    }
}

fn odd_text(text: &str, random: &mut Random) -> String {
    match random.below(10) {
        0 => String::new(),
        1 => text.repeat(1 + 3000 / text.len().max(1)),
        2 => format!("{text}\0"),
        3 => format!("\u{202e}{text}\u{7}"),
        4 => "../../evil".to_owned(),
        5 => "/etc/passwd".to_owned(),
        6 => "%ff%2e%2e/evil".to_owned(),
        7 => "data:application/octet-stream;base64,AAAA====".to_owned(),
        8 => text.to_uppercase(),
        _ => format!("{text} "),
    }
}

/// Changes the JSON or the numbers of a GLB file, and corrects the lengths of the chunks.
fn glb(bytes: Vec<u8>, random: &mut Random) -> Vec<u8> {
    let whole =
        |at: usize| bytes.get(at..at + 4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as usize);
    let parts = whole(12).and_then(|length| {
        let json = bytes.get(20..20 + length)?.to_vec();
        Some((json, bytes.get(28 + length..).unwrap_or_default().to_vec()))
    });
    let Some((mut text, mut numbers)) = parts else { return binary(bytes, random) };
    match random.chance(0.7) {
        true => text = json(text, random),
        false => damage::binary(&mut numbers, random),
    }
    container(text, numbers).unwrap_or(bytes)
}

/// Changes, removes or adds an entry of a zip, and packs all of them again.
fn zip(bytes: Vec<u8>, random: &mut Random) -> Vec<u8> {
    let Some(mut entries) = entries(&bytes) else { return binary(bytes, random) };
    let at = random.below(entries.len());
    match random.below(12) {
        0 => _ = entries.remove(at),
        1 => {
            let name = ["../../evil", "/evil", "..\\evil", "PROJECT.JSON", "a/./b"][random.below(5)];
            entries.push((name.to_owned(), b"evil".to_vec()));
        }
        2 => entries.extend((0..random.below(100)).map(|i| (format!("entry {i}"), Vec::new()))),
        3 => {
            let other = random.below(entries.len());
            let held = entries[other].1.clone();
            entries[at].1 = held;
        }
        4 => entries[at].1.resize(4 << 20, 0),
        _ => {
            let (name, held) = &mut entries[at];
            *held = match name.ends_with(".json") {
                true => json(std::mem::take(held), random),
                false => binary(std::mem::take(held), random),
            };
        }
    }
    packed(&entries).unwrap_or(bytes)
}

fn entries(bytes: &[u8]) -> Option<Vec<(String, Vec<u8>)>> {
    let mut zip = ZipArchive::new(Cursor::new(bytes)).ok()?;
    let mut entries = Vec::new();
    for i in 0..zip.len() {
        let mut file = zip.by_index(i).ok()?;
        let name = file.name().ok()?.into_owned();
        let mut held = Vec::new();
        (&mut file).take(8 << 20).read_to_end(&mut held).ok()?;
        entries.push((name, held));
    }
    (!entries.is_empty()).then_some(entries)
}

fn packed(entries: &[(String, Vec<u8>)]) -> Option<Vec<u8>> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, held) in entries {
        // Deflating takes longer than all else.
        let method =
            if held.len() > MOST_BYTES { CompressionMethod::Deflated } else { CompressionMethod::Stored };
        zip.start_file(name.as_str(), SimpleFileOptions::default().compression_method(method)).ok()?;
        zip.write_all(held).ok()?;
    }
    Some(zip.finish().ok()?.into_inner())
}
