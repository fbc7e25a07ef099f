//! `toile fit --page` from outside: one file, complete, sound, and with every word as it was written.

use std::collections::BTreeSet;
use std::sync::Arc;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use toile::session::project_file;

use crate::program::{Place, adapter_required, ended, has_between_digits};

/// Elements of HTML that are never closed.
const VOID: [&str; 3] = ["meta", "img", "br"];

/// A garment whose pieces have names that look like markup, dressed.
fn dressed() -> Place {
    let place = Place::new();
    let mut project = crate::common::project();
    let pattern = Arc::make_mut(&mut project.document.pattern);
    for (piece, name) in pattern.pieces.values_mut().zip(["<left> & \"right\"", "</table>'"]) {
        Arc::make_mut(piece).name = name.to_owned();
    }
    place.save("a<b>&c.toile", &project);
    place.run("dress a<b>&c.toile --out out --save a<b>&c.toile");
    place
}

/// Every element is closed, in order; words hold no stray signs.
fn check_nesting(page: &str) {
    let body = page.split_once("</style>").expect("a style").1;
    let mut open: Vec<&str> = vec!["html", "head"];
    for part in body.split('<').skip(1) {
        let (tag, words) = part.split_once('>').unwrap_or_else(|| panic!("no end: {part:.60}"));
        assert!(!words.contains('>'), "{words:.60}");
        let name = tag.split_whitespace().next().expect("a name").trim_start_matches('/');
        if tag.starts_with('/') {
            assert_eq!(open.pop(), Some(name), "{part:.60}");
        } else if !VOID.contains(&name) {
            open.push(name);
        }
    }
    assert!(open.is_empty(), "{open:?}");
}

fn attribute<'a>(tag: &'a str, name: &str) -> &'a str {
    let start = tag.split_once(&format!(" {name}=\"")).unwrap_or_else(|| panic!("{name} of {tag:.60}")).1;
    start.split_once('"').expect("a quote").0
}

#[test]
fn without_an_adapter_the_page_says_so_and_is_sound() {
    let place = dressed();
    place.ends(0, "fit a<b>&c.toile --page fit.html");
    assert_eq!(place.names("").iter().filter(|name| name.starts_with("fit")).count(), 1);
    let page = place.read("fit.html");
    check_nesting(&page);
    assert!(
        page.contains("pictures are left out: there is no graphics adapter to draw with.")
            && !page.contains("<img")
    );
    assert!(!page.contains("http:") && !page.contains("https:") && !page.contains("<script"));
    assert!(page.contains("<h1>a&lt;b&gt;&amp;c</h1>"));
    assert!(page.contains("&lt;left&gt; &amp; &quot;right&quot;") && page.contains("&lt;/table&gt;'"));
    let project = project_file::open(&place.path("a<b>&c.toile")).expect("the project");
    for seam in project.document.pattern.seams.keys() {
        assert!(page.contains(&format!("<th class=\"number\">{}</th>", seam.0)), "{seam}");
    }
    assert!(page.contains(">closed<") && page.contains("cotton"));
}

#[test]
fn every_picture_of_the_page_can_be_seen() {
    let place = dressed();
    let arguments = "fit a<b>&c.toile --page fit.html";
    let with_adapter = place.draws(arguments);
    assert_eq!(with_adapter.code, 0, "{with_adapter:?}");
    let page = place.read("fit.html");
    if page.contains("pictures are left out") && !adapter_required() {
        println!("no graphics adapter: pictures not tested");
        return;
    }
    check_nesting(&page);
    let pictures: Vec<&str> = page.split("<img").skip(1).collect();
    // Four sides, and front and back of at least strain, ease and curvature.
    assert!(pictures.len() >= 4 + 2 * 4, "{}", pictures.len());
    for tag in pictures {
        let source =
            attribute(tag, "src").strip_prefix("data:image/png;base64,").expect("in the page itself");
        let picture = image::load_from_memory(&STANDARD.decode(source).expect("base64")).expect("a picture");
        let size = [picture.width(), picture.height()].map(|side| side.to_string());
        assert_eq!([attribute(tag, "width"), attribute(tag, "height")], [&size[0], &size[1]]);
        let seen = picture.to_rgba8().pixels().filter(|pixel| pixel.0[3] == 255).count();
        assert!(seen > 1000, "{seen} pixels of {}", attribute(tag, "alt"));
    }
    for side in ["Front", "Right", "Back", "Left"] {
        assert!(page.contains(&format!("<figcaption>{side}</figcaption>")), "{side}");
    }
    assert_eq!(page.matches("<svg class=\"legend\"").count(), page.matches("<h3>").count());
}

#[test]
fn the_garment_is_held_against_the_body() {
    let place = Place::new();
    place.run("dress sample:skirt --out out --save skirt.toile");
    place.ends(0, "fit skirt.toile --page fit.html");
    let page = place.read("fit.html");
    let table =
        page.split("Garment and body").nth(1).and_then(|rest| rest.split("</table>").next()).expect("it");
    let row = |name: &str| table.split(&format!(">{name}</th>")).nth(1).expect(name);
    let cells = |name: &str| -> Vec<f64> {
        let cells = row(name).split("</tr>").next().expect("a row").split("</td>");
        let words = cells.filter_map(|cell| cell.rsplit('>').next());
        words.filter_map(|words| words.replace('\u{2212}', "-").parse().ok()).collect()
    };
    for name in ["waist", "hip"] {
        let [_, body, pattern, ease, ..] = cells(name)[..] else { panic!("{name}: {:?}", cells(name)) };
        assert!(
            (pattern - body - ease).abs() < 0.11 && (0.0..40.0).contains(&ease),
            "{name}: {:?}",
            cells(name)
        );
    }
    // The skirt goes round both legs, and nowhere near the bust.
    assert!(!table.contains(">knee<") && !table.contains(">bust<"));
}

#[test]
fn a_page_alone_needs_no_folder() {
    let place = Place::with_ball();
    place.ends_with_words(3, "fit ball.toile --page fit.html", "dress it first");
    place.ends_with_words(2, "fit ball.toile", "--map");
    place.ends_with_words(2, "fit ball.toile --map ease", "--out");
    assert_eq!(place.names(""), ["ball.toile"]);
}

/// What is written on the page, element by element.
fn texts(page: &str) -> Vec<&str> {
    let body = page.split_once("</style>").expect("a style").1;
    let parts = body.split('<').filter_map(|part| Some(part.split_once('>')?.1.trim()));
    parts.filter(|text| !text.is_empty()).collect()
}

#[test]
fn in_german_no_word_and_no_number_is_english() {
    let place = dressed();
    place.ends(0, "fit a<b>&c.toile --page en.html");
    place.ends(0, "fit a<b>&c.toile --page de.html --language de");
    let pages = ["en.html", "de.html"].map(|name| place.read(name));
    let [english, german] = pages.each_ref().map(|page| texts(page));
    assert_eq!(english.len(), german.len(), "the pages say the same");
    let is_word = |word: &str| word.chars().count() > 3 && word.chars().all(char::is_alphabetic);
    let is_english: BTreeSet<&str> =
        english.iter().copied().filter(|text| text.split(' ').any(is_word)).collect();
    assert!(is_english.len() > 40, "{is_english:?}");
    // The name of the program and its version.
    let plain = |text: &str| text.starts_with("Toile ");
    let left: Vec<&str> =
        german.iter().copied().filter(|text| is_english.contains(text) && !plain(text)).collect();
    assert!(left.is_empty(), "{left:?}");
    let points: Vec<&str> =
        german.iter().copied().filter(|text| has_between_digits(text, '.') && !plain(text)).collect();
    assert!(points.is_empty(), "{points:?}");
    assert!(german.iter().filter(|text| has_between_digits(text, ',')).count() > 20);
    for part in [
        "<html lang=\"de\">",
        "&amp;c: Passformbericht</title>",
        "Längen in Zentimetern",
        "Die Bilder fehlen: es gibt keine Grafikkarte zum Zeichnen.",
    ] {
        assert!(pages[1].contains(part), "{part}");
    }
    for attribute in ["The pattern", "The garment", "Ease: gap to the body"] {
        assert!(!pages[1].contains(&format!("\"{attribute}")), "{attribute}");
    }
    check_nesting(&pages[1]);
}

#[test]
fn a_language_that_is_not_there_is_refused() {
    let place = dressed();
    place.ends_with_words(2, "fit a<b>&c.toile --page fit.html --language xx", "there are en, de");
    assert!(!place.path("fit.html").exists());
    place.ends_with_words(2, "fit missing.toile --page fit.html --language xx", "there are en, de");
    place.ends(2, "fit a<b>&c.toile --map ease --out maps --language de");
}

#[test]
fn tables_of_languages_are_read_for_a_page_alone() {
    let place = dressed();
    // Where preferences are on each system.
    for folder in ["toile/languages", "Library/Application Support/toile/languages"] {
        std::fs::create_dir_all(place.path(folder)).expect("made");
        place.write(&format!("{folder}/broken.json"), "{");
    }
    let fit = |arguments: &str| {
        let mut command = place.command(&format!("fit a<b>&c.toile {arguments}"));
        for name in ["HOME", "XDG_CONFIG_HOME", "APPDATA"] {
            command.env(name, place.path(""));
        }
        let done = ended(command.output().expect("started"));
        assert_eq!(done.code, 0, "{done:#?}");
        done.err
    };
    assert!(fit("--page fit.html").contains("broken.json"));
    let err = fit("--map ease --out maps");
    assert!(!err.contains("broken.json"), "{err}");
}
