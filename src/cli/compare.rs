//! `toile compare`: compares two dressed projects, as figures and pictures.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use image::RgbaImage;
use serde::Serialize;

use crate::body::readings::Reading;
use crate::cli::arguments::{Compare, InputOptions};
use crate::cli::failure::Failure;
use crate::cli::fit::{Pictures, column, dressed, kinds};
use crate::cli::{input, interrupt, output, run};
use crate::fit::{Change, Map, MapKind, Matching, girths};
use crate::geometry::ids::PieceId;
use crate::geometry::words::Words;
use crate::io::words::quoted;
use crate::render::{Legend, Palette, png};
use crate::session::Outfit;
use crate::session::body::readings_of;
use crate::ui::scenery::map_colours::palette;

/// The contents of `compare.json`. Of two values the first is that of the first project.
#[derive(Debug, Serialize)]
struct Figures {
    version: &'static str,
    names: [String; 2],
    triangles: [usize; 2],
    /// Area of all draped cloth, m².
    area: [f64; 2],
    pieces: Vec<PieceFigures>,
    girths: Vec<GirthFigures>,
    maps: Vec<MapFigures>,
    /// Why pictures were left out; None when they were drawn.
    #[serde(skip_serializing_if = "Option::is_none")]
    pictures_left_out: Option<Words>,
}

/// Area of one draped piece, m².
#[derive(Debug, Serialize)]
struct PieceFigures {
    piece: String,
    area: [f64; 2],
}

/// A girth, metres; None where the cloth does not go all the way round.
#[derive(Debug, Serialize)]
struct GirthFigures {
    name: &'static str,
    body: [f64; 2],
    pattern: [Option<f64>; 2],
    worn: [Option<f64>; 2],
}

/// A map; all values are in its unit.
#[derive(Debug, Serialize)]
struct MapFigures {
    map: MapKind,
    title: &'static str,
    unit: &'static str,
    /// Values at the ends of the colour bar of both garments.
    range: [f64; 2],
    /// Values at the ends of the colour bar of the difference.
    difference_range: [f64; 2],
    all: Change,
    pieces: Vec<PieceChange>,
}

#[derive(Debug, Serialize)]
struct PieceChange {
    piece: String,
    #[serde(flatten)]
    change: Change,
}

/// One of the two garments, with the body measurements.
struct Side {
    name: String,
    outfit: Outfit,
    readings: Vec<Reading>,
}

/// Compares the two projects by every chosen map, each once.
pub fn compare(arguments: &Compare) -> Result<(), Failure> {
    let sides = [side(&arguments.first)?, side(&arguments.second)?];
    let [first, second] = &sides;
    let matching = Matching::new(first.outfit.worn(), second.outfit.worn()).map_err(|why| {
        Failure::input(
            &arguments.second,
            format!("it has not the pieces of {}: {why}", arguments.first.display()),
        )
    })?;
    let mut files: Vec<(PathBuf, Vec<u8>)> = Vec::new();
    let mut pictures = Pictures::new()?;
    let mut figures = Figures {
        version: env!("CARGO_PKG_VERSION"),
        names: sides.each_ref().map(|side| side.name.clone()),
        triangles: sides.each_ref().map(|side| side.outfit.garment.triangles.len()),
        area: sides.each_ref().map(|side| area(&side.outfit, None)),
        pieces: pieces(&sides),
        girths: girth_figures(&sides),
        maps: Vec::new(),
        pictures_left_out: pictures.left_out.clone(),
    };
    for kind in kinds(&arguments.maps) {
        interrupt::check()?;
        let compared = Compared::new(kind, &sides, &matching);
        let mut add = |name: String, bytes: Vec<u8>| files.push((arguments.out.join(name), bytes));
        add(format!("{}.csv", kind.name()), compared.csv(second).into_bytes());
        if let Some(bytes) = compared.picture(&mut pictures, &sides, arguments)? {
            add(format!("{}.png", kind.name()), bytes);
        }
        let line = compared.figures(second);
        if !arguments.json {
            output::say(&line.words());
        }
        figures.maps.push(line);
    }
    files.push((arguments.out.join("pieces.csv"), pieces_csv(&figures).into_bytes()));
    files.push((arguments.out.join("girths.csv"), girths_csv(&figures).into_bytes()));
    let mut text = serde_json::to_string_pretty(&figures).map_err(|e| Failure::Internal(e.to_string()))?;
    if arguments.json {
        output::say(&text);
    }
    text.push('\n');
    files.push((arguments.out.join("compare.json"), text.into_bytes()));
    output::make_folder(&arguments.out)?;
    output::write_together(&files)
}

fn side(path: &Path) -> Result<Side, Failure> {
    let input = input::load(path, &InputOptions::default())?;
    let session = run::opened(input.project, path)?;
    let outfit = dressed(&session, path)?;
    let readings = readings_of(&session.document().body, &outfit.body.mesh).unwrap_or_default();
    Ok(Side { name: input.name, outfit, readings })
}

/// Area of the draped cloth, or of one piece of it, m².
fn area(outfit: &Outfit, piece: Option<PieceId>) -> f64 {
    let (garment, state) = (&outfit.garment, &outfit.state);
    let own = garment.triangles.iter().zip(&garment.triangle_pieces);
    own.filter(|(vs, of)| {
        piece.is_none_or(|piece| piece == **of) && vs.iter().all(|&v| state.mapped[v as usize])
    })
    .map(|(vs, _)| {
        let [a, b, c] = vs.map(|v| state.positions[v as usize]);
        (b - a).cross(c - a).length() / 2.0
    })
    .sum()
}

fn pieces(sides: &[Side; 2]) -> Vec<PieceFigures> {
    let [first, second] = sides;
    let of_first = |id: PieceId, name: &str| {
        let own = &first.outfit.garment.pieces;
        let same = own.iter().find(|piece| **piece == (id, name.to_owned()));
        same.or_else(|| own.iter().find(|piece| piece.1 == name)).map_or(id, |piece| piece.0)
    };
    let piece = |(id, name): &(PieceId, String)| PieceFigures {
        piece: name.clone(),
        area: [area(&first.outfit, Some(of_first(*id, name))), area(&second.outfit, Some(*id))],
    };
    second.outfit.garment.pieces.iter().map(piece).collect()
}

/// The girths at which at least one of the garments goes all the way round.
fn girth_figures(sides: &[Side; 2]) -> Vec<GirthFigures> {
    let all = sides.each_ref().map(|side| girths(&side.outfit.garment, &side.outfit.state, &side.readings));
    let [first, second] = sides.each_ref().map(|side| &side.readings);
    let found = |i: usize| {
        let name = first[i].name;
        let other = second.iter().position(|reading| reading.name == name)?;
        let places = [i, other];
        let girth = [0, 1].map(|k| all[k].iter().find(|(at, _)| *at == places[k]).map(|(_, girth)| *girth));
        girth.iter().any(Option::is_some).then(|| GirthFigures {
            name,
            body: [first[i].metres, second[other].metres],
            pattern: girth.map(|girth| girth.map(|girth| girth.flat)),
            worn: girth.map(|girth| girth.map(|girth| girth.worn)),
        })
    };
    (0..first.len()).filter_map(found).collect()
}

/// A map of both garments, in the unit that people see; `first_there` is the first map at the vertices of the second garment.
struct Compared {
    kind: MapKind,
    values: [Vec<f64>; 2],
    first_there: Vec<f64>,
    difference: Vec<f64>,
    range: [f64; 2],
    difference_range: [f64; 2],
}

impl Compared {
    fn new(kind: MapKind, sides: &[Side; 2], matching: &Matching) -> Self {
        let (_, times) = kind.unit();
        let scaled = |mut map: Map| {
            map.vertices.iter_mut().for_each(|v| *v *= times);
            map
        };
        let maps = sides.each_ref().map(|side| scaled(Map::new(kind, side.outfit.worn())));
        let [a, b] = maps.each_ref().map(Map::range);
        let [of_first, of_second] = sides.each_ref().map(|side| &side.outfit.garment);
        let first_there = matching.carried(of_first, of_second, &maps[0]);
        let difference: Vec<f64> = maps[1].vertices.iter().zip(&first_there).map(|(b, a)| b - a).collect();
        let most = Change::of(of_second, None, &first_there, &maps[1].vertices).p99;
        Self {
            kind,
            values: maps.map(|map| map.vertices),
            first_there,
            difference,
            range: [a[0].min(b[0]), a[1].max(b[1])],
            difference_range: [-most, most],
        }
    }

    fn figures(&self, second: &Side) -> MapFigures {
        let garment = &second.outfit.garment;
        let change = |piece| Change::of(garment, piece, &self.first_there, &self.values[1]);
        MapFigures {
            map: self.kind,
            title: self.kind.title(),
            unit: self.kind.unit().0,
            range: self.range,
            difference_range: self.difference_range,
            all: change(None),
            pieces: garment
                .pieces
                .iter()
                .map(|(id, name)| PieceChange { piece: name.clone(), change: change(Some(*id)) })
                .collect(),
        }
    }

    /// CSV with a row for each flat corner of the second garment that has a value in both.
    fn csv(&self, second: &Side) -> String {
        let garment = &second.outfit.garment;
        let column = column(self.kind, self.kind.unit().0);
        let mut csv = format!("piece,u_m,v_m,vertex,first_{column},second_{column},difference_{column}\n");
        for corner in &garment.corners {
            let v = corner.vertex as usize;
            let [a, b, difference] = [self.first_there[v], self.values[1][v], self.difference[v]];
            if difference.is_finite() {
                let name =
                    garment.pieces.iter().find(|(id, _)| *id == corner.piece).map_or("", |(_, name)| name);
                let [u, w] = corner.uv.to_array();
                // Writing to a string cannot fail.
                writeln!(csv, "{},{u:.6},{w:.6},{v},{a:.6},{b:.6},{difference:.6}", quoted(name)).ok();
            }
        }
        csv
    }

    /// A picture with the first map, the second map, and the second less the first on the second garment, side by side.
    fn picture(
        &self,
        pictures: &mut Pictures,
        sides: &[Side; 2],
        arguments: &Compare,
    ) -> Result<Option<Vec<u8>>, Failure> {
        let Some(artist) = &mut pictures.artist else { return Ok(None) };
        let own = palette(self.kind);
        let mut panels = Vec::new();
        for (title, side, values, range, palette) in [
            ("A", &sides[0], &self.values[0], self.range, own),
            ("B", &sides[1], &self.values[1], self.range, own),
            ("B - A", &sides[1], &self.difference, self.difference_range, Palette::Diverging),
        ] {
            let legend = Legend {
                title: format!("{title}: {}", self.kind.short()),
                unit: self.kind.unit().0.to_owned(),
                range,
                palette,
                decimal_sign: '.',
            };
            let colours: Vec<_> = values.iter().map(|&v| palette.colour(v, range)).collect();
            panels.push(artist.coloured(&side.outfit, &colours, &legend, arguments.view, arguments.size)?);
        }
        png(&joined(&panels)).map(Some).map_err(|e| Failure::Internal(e.to_string()))
    }
}

/// Joins pictures of one size from left to right.
fn joined(panels: &[RgbaImage]) -> RgbaImage {
    let [width, height] = panels.first().map_or([0, 0], |panel| [panel.width(), panel.height()]);
    let mut whole = RgbaImage::new(width * panels.len() as u32, height);
    for (i, panel) in (0u32..).zip(panels) {
        image::imageops::replace(&mut whole, panel, i64::from(i * width), 0);
    }
    whole
}

impl MapFigures {
    /// A summary of the map in one line, for people.
    fn words(&self) -> String {
        let Self { title, unit, all: Change { count, first, second, mean, p99, max }, .. } = self;
        if *count == 0 {
            return format!("{title}: no values in both");
        }
        format!(
            "{title}: mean {first:.2} and {second:.2} {unit}, difference {mean:+.2}, 99 % within {p99:.2}, at most {max:.2}, at {count} vertices"
        )
    }
}

fn pieces_csv(figures: &Figures) -> String {
    let mut csv =
        "map,unit,piece,vertices,first_mean,second_mean,difference_mean,difference_p99,difference_max\n"
            .to_owned();
    for map in &figures.maps {
        let all = std::iter::once(("", &map.all));
        for (piece, change) in all.chain(map.pieces.iter().map(|piece| (&*piece.piece, &piece.change))) {
            let Change { count, first, second, mean, p99, max } = change;
            let (name, unit, piece) = (map.map.name(), map.unit, quoted(piece));
            writeln!(csv, "{name},{unit},{piece},{count},{first:.6},{second:.6},{mean:.6},{p99:.6},{max:.6}")
                .ok();
        }
    }
    for PieceFigures { piece, area: [first, second] } in &figures.pieces {
        let difference = second - first;
        writeln!(csv, "area,m2,{},,{first:.6},{second:.6},{difference:.6},,", quoted(piece)).ok();
    }
    csv
}

fn girths_csv(figures: &Figures) -> String {
    let mut csv =
        "girth,first_body_m,second_body_m,first_pattern_m,second_pattern_m,first_worn_m,second_worn_m\n"
            .to_owned();
    let metres = |value: Option<f64>| value.map_or_else(String::new, |value| format!("{value:.6}"));
    for GirthFigures { name, body, pattern, worn } in &figures.girths {
        let values = [body.map(Some), *pattern, *worn].into_iter().flatten().map(metres);
        writeln!(csv, "{name},{}", values.collect::<Vec<_>>().join(",")).ok();
    }
    csv
}
