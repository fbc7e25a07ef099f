//! Reads and writes marks as a JSON file of their own, which refers to pieces by name:
//!
//! ```json
//! {"pairs": [{"piece": "front", "cloth": [[x, y], …], "side": "front", "body": [[x, y, z], …]}, …]}
//! ```
//!
//! Lengths are in metres; points on the cloth are in the piece's own plane; `side` is "front" (the outer side) by default. Pair
//! by pair, strokes get the numbers 1, 2, ….

use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

use crate::geometry::ids::MarkId;
use crate::geometry::words::{Words, within_quotes, words};
use crate::io::words::readable_words;
use crate::pattern::Pattern;
use crate::wrap::{BodyMark, ClothMark, ClothSide, Marks};

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    pairs: Vec<Pair>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Pair {
    piece: String,
    cloth: Vec<DVec2>,
    #[serde(default)]
    side: ClothSide,
    body: Vec<DVec3>,
}

/// The marks in `bytes` on the pieces of `pattern`, with ids from 1.
///
/// # Errors
/// In words: no JSON of this form, no pair, a piece that is not there, a stroke without points.
pub fn read(bytes: &[u8], pattern: &Pattern) -> Result<Marks, Words> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let file: File = serde_json::from_slice(bytes)
        .map_err(|e| readable_words(words!("not a file of marks: {why}", why = e.to_string())))?;
    if file.pairs.is_empty() {
        return Err(words!("the file has no pair of marks"));
    }
    let mut marks = Marks::default();
    for (i, pair) in file.pairs.into_iter().enumerate() {
        let number = i + 1;
        let Some(piece) = pattern.piece_named(&pair.piece) else {
            let names: Vec<&str> = pattern.pieces.values().map(|p| p.name.as_str()).collect();
            return Err(readable_words(words!(
                "pair {number}: there is no piece \"{piece}\", only {names}",
                number,
                piece = within_quotes(&pair.piece),
                names = names.join(", ")
            )));
        };
        if pair.cloth.is_empty() || pair.body.is_empty() {
            return Err(words!("pair {number}: a stroke needs at least one point", number));
        }
        let id = 2 * i as u32 + 1;
        marks.cloth.push(ClothMark { id: MarkId(id), piece, side: pair.side, points: pair.cloth });
        marks.body.push(BodyMark { id: MarkId(id + 1), points: pair.body });
    }
    Ok(marks)
}

/// The pairs of `marks` as the text of such a file. Strokes without a partner are left out.
pub fn write(marks: &Marks, pattern: &Pattern) -> Result<String, serde_json::Error> {
    let pair = |(cloth, body): (&ClothMark, &BodyMark)| {
        let piece = pattern.pieces.get(&cloth.piece)?.name.clone();
        Some(Pair { piece, cloth: cloth.points.clone(), side: cloth.side, body: body.points.clone() })
    };
    serde_json::to_string_pretty(&File { pairs: marks.pairs().filter_map(pair).collect() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Piece;

    fn pattern() -> Pattern {
        let mut pattern = Pattern::default();
        pattern.add_piece(Piece::polygon("front", &[DVec2::ZERO, DVec2::X, DVec2::Y]));
        pattern
    }

    const GOOD: &str =
        r#"{"pairs": [{"piece": "front", "cloth": [[0, 0.1]], "body": [[1, 2, 3], [1, 2, 4]]}]}"#;

    #[test]
    fn a_file_comes_back_as_it_was() {
        let marks = read(GOOD.as_bytes(), &pattern()).expect("marks");
        assert_eq!((marks.cloth.len(), marks.body[0].points[1]), (1, DVec3::new(1.0, 2.0, 4.0)));
        let text = write(&marks, &pattern()).expect("json");
        assert_eq!(read(text.as_bytes(), &pattern()).expect("marks"), marks);
    }

    #[test]
    fn faults_are_told_in_words() {
        let refused = |text: &str, word: &str| {
            let why = read(text.as_bytes(), &pattern()).expect_err("refused");
            assert!(why.contains(word), "{why}");
        };
        refused("", "not a file of marks");
        refused("{\"pairs\": []}", "no pair");
        refused(&GOOD.replace("\"front\"", "\"back\""), "no piece \"back\", only front");
        refused(&GOOD.replace("[[0, 0.1]]", "[]"), "at least one point");
        refused(&GOOD.replace("0.1", "1e999"), "not a file of marks");
        refused(&GOOD.replace("cloth", "clot"), "unknown field");
    }
}
