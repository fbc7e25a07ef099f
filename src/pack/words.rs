//! Texts, numbers and names as they are written on the pages, in the language that is shown.

use crate::io::words::readable;
use crate::language::sentences::translated_by;
use crate::language::{counted, decimal_signs, number, tr, translated};
use crate::session::Print;

/// Most characters of a name; the middle of a longer one is left out.
const LONGEST_NAME: usize = 120;
/// The entry where there is no value.
pub const NONE: &str = "–";

/// What the contents say in English, word by word; see `trims`, `seams`, `cloths` and `facts`. Of templates that fit a text the
/// longer comes first.
const TOLD: &[&str] = &[
    "{n}° outwards",
    "{n}° inwards",
    "cut to {n} % of the cloth",
    "{rows} at {mm} mm, stitches of {stitch} mm, rows {apart} mm apart",
    "{rows} at {mm} mm, stitches of {stitch} mm",
    "{cm} cm turned in",
    "for {mm} mm",
    "an image, {cm} cm wide",
    "{name}, {cm} cm wide",
    "button of {mm} mm",
    "zip in seam {n}",
    "elastic, cut to its length at rest",
    "topstitching in this thread, length of its lines",
    "{motif} every {cm} cm, {name}",
    "No piece has a seam allowance: the cutting lines are the seam lines. Add it before cutting; the cloth needed grows by it.",
    "{n} of {count} pieces have no seam allowance.",
    "Hems are turned in: their width is cloth beyond the edge.",
    "No grainline is drawn on {n} of {count} pieces: their own upright is taken for it.",
    "The pattern has changed since it was dressed: pictures, girths and openings are of its earlier state.",
    "it is not dressed",
    "they were not wanted",
    "there is no graphics adapter to draw with",
];

/// Where something is on a piece, in English, unless the edge or line has a name of its own.
const PLACES: &[&str] = &[
    "edge {n} from {from} to {to} %",
    "edge {n}",
    "edges {from} to {to}",
    "line {n}",
    "button {n}",
    "seam {n}",
    "graphic {n}",
    "{name} from {from} to {to} %",
    "an edge that is not there",
];

/// A text of the contents in the language that is shown; as it is where it is not known.
pub fn told(english: &str) -> String {
    translated_by(TOLD, english, |name, value| match name {
        "name" => value.to_owned(),
        "motif" => tr(value).to_owned(),
        "rows" => value.split(' ').next().and_then(|n| n.parse().ok()).map_or_else(|| value.to_owned(), rows),
        _ => decimal_signs(value),
    })
    .unwrap_or_else(|| english.to_owned())
}

/// A measure, which may be a bare number with its unit: "11.0 mm".
pub fn measure(english: &str) -> String {
    let is_bare = english.strip_suffix(" mm").is_some_and(|number| number.parse::<f64>().is_ok());
    if is_bare { decimal_signs(english) } else { told(english) }
}

/// A place on a piece in the language that is shown; as it is where it has a name of its own.
pub fn place(english: &str) -> String {
    translated_by(PLACES, english, |name, value| match name {
        "from" | "to" => end(value),
        _ => value.to_owned(),
    })
    .unwrap_or_else(|| english.to_owned())
}

/// An end of a stretch of edges: "3", "3 at 50 %".
fn end(english: &str) -> String {
    let known = translated_by(&["{n} at {percent} %"], english, |_, value| value.to_owned());
    known.unwrap_or_else(|| english.to_owned())
}

/// Rows of stitches, counted.
pub fn rows(n: usize) -> String {
    counted(n, "1 row", "{n} rows")
}

/// Name of what is worked on a piece, from its English name in the contents.
pub fn worked(what: &'static str) -> &'static str {
    let text = match what {
        "fold" => translated("Fold line"),
        "elastic" => translated("Elastic"),
        "topstitching" => translated("Topstitching"),
        "hem" => translated("Hem"),
        "button" => translated("Button"),
        "buttonhole" => translated("Buttonhole"),
        "zip" => translated("Zip"),
        "graphic" => translated("Print on the piece"),
        _ => None,
    };
    text.unwrap_or(what)
}

/// `n` of what is worked at a point.
pub fn worked_times(what: &'static str, n: usize) -> String {
    match what {
        "button" => counted(n, "1 button", "{n} buttons"),
        "buttonhole" => counted(n, "1 buttonhole", "{n} buttonholes"),
        "graphic" => counted(n, "1 graphic", "{n} graphics"),
        what => worked(what).to_owned(),
    }
}

/// A length in centimetres, to a millimetre, in the language that is shown.
pub fn cm(metres: f64) -> String {
    minus(number(metres * 100.0, 1))
}

/// A length in centimetres with its sign, to a millimetre, in the language that is shown.
pub fn signed_cm(metres: f64) -> String {
    minus(crate::language::signed(metres * 100.0, 1))
}

/// With a minus sign in place of the hyphen, and none before zero.
pub fn minus(number: String) -> String {
    let digits = number.trim_start_matches(['-', '+']);
    if digits.chars().all(|c| !c.is_ascii_digit() || c == '0') {
        return digits.to_owned();
    }
    number.replace('-', "−")
}

/// "1 row", "2 rows", in English.
pub fn count(n: usize, one: &str) -> String {
    format!("{n} {one}{}", if n == 1 { "" } else { "s" })
}

/// A sentence in one line, without characters that could mislead a reader.
pub fn line(words: &str) -> String {
    readable(words).replace('\n', " ").trim().to_owned()
}

/// A name in one line, without characters that could mislead a reader, and not too long.
pub fn name(words: &str) -> String {
    let plain = line(words);
    if plain.is_empty() {
        return tr("(no name)").to_owned();
    }
    let count = plain.chars().count();
    if count <= LONGEST_NAME {
        return plain;
    }
    let half = LONGEST_NAME / 2;
    let start: String = plain.chars().take(half).collect();
    let end: String = plain.chars().skip(count - half).collect();
    format!("{start}…{end}")
}

/// A colour as it is written in drawing programs: "#1f5fbf".
pub fn colour([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// A print with its repeat and colour.
pub fn print(print: Print) -> String {
    format!("{} every {:.1} cm, {}", print.motif.name(), print.repeat_m * 100.0, colour(print.colour))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::language::{Table, shown_in};

    #[test]
    fn what_the_contents_say_is_told_in_german() {
        let table = Table::german().expect("it is built in");
        for template in TOLD.iter().chain(PLACES) {
            assert!(table.text(template).is_some(), "not in German: {template}");
        }
        shown_in(Some(table), || {
            for (english, german) in [
                (
                    "2 rows at 5.0 mm, stitches of 3.5 mm, rows 6.0 mm apart",
                    "2 Reihen bei 5,0 mm, Stiche von 3,5 mm, Reihenabstand 6,0 mm",
                ),
                ("1 row at 5.0 mm, stitches of 3.5 mm", "1 Reihe bei 5,0 mm, Stiche von 3,5 mm"),
                ("dots every 2.5 cm, #aa1.2", "Punkte, Rapport 2,5 cm, #aa1.2"),
                ("v1.5.png, 8.0 cm wide", "v1.5.png, 8,0 cm breit"),
                ("zip in seam 4", "Reißverschluss in Naht 4"),
                ("2 of 4 pieces have no seam allowance.", "2 von 4 Teilen haben keine Nahtzugabe."),
                ("something new", "something new"),
            ] {
                assert_eq!(told(english), german);
            }
            assert_eq!([measure("11.0 mm"), measure("for 11.0 mm")], ["11,0 mm", "für 11,0 mm"]);
            for (english, german) in [
                ("edge 1 from 20 to 80 %", "Kante 1 von 20 bis 80 %"),
                ("edges 0 at 50 % to 1 at 25 %", "Kanten 0 bei 50 % bis 1 bei 25 %"),
                ("edges 0 to 2", "Kanten 0 bis 2"),
                ("side 1.5 from 20 to 80 %", "side 1.5 von 20 bis 80 %"),
                // The name of an edge is the user's, even if it is a word of the program.
                ("hem", "hem"),
            ] {
                assert_eq!(place(english), german);
            }
            assert_eq!([worked("hem"), worked("fold")], ["Saum", "Bruchlinie"]);
            assert_eq!([worked_times("button", 1), worked_times("button", 3)], ["1 Knopf", "3 Knöpfe"]);
            assert_eq!([cm(-0.1234), signed_cm(-0.0001)], ["−12,3", "0,0"]);
        });
        assert_eq!([worked("hem").to_owned(), worked_times("button", 3)], ["hem", "3 buttons"]);
        assert_eq!(told("zip in seam 4"), "zip in seam 4");
    }

    #[test]
    fn numbers_and_names_are_written_for_people() {
        assert_eq!([cm(-0.1234), cm(-0.0001), signed_cm(0.02)], ["−12.3", "0.0", "+2.0"]);
        assert_eq!(
            [signed_cm(-0.0001), count(1, "piece"), count(0, "piece")],
            ["0.0", "1 piece", "0 pieces"]
        );
        assert_eq!(name(" a\nb "), "a b");
        assert_eq!(name("a\u{202e}b"), "a\\u{202e}b");
        assert_eq!(name(""), "(no name)");
        assert_eq!(name(&"å".repeat(1000)).chars().count(), LONGEST_NAME + 1);
    }
}
