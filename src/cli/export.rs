//! `toile export`: the pattern or the dressed cloth in another format.

use crate::cli::arguments::{Export, InputOptions};
use crate::cli::failure::Failure;
use crate::cli::{files, input, output, run};
use crate::io::pattern_formats::{self, PatternFormat, endings};
use crate::io::rul;
use crate::io::words::any_of;
use crate::session::{Document, Dye};
use crate::ui::scenery::fabric_textures::USUAL_SIDE;
use crate::ui::scenery::worn::{self, Worn};

/// Writes the pattern or the cloth in the format of the file's extension.
pub fn export(arguments: &Export) -> Result<(), Failure> {
    let ending = worn::ending(&arguments.output);
    if files::table_name(&arguments.project).is_some() {
        return table(arguments, &ending);
    }
    let of_pattern = PatternFormat::of_ending(&ending);
    if of_pattern.is_none() && !worn::ENDINGS.contains(&ending.as_str()) {
        let words = format!(
            "{}: the ending must be {} for the pattern, {} for the dressed cloth",
            arguments.output.display(),
            endings(PatternFormat::ALL),
            any_of(worn::ENDINGS)
        );
        return Err(Failure::Usage(words));
    }
    if of_pattern.is_some() && (arguments.textures.is_asked() || !arguments.cloth.is_empty()) {
        let words = format!(
            "--textures, --atlas, --no-trims, fabrics, colours and images are of dressed cloth, as {}",
            any_of(worn::ENDINGS)
        );
        return Err(Failure::Usage(words));
    }
    let (scale, grade) = (arguments.scale, arguments.grade.clone());
    let options = InputOptions { scale, grade, as_placed: true, ..InputOptions::default() };
    let input = input::load(&arguments.project, &options)?;
    if let Some(format) = of_pattern {
        let pattern = &input.project.document.pattern;
        let written = pattern_formats::write(format, pattern, &input.name, arguments.paper)
            .map_err(|why| Failure::input(&arguments.project, why))?;
        for line in &written.left_out {
            output::complain(&format!("{}: {line}", arguments.output.display()));
        }
        let Some(rules) = written.rules else { return output::write(&arguments.output, &written.bytes) };
        let table = arguments.output.with_extension(rul::ENDING);
        return output::write_together(&[(arguments.output.clone(), written.bytes), (table, rules)]);
    }
    let mut session = run::opened(input.project, &arguments.project)?;
    run::choose_cloth(&mut session, &arguments.cloth)?;
    let snapshot = session.snapshot();
    let (true, Some((garment, cloth)), Some(source)) =
        (snapshot.is_dressed(), snapshot.drawn(), &snapshot.source)
    else {
        let words =
            "there is no dressed cloth in it: `toile dress` with --save makes a project that has some";
        return Err(Failure::input(&arguments.project, words));
    };
    let worn = Worn { garment, cloth, pattern: &source.pattern, document: session.document() };
    // The texture coordinates of an OBJ without textures are metres of the pattern.
    let options = arguments.textures.worn(if ending == "obj" { 0 } else { USUAL_SIDE });
    if options.side == 0 && arguments.textures.textures.is_none() && has_pictures(session.document()) {
        let words = "prints, images and graphics are not in it: --textures 2048 writes them beside it";
        output::complain(&format!("{}: note: {words}", arguments.output.display()));
    }
    let body = snapshot.body.as_ref().map(|b| &b.mesh);
    let written = worn.files(options, body, &arguments.output).map_err(|why| Failure::Limit(why.into()))?;
    for line in &written.left_out {
        output::complain(&format!("{}: {line}", arguments.output.display()));
    }
    match &written.files[..] {
        [(path, bytes)] => output::write(path, bytes),
        files => output::write_together(files),
    }
}

/// Whether the cloth shows more than plain colours: a print, an image or a graphic on some piece.
fn has_pictures(document: &Document) -> bool {
    let mut dyes = document.pattern.pieces.keys().map(|&piece| document.dyes.of(piece));
    let is_pictured = |dye: Dye| dye.print.is_some() || dye.image.is_some();
    !document.artwork.graphics.is_empty() || dyes.any(is_pictured)
}

/// Writes a built-in table of sizes.
fn table(arguments: &Export, ending: &str) -> Result<(), Failure> {
    if ending != "csv" {
        let words = format!("{}: the ending must be .csv for a table of sizes", arguments.output.display());
        return Err(Failure::Usage(words));
    }
    output::write(&arguments.output, &files::table_of_sizes(&arguments.project)?)
}
