//! `toile fit`: maps of the dressed garment as figures and pictures, and the fit report.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::cli::arguments::{Fit, InputOptions, Maps, PictureOptions};
use crate::cli::failure::Failure;
use crate::cli::picture::Artist;
use crate::cli::{input, interrupt, language, output, run};
use crate::cloth::{ClothState, Garment};
use crate::fit::maps::{Histogram, MapStats, PieceStats};
use crate::fit::{Map, MapKind, MapReader};
use crate::geometry::ids::PieceId;
use crate::geometry::words::Words;
use crate::io::words::quoted;
use crate::language::{Table, shown_in};
use crate::pack::no_adapter;
use crate::render::{Legend, png};
use crate::session::{Outfit, Session};
use crate::ui::fit_page::FitPage;
use crate::ui::scenery::map_colours::{colours, palette};

/// The contents of `fit.json`.
#[derive(Debug, Serialize)]
struct Figures {
    version: &'static str,
    name: String,
    triangles: usize,
    vertices: usize,
    maps: Vec<MapFigures>,
    /// Why pictures were left out; None when they were drawn.
    #[serde(skip_serializing_if = "Option::is_none")]
    pictures_left_out: Option<Words>,
}

/// A map; all values are in its unit.
#[derive(Debug, Serialize)]
struct MapFigures {
    map: MapKind,
    title: &'static str,
    unit: &'static str,
    /// Values at the ends of the legend's colour bar.
    range: [f64; 2],
    #[serde(flatten)]
    stats: MapStats,
    pieces: Vec<PieceStats>,
    histogram: Histogram,
}

/// Writes every chosen map, each once, and the fit report.
pub fn fit(arguments: &Fit) -> Result<(), Failure> {
    let table = if arguments.page.is_some() { language::table(&arguments.language)? } else { None };
    let input = input::load(&arguments.project, &InputOptions::default())?;
    let session = run::opened(input.project, &arguments.project)?;
    let outfit = dressed(&session, &arguments.project)?;
    let mut pictures = Pictures::new()?;
    if let Some(folder) = &arguments.out {
        maps(arguments, folder, &outfit, input.name.clone(), &mut pictures)?;
    }
    if let Some(path) = &arguments.page {
        page(path, &session, &input.name, table, &mut pictures)?;
    }
    Ok(())
}

/// The draped garment of `session`, which was read from `path`.
pub fn dressed(session: &Session, path: &Path) -> Result<Outfit, Failure> {
    let words = "there is no cloth on its body: dress it first (toile dress PROJECT --save DRESSED)";
    let outfit = Outfit::of(session.snapshot(), &session.document().fabrics);
    outfit.ok_or_else(|| Failure::input(path, words))
}

/// Writes the fit report with the texts of `table`, without pictures where there is no graphics adapter.
fn page(
    path: &Path,
    session: &Session,
    name: &str,
    table: Option<&'static Table>,
    pictures: &mut Pictures,
) -> Result<(), Failure> {
    let no_cloth = || Failure::Internal("the cloth has gone".to_owned());
    let mut page = FitPage::of(session, name).ok_or_else(no_cloth)?;
    match (&mut pictures.artist, &pictures.left_out) {
        (Some(artist), _) => artist.page(&mut page)?,
        (None, why) => page.leave_pictures_out(why.clone().unwrap_or_default()),
    }
    output::write(path, shown_in(table, || page.html()).as_bytes())
}

fn maps(
    arguments: &Fit,
    folder: &Path,
    outfit: &Outfit,
    name: String,
    pictures: &mut Pictures,
) -> Result<(), Failure> {
    let (garment, state) = (&*outfit.garment, &*outfit.state);
    let mut files: Vec<(PathBuf, Vec<u8>)> = Vec::new();
    let mut figures = Figures {
        version: env!("CARGO_PKG_VERSION"),
        name,
        triangles: garment.triangles.len(),
        vertices: garment.vertex_count,
        maps: Vec::new(),
        pictures_left_out: pictures.left_out.clone(),
    };
    let reader = MapReader::new(outfit.worn());
    for kind in kinds(&arguments.maps) {
        interrupt::check()?;
        let map = reader.map(kind);
        let mut add = |name: String, bytes: Vec<u8>| files.push((folder.join(name), bytes));
        add(format!("{}.csv", kind.name()), vertices_csv(&map, garment, state).into_bytes());
        add(format!("{}-triangles.csv", kind.name()), triangles_csv(&map, garment).into_bytes());
        if let Some(png) = pictures.png(&map, outfit, arguments)? {
            add(format!("{}.png", kind.name()), png);
        }
        let line = map_figures(&map, garment);
        if !arguments.json {
            output::say(&line.words());
        }
        figures.maps.push(line);
    }
    let mut text = serde_json::to_string_pretty(&figures).map_err(|e| Failure::Internal(e.to_string()))?;
    if arguments.json {
        output::say(&text);
    }
    text.push('\n');
    files.push((folder.join("fit.json"), text.into_bytes()));
    output::make_folder(folder)?;
    output::write_together(&files)
}

/// The chosen maps, each once, in the order of menus.
pub fn kinds(asked: &[Maps]) -> Vec<MapKind> {
    let mut kinds: Vec<MapKind> = asked.iter().flat_map(|maps| maps.0.iter().copied()).collect();
    kinds.sort_unstable();
    kinds.dedup();
    kinds
}

fn map_figures(map: &Map, garment: &Garment) -> MapFigures {
    let (unit, times) = map.kind.unit();
    let scaled = Map { kind: map.kind, vertices: times_all(&map.vertices, times), triangles: Vec::new() };
    let range = scaled.range();
    MapFigures {
        map: map.kind,
        title: map.kind.title(),
        unit,
        range,
        stats: scaled.stats(),
        pieces: scaled.pieces(garment),
        histogram: scaled.histogram(range),
    }
}

fn times_all(values: &[f64], times: f64) -> Vec<f64> {
    values.iter().map(|v| v * times).collect()
}

impl MapFigures {
    /// A summary of the map in one line, for people.
    fn words(&self) -> String {
        let Self { title, unit, stats, .. } = self;
        if stats.count == 0 {
            return format!("{title}: no values");
        }
        let MapStats { count, p01, median, p99, min, max, .. } = stats;
        format!(
            "{title}: median {median:.2} {unit}, p1 {p01:.2}, p99 {p99:.2}, from {min:.2} to {max:.2}, at {count} vertices"
        )
    }
}

/// CSV with a row for each flat corner that has a value; a seam vertex has a row for each of its pieces.
fn vertices_csv(map: &Map, garment: &Garment, state: &ClothState) -> String {
    let (unit, times) = map.kind.unit();
    let mut csv = format!("piece,u_m,v_m,vertex,x_m,y_m,z_m,{}\n", column(map.kind, unit));
    for corner in &garment.corners {
        let (v, name) = (corner.vertex as usize, piece_name(garment, corner.piece));
        let (value, p) = (map.vertices[v] * times, state.positions[v]);
        if value.is_finite() {
            let [u, w] = corner.uv.to_array();
            // Writing to a string cannot fail.
            writeln!(csv, "{name},{u:.6},{w:.6},{v},{:.6},{:.6},{:.6},{value:.6}", p.x, p.y, p.z).ok();
        }
    }
    csv
}

fn triangles_csv(map: &Map, garment: &Garment) -> String {
    let (unit, times) = map.kind.unit();
    let mut csv = format!("piece,triangle,vertex_0,vertex_1,vertex_2,{}\n", column(map.kind, unit));
    for (t, (vs, piece)) in garment.triangles.iter().zip(&garment.triangle_pieces).enumerate() {
        let value = map.triangles[t] * times;
        if value.is_finite() {
            let name = piece_name(garment, *piece);
            writeln!(csv, "{name},{t},{},{},{},{value:.6}", vs[0], vs[1], vs[2]).ok();
        }
    }
    csv
}

/// The name of a map's column with its unit, such as "ease_mm".
pub fn column(kind: MapKind, unit: &str) -> String {
    let unit = match unit {
        "%" => "percent",
        "1/m" => "per_m",
        unit => unit,
    };
    format!("{}_{unit}", kind.name().replace('-', "_"))
}

fn piece_name(garment: &Garment, piece: PieceId) -> String {
    quoted(garment.pieces.iter().find(|(id, _)| *id == piece).map_or("", |(_, name)| name))
}

/// Draws pictures of maps, if there is a graphics adapter.
pub struct Pictures {
    /// None where there is no graphics adapter.
    pub artist: Option<Artist>,
    /// Why pictures are left out, in the words of the pages; None where they are drawn.
    pub left_out: Option<Words>,
}

impl Pictures {
    /// Opens the graphics adapter. If there is none this is told with its reason, and is no failure.
    pub fn new() -> Result<Self, Failure> {
        match Artist::new() {
            Ok(artist) => Ok(Self { artist: Some(artist), left_out: None }),
            Err(Failure::Graphics(words)) => {
                output::complain(&format!("pictures left out: {words}"));
                Ok(Self { artist: None, left_out: Some(no_adapter()) })
            }
            Err(failure) => Err(failure),
        }
    }

    fn png(&mut self, map: &Map, outfit: &Outfit, arguments: &Fit) -> Result<Option<Vec<u8>>, Failure> {
        let Some(artist) = &mut self.artist else { return Ok(None) };
        let range = map.range();
        let colours = colours(map.kind, &map.vertices, range);
        let (unit, times) = map.kind.unit();
        let legend = Legend {
            title: map.kind.title().to_owned(),
            unit: unit.to_owned(),
            range: range.map(|v| v * times),
            palette: palette(map.kind),
            decimal_sign: '.',
        };
        let PictureOptions { view, size, .. } = arguments.picture;
        let picture = artist.coloured(outfit, &colours, &legend, view, size)?;
        png(&picture).map(Some).map_err(|e| Failure::Internal(e.to_string()))
    }
}
