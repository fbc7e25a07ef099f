//! `toile techpack` from outside: pages that can be read back, the same bits, and what is refused.

use std::sync::Arc;

use glam::DVec2;
use toile::io::svg;
use toile::pattern::{Pattern, Piece};
use toile::session::Project;

use crate::program::{Place, adapter_required, has_between_digits};

/// The words of each page; a word that is broken into lines stands in several.
fn pages(place: &Place, name: &str) -> Vec<String> {
    let pdf = lopdf::Document::load(place.path(name)).expect("a PDF");
    pdf.get_pages().keys().map(|page| pdf.extract_text(&[*page]).expect("words")).collect()
}

fn images(place: &Place, name: &str) -> usize {
    let pdf = lopdf::Document::load(place.path(name)).expect("a PDF");
    let first = pdf.get_pages()[&1];
    pdf.get_page_images(first).expect("images").len()
}

#[test]
fn a_dressed_garment_is_told_with_its_ease_and_drawn_where_it_can_be() {
    let place = Place::new();
    place.run("dress sample:skirt --edge-length 0.03 --out out --save dressed.toile");
    let out = place.ends(0, "techpack dressed.toile -o pack.pdf --seconds 0.2 --json").out;
    let pack: serde_json::Value = serde_json::from_str(&out).expect("JSON");
    assert_eq!(pack["seams"].as_array().map(Vec::len), Some(16));
    let rows = pack["pieces"].as_array().expect("pieces");
    assert_eq!(rows.iter().map(|row| row["cut"].as_u64().expect("a number")).sum::<u64>(), 4);
    let ease = pack["ease"].as_array().expect("girths");
    assert!(ease.iter().any(|girth| girth["name"] == "hip"), "{ease:?}");
    assert!(pack["cloths"][0]["taken"][0]["length"].as_f64().is_some_and(|metres| metres > 0.3));
    let pages = pages(&place, "pack.pdf");
    let whole = pages.concat();
    for words in ["dressed", "Cloth needed", "Girth", "Ease", "Pieces", "Seams", "no pictures of the garment"]
    {
        assert!(whole.contains(words), "{words}: {whole}");
    }
    let last = format!("Page {0} of {0}", pages.len());
    assert!(pages[pages.len() - 1].contains(&last), "{last}");
    assert_eq!(images(&place, "pack.pdf"), 0);
    let bytes = std::fs::read(place.path("pack.pdf")).expect("a file");
    place.ends(0, "techpack dressed.toile -o again.pdf --seconds 0.2 --threads 1");
    assert!(bytes == std::fs::read(place.path("again.pdf")).expect("a file"), "the same bits");
    let drawn = place.draws("techpack dressed.toile -o drawn.pdf --seconds 0");
    if drawn.err.contains("pictures left out") {
        assert!(!adapter_required(), "{}", drawn.err);
        return;
    }
    assert_eq!((drawn.code, images(&place, "drawn.pdf")), (0, 2), "{}", drawn.err);
}

#[test]
fn in_german_its_heads_and_numbers_are_german_and_its_contents_stay_english() {
    let place = Place::new();
    place.run("dress sample:skirt --edge-length 0.03 --out out --save dressed.toile");
    let english = place.ends(0, "techpack dressed.toile -o en.pdf --seconds 0 --json").out;
    let german = place.ends(0, "techpack dressed.toile -o de.pdf --seconds 0 --json --language de").out;
    assert_eq!(german, english, "what programs read is as it was");
    let [english, german] = ["en.pdf", "de.pdf"].map(|name| pages(&place, name).concat());
    for (ours, theirs) in [
        ("Tech pack", "Produktionsblatt"),
        ("Cloth needed", "Stoffbedarf"),
        ("Measures of the garment", "Fertigmaße"),
        ("Girth", "Umfang"),
        ("Ease", "Mehrweite"),
        ("Seams", "Nähte"),
        ("To be sewn", "Zu nähen"),
        ("Page", "Seite"),
        ("hip", "Hüfte"),
        ("allowance", "Nahtzugabe"),
        ("adapter", "Grafikkarte"),
    ] {
        assert!(english.contains(ours) && !german.contains(ours), "{ours}: {german}");
        assert!(german.contains(theirs) && !english.contains(theirs), "{theirs}: {german}");
    }
    let version = env!("CARGO_PKG_VERSION");
    assert!(
        has_between_digits(&german, ',') && !has_between_digits(&german.replace(version, ""), '.'),
        "{german}"
    );
    place.ends(0, "techpack dressed.toile -o narrow.pdf --seconds 0 --width 0.1 --language de");
    let narrow = pages(&place, "narrow.pdf").concat();
    assert!(narrow.contains("braucht") && !narrow.contains("needs"), "{narrow}");
    assert!(!has_between_digits(&narrow.replace(version, ""), '.'), "{narrow}");
    place.ends_with_words(2, "techpack dressed.toile -o xx.pdf --language xx", "there are en, de");
}

#[test]
fn every_size_is_measured_and_given_its_cloth() {
    let place = crate::sizes::place();
    let out = place.ends(0, "techpack skirt.toile -o pack.pdf --seconds 0 --json").out;
    let pack: serde_json::Value = serde_json::from_str(&out).expect("JSON");
    let taken = pack["cloths"][0]["taken"].as_array().expect("sizes");
    assert_eq!(
        taken.iter().map(|t| t["size"].as_str().expect("a name")).collect::<Vec<_>>(),
        ["S", "M", "L"]
    );
    let width = |size: usize| pack["measures"][size]["pieces"][0][0].as_f64().expect("a width");
    assert!(width(0) < width(1) && width(1) < width(2));
    let whole = pages(&place, "pack.pdf").concat();
    assert!(whole.contains("Pieces in each size") && whole.contains("drawn in M"), "{whole}");
}

#[test]
fn names_of_any_kind_and_many_pieces_fit_the_pages() {
    let place = Place::new();
    let mut project = Project::default();
    let mut pattern = Pattern::default();
    let square = [DVec2::ZERO, DVec2::X * 0.2, DVec2::splat(0.2), DVec2::Y * 0.2];
    for i in 0..150 {
        pattern.add_piece(Piece::polygon(
            &format!("Ärmel {i} {}", "sehr lang ".repeat(i % 20)),
            &square.map(|p| p * (1.0 + 0.01 * i as f64)),
        ));
    }
    pattern.add_piece(Piece::polygon("袖", &square));
    pattern.add_piece(Piece::polygon("sail", &square.map(|p| p * 100.0)));
    project.document.pattern = Arc::new(pattern);
    place.save("many.toile", &project);
    let ended = place.ends(0, "techpack many.toile -o pack.pdf --seconds 0");
    assert!(ended.out.contains("needs cloth of 2000.0 cm, and this is 150.0 cm wide"), "{}", ended.out);
    let pages = pages(&place, "pack.pdf");
    assert!(pages.len() > 10 && pages.concat().contains("boxes stand for them"), "{} pages", pages.len());
}

#[test]
fn what_cannot_be_told_is_refused() {
    let place = Place::new();
    place.write("none.svg", svg::write(&Pattern::default()).bytes);
    place.save("none.toile", &Project::default());
    for (code, run, words) in [
        (2, "techpack sample:skirt -o pack.svg", "the ending must be .pdf"),
        (2, "techpack sample:skirt -o pack.pdf --width 0", "is no width of cloth"),
        (2, "techpack sample:skirt -o pack.pdf --seconds -1", ""),
        (2, "techpack sample:skirt -o pack.pdf --seconds nan", "NaN seconds"),
        (3, "techpack none.toile -o pack.pdf", "none.toile: the pattern has no pieces"),
        (3, "techpack none.svg -o pack.pdf", "none.svg"),
        (3, "techpack sample:sock -o pack.pdf", "sock"),
        (6, "techpack missing.toile -o pack.pdf", "missing.toile"),
        (6, "techpack sample:skirt -o nowhere/pack.pdf --seconds 0", "nowhere"),
    ] {
        place.ends_with_words(code, run, words);
    }
    assert!(!place.path("pack.pdf").exists());
}
