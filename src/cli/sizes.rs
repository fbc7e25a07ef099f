//! `toile sizes`: grades a pattern to each size of its run, dresses every size, and tells how each fits.

use std::path::Path;

use image::RgbaImage;

use crate::cli::arguments::{Dress, InputOptions, SizeOptions, Sizes};
use crate::cli::dress_one::{Done, dress_one};
use crate::cli::failure::Failure;
use crate::cli::fit::{Pictures, dressed};
use crate::cli::graphics::Graphics;
use crate::cli::size_report::SizeReport;
use crate::cli::{files, input, interrupt, output, run};
use crate::geometry::words::Words;
use crate::io::sizes::{self, SizesError};
use crate::pattern::Pattern;
use crate::pattern::grading::graded;
use crate::render::png;
use crate::session::Outfit;
use crate::session::size_fit::{Ease, SizeFit};
use crate::ui::scenery::size_maps::SizeMaps;

/// Dresses every size, and writes sizes.json, sizes.csv and sizes.png.
pub fn sizes(arguments: &Sizes) -> Result<(), Failure> {
    let options = InputOptions { scale: arguments.scale, as_placed: true, ..InputOptions::default() };
    let input = input::load(&arguments.project, &options)?;
    let pattern = &input.project.document.pattern;
    let names = chosen(pattern, arguments)?;
    if let Some(table) = &arguments.sizes {
        check_bodies(table, &names)?;
    }
    output::make_folder(&arguments.out)?;
    let mut worn: Vec<(String, Outfit)> = Vec::new();
    let mut report = SizeReport::new(&input.name, pattern, arguments.sizes.is_none());
    let mut graphics = Graphics::default();
    for (i, name) in names.iter().enumerate() {
        interrupt::check()?;
        let folder = arguments.out.join(folder_name(&names[..i], name));
        let (size, outfit) = in_size(arguments, pattern, name, &folder, &mut graphics)?;
        if !arguments.json {
            output::say(&size.words());
        }
        worn.extend(outfit.map(|outfit| (name.clone(), outfit)));
        report.add(size);
    }
    let mut written = vec![
        (arguments.out.join("sizes.json"), format!("{}\n", report.json()?).into_bytes()),
        (arguments.out.join("sizes.csv"), report.csv().into_bytes()),
    ];
    if let Some(bytes) = picture(arguments, &worn)? {
        written.push((arguments.out.join("sizes.png"), bytes));
    }
    output::write_together(&written)?;
    output::say(&if arguments.json { report.json()? } else { report.summary() });
    report.failed().map_or(Ok(()), |words| Err(Failure::Check(words)))
}

/// The names of the sizes to dress, in the order of the run.
fn chosen(pattern: &Pattern, arguments: &Sizes) -> Result<Vec<String>, Failure> {
    if pattern.sizes.is_empty() {
        let words = "the pattern has no sizes: give it some in the window (Sizes of the pattern), or read a rule table";
        return Err(Failure::input(&arguments.project, words));
    }
    let numbers = arguments.only.iter().map(|name| pattern.sizes.number(name));
    let numbers: Vec<usize> =
        numbers.collect::<Result<_, _>>().map_err(|why| Failure::input(&arguments.project, why))?;
    let is_chosen = |i: &usize| numbers.is_empty() || numbers.contains(i);
    Ok((0..pattern.sizes.len()).filter(is_chosen).map(|i| pattern.sizes.names[i].clone()).collect())
}

/// Refuses a table without a body for each of the sizes, before the first of them is dressed.
fn check_bodies(table: &Path, names: &[String]) -> Result<(), Failure> {
    let refused = |error: SizesError| Failure::input(table, error);
    let bodies = sizes::read(&files::table_of_sizes(table)?).map_err(refused)?;
    names.iter().try_for_each(|name| {
        sizes::chosen(&bodies, name).and_then(|size| size.checked()).map(drop).map_err(refused)
    })
}

/// A name for the folder of a size that any system can have; `before` are the names of earlier sizes.
fn folder_name(before: &[String], name: &str) -> String {
    let plain = |name: &str| -> String {
        let is_plain = |c: char| c.is_alphanumeric() || "-_+".contains(c);
        name.chars().map(|c| if is_plain(c) { c } else { '-' }).collect()
    };
    let own = plain(name);
    match before.iter().any(|other| plain(other) == own) {
        true => format!("{own}-{}", before.len() + 1),
        false => own,
    }
}

/// Dresses one size into `folder`; of what cannot be dressed the result says why.
fn in_size(
    arguments: &Sizes,
    pattern: &Pattern,
    name: &str,
    folder: &Path,
    graphics: &mut Graphics,
) -> Result<(SizeFit, Option<Outfit>), Failure> {
    let graded = graded(pattern, name).map_err(|why| Failure::input(&arguments.project, why))?;
    let mut size = SizeFit::cut(pattern, name, &graded);
    size.folder = folder.file_name().map(|folder| folder.to_string_lossy().into_owned());
    let saved = folder.join("dressed.toile");
    let own = dress_arguments(arguments, name, folder, &saved);
    match dress_one(&arguments.project, folder, &own, graphics) {
        Ok(Done { verdict, note, .. }) => {
            note.iter().for_each(|words| output::complain(words));
            size.take(verdict.triangles(), verdict.strain_p99(), verdict.failed_check().map(Words::plain))
        }
        Err(failure @ (Failure::Input { .. } | Failure::Limit(_))) => {
            size.why = Some(Words::plain(failure.to_string()));
            return Ok((size, None));
        }
        Err(failure) => return Err(failure),
    }
    let outfit = worn(&saved, &mut size)?;
    Ok((size, Some(outfit)))
}

/// What `toile dress` would be told for this size.
fn dress_arguments(arguments: &Sizes, name: &str, folder: &Path, saved: &Path) -> Dress {
    let Sizes { project, sizes, body, body_file, pose, scale, edge_length, start, drape, cloth, .. } =
        arguments;
    let sized = match sizes {
        Some(table) => SizeOptions { sizes: Some(table.clone()), body_size: Some(name.to_owned()) },
        None => SizeOptions::default(),
    };
    let input = InputOptions {
        grade: Some(name.to_owned()),
        body: body.clone(),
        body_file: *body_file,
        sized,
        pose: *pose,
        scale: *scale,
        edge_length: *edge_length,
        ..InputOptions::default()
    };
    Dress {
        input,
        start: *start,
        drape: *drape,
        cloth: cloth.clone(),
        save: Some(saved.to_owned()),
        max_ticks: arguments.max_ticks,
        picture: arguments.picture,
        no_picture: arguments.no_picture,
        resume: arguments.resume,
        ..Dress::sample(project, folder)
    }
}

/// The dressed garment that was saved; its ease at every girth goes into `size`.
fn worn(saved: &Path, size: &mut SizeFit) -> Result<Outfit, Failure> {
    let project = input::load(saved, &InputOptions::default())?.project;
    let session = run::opened(project, saved)?;
    let outfit = dressed(&session, saved)?;
    size.ease = Ease::of(&session.document().body, &outfit);
    Ok(outfit)
}

/// A map of every size side by side, in the same colours.
fn picture(arguments: &Sizes, worn: &[(String, Outfit)]) -> Result<Option<Vec<u8>>, Failure> {
    if arguments.no_picture || worn.is_empty() {
        return Ok(None);
    }
    let mut pictures = Pictures::new()?;
    let Some(artist) = &mut pictures.artist else { return Ok(None) };
    let [width, height] = arguments.picture.size;
    // Bodies are narrow: each has half the width of a picture of its own.
    let size = [(width / 2).max(1), height];
    let mut whole = RgbaImage::new(size[0] * worn.len() as u32, height);
    let maps = SizeMaps::new(arguments.map, worn.iter().map(|(_, outfit)| outfit));
    for (i, (name, outfit)) in worn.iter().enumerate() {
        let panel =
            artist.coloured(outfit, &maps.colours(i), &maps.legend(name), arguments.picture.view, size)?;
        image::imageops::replace(&mut whole, &panel, i64::from(size[0]) * i as i64, 0);
    }
    png(&whole).map(Some).map_err(|e| Failure::Internal(e.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_get_folders_that_any_system_can_have() {
        let before = ["S/M".to_owned(), "M".to_owned()];
        assert_eq!(folder_name(&before[..0], "S/M"), "S-M");
        assert_eq!(folder_name(&before, "S:M"), "S-M-3");
        assert_eq!(folder_name(&before, "../x"), "---x");
        assert_eq!(folder_name(&before, "38"), "38");
    }
}
