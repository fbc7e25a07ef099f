//! Texts, numbers and names as they are written on the pages, in the language that is shown.

use crate::geometry::words::{Words, decimal, words};
use crate::io::words::readable;
use crate::language::{counted, number, tr, translated};
use crate::session::Print;

/// Most characters of a name; the middle of a longer one is left out.
const LONGEST_NAME: usize = 120;
/// The entry where there is no value.
pub const NONE: &str = "–";

/// Why pictures are left out where none can be drawn.
pub fn no_adapter() -> Words {
    words!("there is no graphics adapter to draw with")
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
        "tack" => translated("Tack"),
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
        "tack" => counted(n, "1 tack", "{n} tacks"),
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
pub fn print(print: Print) -> Words {
    words!(
        "{motif} every {cm} cm, {name}",
        motif = Words::listed(print.motif.name()),
        cm = decimal(print.repeat_m * 100.0, 1),
        name = colour(print.colour)
    )
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::DVec2;

    use super::*;
    use crate::geometry::ids::{GraphicId, ImageId};
    use crate::language::{Table, said, shown_in};
    use crate::pack::drawing::WORKED;
    use crate::pack::trims::{supplies, trims};
    use crate::pattern::{
        Button, EdgeRef, Elastic, Fold, Hem, Pattern, Piece, PiecePoint, Piping, Seam, Topstitch, Trims, Zip,
    };
    use crate::session::{Artwork, Graphic, ImageFile, Motif};

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
        pattern.add_button(Button {
            button,
            hole,
            diameter: 0.011,
            colour: Button::PEARL,
            open: false,
            tack: false,
        });
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
                    assert_ne!(said(at), at.as_str());
                }
                // Of a zip there is nothing but its length.
                assert_eq!(row.measures.is_empty(), row.what == "zip", "{row:?}");
                assert!(row.measures.is_empty() || said(&row.measures) != *row.measures, "{row:?}");
            }
            for supply in &supplies {
                assert_ne!(said(&supply.what), supply.what.as_str());
            }
        });
        for (_, meaning) in WORKED {
            assert!(table.text(meaning).is_some(), "not in German: {meaning}");
        }
    }

    #[test]
    fn names_of_the_user_are_no_words_of_the_program() {
        shown_in(Table::german(), || {
            let print = Print { motif: Motif::Dots, repeat_m: 0.025, colour: [0xaa, 1, 2] };
            assert_eq!(said(&super::print(print)), "Punkte, Rapport 2,5 cm, #aa0102");
            let mut piece = Piece::polygon("a", &[DVec2::ZERO, DVec2::X, DVec2::Y]);
            for (edge, name) in [(0, "hem"), (1, "side 1.5")] {
                piece.outline[edge].label = Some(name.to_owned());
                piece.outline[edge].trims = Trims { hem: Some(Hem::USUAL), ..Trims::default() };
            }
            let mut pattern = Pattern::default();
            pattern.add_piece(piece);
            let rows = trims(&pattern, &Artwork::default());
            assert_eq!(rows[0].places.iter().map(said).collect::<Vec<_>>(), ["hem", "side 1.5"]);
            assert_eq!(said(&rows[0].measures), "2,0 cm eingeschlagen");
            assert_eq!(["hem", "fold", "piping"].map(worked), ["Saum", "Bruchlinie", "Paspel"]);
            assert_eq!([worked_times("button", 1), worked_times("button", 3)], ["1 Knopf", "3 Knöpfe"]);
            assert_eq!([cm(-0.1234), signed_cm(-0.0001)], ["−12,3", "0,0"]);
        });
        assert_eq!([worked("hem").to_owned(), worked_times("button", 3)], ["hem", "3 buttons"]);
    }

    #[test]
    fn numbers_and_names_are_written_for_people() {
        assert_eq!([cm(-0.1234), cm(-0.0001), signed_cm(0.02)], ["−12.3", "0.0", "+2.0"]);
        assert_eq!(signed_cm(-0.0001), "0.0");
        assert_eq!(name(" a\nb "), "a b");
        assert_eq!(name("a\u{202e}b"), "a\\u{202e}b");
        assert_eq!(name(""), "(no name)");
        assert_eq!(name(&"å".repeat(1000)).chars().count(), LONGEST_NAME + 1);
    }
}
