//! Texts, numbers and names as they are written on the pages, in the language that is shown.

use crate::io::words::readable;
use crate::language::sentences::translated_by;
use crate::language::{counted, decimal_signs, number, tr, translated};
use crate::session::Print;

/// Most characters of a name; the middle of a longer one is left out.
const LONGEST_NAME: usize = 120;
/// The entry where there is no value.
pub const NONE: &str = "–";
/// Why pictures are left out where none can be drawn.
pub const NO_ADAPTER: &str = "there is no graphics adapter to draw with";

/// What the contents say in English, word by word; see `trims`, `seams`, `cloths` and `facts`, and why there is no layout,
/// see `MarkerError`. Of templates that fit a text the longer comes first.
const TOLD: &[&str] = &[
    "{n}° outwards",
    "{n}° inwards",
    "cut to {n} % of the cloth",
    "{rows} at {mm} mm, stitches of {stitch} mm, rows {apart} mm apart",
    "{rows} at {mm} mm, stitches of {stitch} mm",
    "{cm} cm turned in",
    "for {mm} mm",
    "piping {mm} mm thick",
    "{mm} mm thick",
    "\"{name}\" needs cloth of {needs} cm, and this is {width} cm wide",
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
    NO_ADAPTER,
    "the pattern has no pieces to cut",
    "no garment is asked for: give a size a quantity of 1 or more",
    "{n} pieces would be cut; a marker holds {most}: make several",
    "\"{name}\" encloses no cloth: its outline has no area",
    "the layout was stopped",
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
        "piping" => translated("Piping"),
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
    use std::sync::Arc;

    use glam::DVec2;

    use super::*;
    use crate::geometry::ids::{GraphicId, ImageId};
    use crate::language::{Table, shown_in};
    use crate::marker::MarkerError;
    use crate::pack::drawing::WORKED;
    use crate::pack::trims::{supplies, trims};
    use crate::pattern::{
        Button, EdgeRef, Elastic, Fold, Hem, Pattern, Piece, PiecePoint, Piping, Seam, Topstitch, Trims, Zip,
    };
    use crate::session::{Artwork, Graphic, ImageFile};

    /// All that is worked along edges; a wrinkle is not.
    fn all_trims() -> Trims {
        Trims {
            fold: Some(Fold::pressed(1.0)),
            elastic: Some(Elastic::USUAL),
            topstitch: Some(Topstitch::default()),
            hem: Some(Hem::USUAL),
            piping: Some(Piping::USUAL),
            wrinkle: None,
        }
    }

    /// Two pieces with everything that can be worked on them.
    fn worked_everywhere() -> (Pattern, Artwork) {
        let corners = [DVec2::ZERO, DVec2::X * 0.4, DVec2::new(0.4, 0.2), DVec2::Y * 0.2];
        let mut piece = Piece::polygon("front", &corners);
        piece.outline[0].trims = all_trims();
        let rows = Topstitch { rows: 2, ..Topstitch::default() };
        let inwards = Some(Fold::pressed(-1.0));
        piece.outline[1].trims = Trims { fold: inwards, topstitch: Some(rows), ..Trims::default() };
        let mut pattern = Pattern::default();
        let front = pattern.add_piece(piece);
        let back = pattern.add_piece(Piece::polygon("back", &corners));
        let [button, hole] = [front, back].map(|piece| PiecePoint { piece, at: DVec2::splat(0.1) });
        pattern.add_button(Button { button, hole, diameter: 0.011, colour: Button::PEARL, open: false });
        let sides = [front, back].map(|piece| EdgeRef { piece, edge: 3 });
        pattern.add_seam(Seam { zip: Some(Zip::CLOSED), ..Seam::of_edges(sides, false) });
        let mut artwork = Artwork::default();
        artwork.images.insert(ImageId(1), Arc::new(ImageFile::new("v1.5.png", Vec::new())));
        for image in [1, 2] {
            let (image, at) = (ImageId(image), DVec2::splat(0.1));
            let graphic = Graphic { piece: front, image, at, width_m: 0.08, angle: 0.0, on_twin: false };
            artwork.graphics.insert(GraphicId(image.0), graphic);
        }
        (pattern, artwork)
    }

    #[test]
    fn all_that_is_worked_and_bought_is_told_in_german() {
        let (pattern, artwork) = worked_everywhere();
        let rows = trims(&pattern, &artwork);
        let Trims { fold, elastic, topstitch, hem, piping, wrinkle: _ } = all_trims();
        let along = [
            ("fold", fold.is_some()),
            ("elastic", elastic.is_some()),
            ("topstitching", topstitch.is_some()),
            ("hem", hem.is_some()),
            ("piping", piping.is_some()),
        ];
        let all =
            along.into_iter().chain(["button", "buttonhole", "zip", "graphic"].map(|what| (what, true)));
        for (what, is_worked) in all {
            assert!(is_worked && rows.iter().any(|row| row.what == what), "{what}");
        }
        let supplies = supplies(&pattern, &rows);
        for what in ["button", "zip", "elastic", "piping", "topstitching"] {
            assert!(supplies.iter().any(|supply| supply.what.starts_with(what)), "{what}");
        }
        let table = Table::german().expect("it is built in");
        shown_in(Some(table), || {
            for row in &rows {
                assert_ne!(worked(row.what), row.what);
                for at in &row.places {
                    assert_ne!(place(at), *at);
                }
                // Of a zip there is nothing but its length.
                assert_eq!(row.measures.is_empty(), row.what == "zip", "{row:?}");
                assert!(row.measures.is_empty() || measure(&row.measures) != row.measures, "{row:?}");
            }
            for supply in &supplies {
                assert_ne!(told(&supply.what), supply.what);
            }
        });
        for (_, meaning) in WORKED {
            assert!(table.text(meaning).is_some(), "not in German: {meaning}");
        }
    }

    #[test]
    fn why_there_is_no_layout_is_told_in_german() {
        let piece = || "v1.5, left".to_owned();
        let too_wide = MarkerError::TooWide { piece: piece(), needs: 2.0, width: 1.1 };
        for why in [
            MarkerError::Empty,
            MarkerError::Nothing,
            too_wide.clone(),
            MarkerError::TooMany(500),
            MarkerError::NoArea(piece()),
            MarkerError::Stopped,
        ] {
            match why {
                MarkerError::Empty
                | MarkerError::Nothing
                | MarkerError::TooWide { .. }
                | MarkerError::TooMany(_)
                | MarkerError::NoArea(_)
                | MarkerError::Stopped => {}
                // Sizes are those of the pattern, and a number that cannot be is refused before anything is written.
                MarkerError::Size(_) | MarkerError::Number(_) => panic!("on no page: {why}"),
            }
            let english = line(&why.to_string());
            assert_eq!(told(&english), english);
            shown_in(Table::german(), || assert_ne!(told(&english), english));
        }
        let words = shown_in(Table::german(), || told(&line(&too_wide.to_string())));
        assert_eq!(words, "„v1.5, left“ braucht 200,0 cm breiten Stoff, und dieser ist 110,0 cm breit");
    }

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
                ("piping 3.0 mm thick", "Paspel, 3,0 mm dick"),
                ("3.0 mm thick", "3,0 mm dick"),
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
            assert_eq!(["hem", "fold", "piping"].map(worked), ["Saum", "Bruchlinie", "Paspel"]);
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
