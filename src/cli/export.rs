//! `toile export`: the dressed cloth in another format.

use crate::cli::arguments::{Export, InputOptions};
use crate::cli::failure::Failure;
use crate::cli::{formats, input, output, run};

/// Writes the cloth as the file's ending says.
pub fn export(arguments: &Export) -> Result<(), Failure> {
    let ending =
        arguments.output.extension().and_then(|e| e.to_str()).unwrap_or_default().to_ascii_lowercase();
    if !["obj", "glb"].contains(&ending.as_str()) {
        let words = format!("{}: the ending must be .obj or .glb", arguments.output.display());
        return Err(Failure::Usage(words));
    }
    let input = input::load(&arguments.project, &InputOptions::default())?;
    let session = run::opened(input.project, &arguments.project)?;
    let snapshot = session.snapshot();
    let (true, Some((garment, cloth)), Some(source)) =
        (snapshot.is_dressed(), snapshot.drawn(), &snapshot.source)
    else {
        let words =
            "there is no dressed cloth in it: `toile dress` with --save makes a project that has some";
        return Err(Failure::input(&arguments.project, words));
    };
    let bytes = match ending.as_str() {
        "obj" => formats::garment_obj(garment, cloth, &source.pattern),
        _ => {
            let body = snapshot.body.as_ref().map(|b| &b.mesh);
            formats::scene_glb(garment, cloth, &source.pattern, body)?
        }
    };
    output::write(&arguments.output, &bytes)
}
