//! The pages of a tech pack.

use std::sync::Arc;

use image::RgbaImage;

use crate::geometry::ids::PieceId;
use crate::geometry::words::Words;
use crate::io::pdf::PdfError;
use crate::io::pdf::booklet::{self, Ink, Letters};
use crate::language::{counted, number, said, say, signed, tr};
use crate::pack::cloths::{Cloth, Taken};
use crate::pack::drawing::{self, Sketch};
use crate::pack::facts::{Pack, PieceRow};
use crate::pack::flow::{Cell, Flow, Table};
use crate::pack::trims::TrimRow;
use crate::pack::words::{self, NONE, cm, signed_cm};
use crate::pattern::Pattern;

/// Height of the pictures on the first page, millimetres.
const PICTURES: f64 = 104.0;
/// Height of the small drawings that stand in their place, millimetres.
const OVERVIEW: f64 = 96.0;
/// Sizes in one table.
const SIZES: usize = 8;
/// Angle up to which a grain counts as straight, cross or bias, degrees.
const ANGLE: f64 = 0.5;

/// A picture of the dressed garment.
#[derive(Clone, Debug)]
pub struct Picture {
    /// What it shows, such as "Front".
    pub title: &'static str,
    /// The picture, with straight alpha.
    pub image: Arc<RgbaImage>,
}

/// The pictures of the dressed garment.
#[derive(Clone, Debug)]
pub enum Pictures {
    Drawn(Vec<Picture>),
    /// There are none, and why.
    LeftOut(Words),
}

/// Writes the tech pack of `pattern` as PDF, in the language that is shown.
///
/// # Errors
/// See [`PdfError`].
pub fn write(pack: &Pack, pattern: &Pattern, pictures: &Pictures) -> Result<Vec<u8>, PdfError> {
    let mut flow = Flow::new(Letters::new()?);
    let cloth_of = |id: PieceId| pack.cloths.iter().find(|cloth| cloth.pieces.contains(&id.0));
    let sketches = Sketch::all(pattern, |id| cloth_of(id)?.colour);
    let name = words::name(&pack.name);
    flow.title(&name, &subtitle(pack));
    first_pictures(&mut flow, &sketches, pictures);
    notes(&mut flow, pack);
    cloths(&mut flow, pack);
    needed(&mut flow, pack);
    fit(&mut flow, pack);
    pieces(&mut flow, pack);
    trims(&mut flow, pack);
    supplies(&mut flow, pack);
    seams(&mut flow, pack);
    sizes(&mut flow, pack, pattern);
    colourways(&mut flow, pack);
    drawing::pages(&mut flow, &sketches);
    booklet::write(&name, &flow.finish(&name))
}

fn subtitle(pack: &Pack) -> String {
    let cut: usize = pack.pieces.iter().map(|row| row.cut).sum();
    let mut all = vec![
        tr("Tech pack").to_owned(),
        counted(cut, "1 piece", "{n} pieces"),
        counted(pack.seams.len(), "1 seam", "{n} seams"),
    ];
    if pack.sizes.len() > 1 {
        let run = pack.sizes.iter().map(|size| words::name(size)).collect::<Vec<_>>().join(", ");
        all.push(say!("sizes {run}; drawn in {size}", run, size = words::name(&pack.base_size)));
    } else if let Some(size) = pack.sizes.first() {
        all.push(say!("size {size}", size = words::name(size)));
    }
    if let Some(body) = &pack.body {
        all.push(say!("dressed on {body}", body = tr(&words::name(body))));
    }
    all.join(" · ")
}

/// The pictures, or the pieces drawn flat in their place and why.
fn first_pictures(flow: &mut Flow, sketches: &[Sketch], pictures: &Pictures) {
    match pictures {
        Pictures::Drawn(pictures) => {
            let all: Vec<(String, Arc<RgbaImage>)> =
                pictures.iter().map(|p| (tr(p.title).to_owned(), Arc::clone(&p.image))).collect();
            flow.pictures(PICTURES, &all);
        }
        Pictures::LeftOut(why) => {
            let drawn = drawing::overview(flow, sketches, OVERVIEW);
            let instead = match drawn {
                true => tr("the flat pieces are shown in their place"),
                false => tr("the pieces are drawn below"),
            };
            let why = words::line(&said(why));
            let words = say!("There are no pictures of the garment, as {why}; {instead}.", why, instead);
            flow.words(&words, Ink::Grey);
        }
    }
}

fn notes(flow: &mut Flow, pack: &Pack) {
    let mut notes: Vec<String> = pack.notes.iter().map(|note| words::line(&said(note))).collect();
    let pieces = pack.pieces.iter().flat_map(|row| &row.names);
    let mut names = pieces.chain(&pack.sizes).chain([&pack.name]);
    if !names.all(|name| flow.letters().have(&words::name(name))) {
        notes.push(
            tr("Some names have characters that the letters here lack: boxes stand for them.").to_owned(),
        );
    }
    if !notes.is_empty() {
        flow.heading(tr("To be known"));
        notes.iter().for_each(|note| flow.item(note));
    }
}

/// Names of the pieces with these numbers.
fn names_of(pack: &Pack, pieces: &[u32]) -> String {
    let count: usize = pack.pieces.iter().map(|row| row.pieces.len()).sum();
    if pieces.len() == count && count > 1 {
        return tr("all pieces").to_owned();
    }
    let named = pack.pieces.iter().flat_map(|row| row.pieces.iter().zip(&row.names));
    let own = named.filter(|(id, _)| pieces.contains(id)).map(|(_, name)| words::name(name));
    own.collect::<Vec<_>>().join(", ")
}

fn cloth_row(pack: &Pack, letter: String, cloth: &Cloth) -> Vec<Cell> {
    let image = || Some(say!("image {name}", name = words::name(cloth.image.as_ref()?)));
    let printed = cloth.print.as_ref().map(said).or_else(image);
    let colour = match cloth.colour {
        Some(colour) => Cell { words: words::colour(colour), swatch: Some(colour) },
        None => tr("not chosen").into(),
    };
    let density = cloth.density_kg_per_m2.map_or_else(|| NONE.to_owned(), |density| number(density * 1e3, 0));
    let mass = cloth.mass().map_or_else(|| NONE.to_owned(), |mass| number(mass * 1e3, 0));
    vec![
        letter.into(),
        tr(&words::name(&cloth.fabric)).into(),
        colour,
        printed.unwrap_or_default().into(),
        names_of(pack, &cloth.pieces).into(),
        density.into(),
        number(cloth.area, 2).into(),
        mass.into(),
    ]
}

/// The title of a column of numbers.
fn figures(title: &str) -> String {
    format!("#{title}")
}

fn cloth_table() -> Table {
    Table::new([
        "",
        tr("Fabric"),
        tr("Colour"),
        tr("Print"),
        tr("Pieces"),
        "#g/m²",
        &figures(tr("Pieces, m²")),
        &figures(tr("Pieces, g")),
    ])
}

fn cloths(flow: &mut Flow, pack: &Pack) {
    flow.heading(tr("Cloth"));
    let mut table = cloth_table();
    let row = |(i, cloth)| cloth_row(pack, pack.cloth_name(i), cloth);
    table.rows = pack.cloths.iter().enumerate().map(row).collect();
    flow.table(&table);
}

fn needed(flow: &mut Flow, pack: &Pack) {
    flow.heading(tr("Cloth needed for one garment"));
    let way = match pack.nap {
        true => tr("all pieces one way"),
        false => tr("pieces may be turned by 180 degrees"),
    };
    let words = say!(
        "Of cloth {width} m wide between its selvedges, {way}, 3 mm between pieces.",
        width = number(pack.width, 2),
        way
    );
    flow.words(&words, Ink::Grey);
    let count = pack.cloths.iter().map(|cloth| cloth.taken.len()).max().unwrap_or(0);
    for first in (0..count).step_by(SIZES) {
        let sizes: Vec<usize> = (first..count.min(first + SIZES)).collect();
        let titles: Vec<String> = match pack.sizes.is_empty() {
            true => vec![figures(tr("Length, and what of it is in pieces"))],
            false => sizes.iter().map(|&k| figures(&words::name(&pack.sizes[k]))).collect(),
        };
        let mut table = Table::new(std::iter::once(tr("Cloth")).chain(titles.iter().map(String::as_str)));
        let row = |(i, cloth): (usize, &Cloth)| -> Vec<Cell> {
            let name = format!("{} {}", pack.cloth_name(i), tr(&words::name(&cloth.fabric)));
            std::iter::once(name.into())
                .chain(sizes.iter().map(|&k| length(&cloth.taken[k]).into()))
                .collect()
        };
        table.rows = pack.cloths.iter().enumerate().map(row).collect();
        flow.table(&table);
    }
    for (i, cloth) in pack.cloths.iter().enumerate() {
        let mut known: Vec<&Words> = Vec::new();
        for why in cloth.taken.iter().filter_map(|taken| taken.why.as_ref()) {
            if !known.contains(&why) {
                known.push(why);
                let why = words::line(&said(why));
                flow.item(&say!("Cloth {name}: {why}.", name = pack.cloth_name(i), why));
            }
        }
    }
}

/// Length of cloth, and the share of it that is in pieces.
fn length(taken: &Taken) -> String {
    match (taken.length, taken.yield_percent) {
        (Some(length), Some(percent)) => format!("{} m, {percent:.0} %", number(length, 2)),
        _ => NONE.to_owned(),
    }
}

/// Girths and openings of the dressed garment.
fn fit(flow: &mut Flow, pack: &Pack) {
    flow.heading(tr("Measures of the garment"));
    if pack.body.is_none() {
        return flow.words(tr("Girths, ease and openings are told of a dressed garment."), Ink::Grey);
    }
    if pack.ease.is_empty() {
        flow.words(tr("The cloth goes all the way round nowhere that the body is measured."), Ink::Grey);
    } else {
        let mut table = Table::new([
            tr("Girth"),
            &figures(tr("Garment, cm")),
            &figures(tr("Body, cm")),
            &figures(tr("Ease, cm")),
            &figures(tr("Ease, %")),
        ]);
        table.rows = pack
            .ease
            .iter()
            .map(|ease| {
                let percent = words::minus(signed(ease.metres() / ease.body * 100.0, 0));
                let [garment, body, by] = [cm(ease.pattern), cm(ease.body), signed_cm(ease.metres())];
                vec![tr(ease.name).into(), garment.into(), body.into(), by.into(), percent.into()]
            })
            .collect();
        flow.table(&table);
    }
    if !pack.openings.is_empty() {
        let mut table = Table::new([tr("Opening (hem, neck, cuff)"), &figures(tr("Round as worn, cm"))]);
        let row = |opening: &crate::fit::Opening| -> Vec<Cell> {
            let place = say!("{cm} cm above the floor", cm = cm(opening.height));
            vec![place.into(), cm(opening.length).into()]
        };
        table.rows = pack.openings.iter().map(row).collect();
        flow.table(&table);
    }
}

/// The grain in words.
fn grain(row: &PieceRow) -> String {
    let degrees = row.grain_degrees;
    let near = |angle: f64| (degrees.abs() - angle).abs() <= ANGLE;
    let words = if near(0.0) {
        tr("upright").to_owned()
    } else if near(90.0) {
        tr("across").to_owned()
    } else if near(45.0) {
        tr("bias").to_owned()
    } else {
        let turn = number(degrees.abs(), 0);
        match degrees > 0.0 {
            true => say!("{turn}° to the left", turn),
            false => say!("{turn}° to the right", turn),
        }
    };
    if row.has_grainline { words } else { say!("{grain}, not drawn", grain = words) }
}

/// What is worked on the pieces of a row, where they differ piece by piece.
fn worked(pack: &Pack, row: &PieceRow) -> String {
    let all: Vec<String> = row.pieces.iter().map(|piece| worked_on(pack, *piece)).collect();
    match all.iter().all(|words| *words == all[0]) {
        true => all.into_iter().next().unwrap_or_default(),
        false => {
            let each = row.names.iter().zip(&all).filter(|(_, words)| !words.is_empty());
            each.map(|(name, words)| format!("{}: {words}", words::name(name))).collect::<Vec<_>>().join("; ")
        }
    }
}

/// What is worked on a piece, each once: "elastic, 3 buttons".
fn worked_on(pack: &Pack, piece: u32) -> String {
    let mut all: Vec<(&'static str, usize)> = Vec::new();
    for trim in pack.trims.iter().filter(|trim| trim.piece == piece) {
        let places = if trim.length.is_none() { trim.places.len() } else { 0 };
        match all.iter_mut().find(|(what, _)| *what == trim.what) {
            Some((_, known)) => *known += places,
            None => all.push((trim.what, places)),
        }
    }
    let words = |&(what, places): &(&'static str, usize)| match places {
        0 => words::worked(what).to_owned(),
        places => words::worked_times(what, places),
    };
    all.iter().map(words).collect::<Vec<_>>().join(", ")
}

fn pieces(flow: &mut Flow, pack: &Pack) {
    flow.heading(tr("Pieces"));
    let titles = [
        tr("No."),
        tr("Piece"),
        &figures(tr("To cut")),
        "",
        tr("Cloth"),
        tr("Grain"),
        &figures(tr("Width × height, cm")),
        &figures(tr("Area, cm²")),
        &figures(tr("Allowance, cm")),
        &figures(tr("Notches")),
        tr("Worked"),
    ];
    let mut table = Table::new(titles);
    let row = |row: &PieceRow| -> Vec<Cell> {
        let numbers: Vec<String> = row.pieces.iter().map(u32::to_string).collect();
        let names: Vec<String> = row.names.iter().map(|name| words::name(name)).collect();
        let allowance = match row.allowance {
            None => tr("as drawn").to_owned(),
            Some(0.0) => NONE.to_owned(),
            Some(metres) => cm(metres),
        };
        vec![
            numbers.join(", ").into(),
            names.join(", ").into(),
            row.cut.to_string().into(),
            match row.mirrored {
                0 => "".into(),
                1 if row.cut == 2 => tr("a pair").into(),
                mirrored => say!("{n} mirrored", n = mirrored).into(),
            },
            pack.cloth_name(row.cloth).into(),
            grain(row).into(),
            format!("{} × {}", cm(row.size[0]), cm(row.size[1])).into(),
            number(row.area * 1e4, 0).into(),
            allowance.into(),
            row.notches.to_string().into(),
            worked(pack, row).into(),
        ]
    };
    table.rows = pack.pieces.iter().map(row).collect();
    flow.table(&table);
    let words = tr(
        "Sizes are of the piece as it is drawn below, without allowance; areas are within the cutting line.",
    );
    flow.words(words, Ink::Grey);
}

fn coloured(words: String, swatch: Option<[u8; 3]>) -> Cell {
    Cell { words, swatch }
}

fn trims(flow: &mut Flow, pack: &Pack) {
    if pack.trims.is_empty() {
        return;
    }
    flow.heading(tr("Worked on the pieces"));
    let mut table = Table::new([
        tr("No."),
        tr("Piece"),
        tr("What"),
        tr("Where"),
        &figures(tr("Length, cm")),
        tr("Measures"),
    ]);
    let row = |row: &TrimRow| -> Vec<Cell> {
        vec![
            row.piece.to_string().into(),
            words::name(&row.piece_name).into(),
            words::worked(row.what).into(),
            row.places.iter().map(said).collect::<Vec<_>>().join(", ").into(),
            row.length.map(cm).unwrap_or_default().into(),
            coloured(said(&row.measures), row.colour),
        ]
    };
    table.rows = pack.trims.iter().map(row).collect();
    flow.table(&table);
}

fn supplies(flow: &mut Flow, pack: &Pack) {
    if pack.supplies.is_empty() {
        return;
    }
    flow.heading(tr("Bought for one garment"));
    let mut table = Table::new([tr("What"), tr("Colour"), &figures(tr("Count")), &figures(tr("Length, cm"))]);
    let row = |supply: &crate::pack::trims::Supply| -> Vec<Cell> {
        vec![
            said(&supply.what).into(),
            supply.colour.map_or_else(|| NONE.into(), |own| coloured(words::colour(own), Some(own))),
            supply.count.map(|count| count.to_string()).unwrap_or_default().into(),
            supply.length.map(cm).unwrap_or_default().into(),
        ]
    };
    table.rows = pack.supplies.iter().map(row).collect();
    flow.table(&table);
}

fn seams(flow: &mut Flow, pack: &Pack) {
    flow.heading(tr("Seams"));
    if pack.seams.is_empty() {
        return flow.words(tr("Nothing is sewn."), Ink::Grey);
    }
    let mut table = Table::new([
        tr("No."),
        tr("First side"),
        tr("Second side"),
        &figures(tr("First, cm")),
        &figures(tr("Second, cm")),
        tr("To be sewn"),
    ]);
    let row = |seam: &crate::pack::seams::SeamRow| -> Vec<Cell> {
        let edge = |k: usize| said(&seam.sides[k].edge);
        let side = |k: usize| format!("{}, {}", words::name(&seam.sides[k].piece), edge(k));
        let length = |k: usize| seam.lengths()[k].map_or_else(|| NONE.to_owned(), cm);
        let zip = if seam.zip { tr(", with a zip") } else { "" };
        vec![
            seam.seam.to_string().into(),
            side(0).into(),
            side(1).into(),
            length(0).into(),
            length(1).into(),
            format!("{}{zip}", seam.ease_words()).into(),
        ]
    };
    table.rows = pack.seams.iter().map(row).collect();
    flow.table(&table);
}

/// Pieces and seams in every size, a few sizes in each table.
fn sizes(flow: &mut Flow, pack: &Pack, pattern: &Pattern) {
    for sizes in pack.measures.chunks(SIZES) {
        let titles: Vec<String> = sizes.iter().map(|size| figures(&words::name(&size.size))).collect();
        let table = |first: &str, rows: Vec<Vec<Cell>>| {
            let titles = std::iter::once(first).chain(titles.iter().map(String::as_str));
            Table { rows, ..Table::new(titles) }
        };
        flow.heading(tr("Pieces in each size: width × height, cm"));
        let row = |(i, (id, piece)): (usize, (&PieceId, &Arc<crate::pattern::Piece>))| -> Vec<Cell> {
            let name = Cell::from(format!("{} {}", id.0, words::name(&piece.name)));
            let size = |[w, h]: [f64; 2]| Cell::from(format!("{} × {}", cm(w), cm(h)));
            std::iter::once(name).chain(sizes.iter().map(|own| size(own.pieces[i]))).collect()
        };
        flow.table(&table(tr("Piece"), pattern.pieces.iter().enumerate().map(row).collect()));
        if pack.seams.is_empty() {
            continue;
        }
        flow.heading(tr("Seams in each size: length of the first side, cm"));
        let row = |(i, seam): (usize, &crate::pack::seams::SeamRow)| -> Vec<Cell> {
            let side = &seam.sides[0];
            let name =
                Cell::from(format!("{} {}, {}", seam.seam, words::name(&side.piece), said(&side.edge)));
            let length = |length: Option<f64>| Cell::from(length.map_or_else(|| NONE.to_owned(), cm));
            std::iter::once(name).chain(sizes.iter().map(|own| length(own.seams[i]))).collect()
        };
        flow.table(&table(tr("Seam"), pack.seams.iter().enumerate().map(row).collect()));
    }
}

fn colourways(flow: &mut Flow, pack: &Pack) {
    for colourway in &pack.colourways {
        let name = words::name(&colourway.name);
        flow.heading(&match colourway.is_chosen {
            true => say!("Colourway {name} (as above)", name),
            false => say!("Colourway {name}", name),
        });
        let mut table = cloth_table();
        let row = |(i, cloth)| cloth_row(pack, pack.cloth_name(i), cloth);
        table.rows = colourway.cloths.iter().enumerate().map(row).collect();
        flow.table(&table);
    }
}
