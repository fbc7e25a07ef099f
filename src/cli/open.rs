//! `toile [PROJECT]`: opens the editor.

use std::fs::File;
use std::path::Path;

use crate::cli::arguments::{Dress, InputOptions};
use crate::cli::failure::Failure;
use crate::cli::{display, dress, input, output};

/// The folder that the first sample is dressed into when there is no display.
const SAMPLE_OUT: &str = "toile-out";
/// The sample that is dressed when nothing is named.
const FIRST_SAMPLE: &str = "sample:tshirt";

/// Opens the editor and returns when it is closed.
pub fn open(project: Option<&Path>, record: Option<&Path>) -> Result<(), Failure> {
    if !has_display() && project.is_none() && record.is_none() {
        return dress_the_sample();
    }
    let input = project.map(|path| input::load(path, &InputOptions::default())).transpose()?;
    if !has_display() {
        return Err(Failure::Graphics(no_display(project.unwrap_or(Path::new(FIRST_SAMPLE)))));
    }
    let record = match record {
        Some(path) => Some(File::create(path).map_err(|e| Failure::file(path, e))?),
        None => None,
    };
    let file = project.filter(|_| input.as_ref().is_some_and(|i| i.is_project_file)).map(Path::to_owned);
    display::watched(|| crate::ui::run(input.map(|input| input.project), file, record))
}

/// Dresses a sample in place of the editor when no window can be opened.
fn dress_the_sample() -> Result<(), Failure> {
    output::complain(&format!(
        "There is no display to open a window on: dressing {FIRST_SAMPLE} into {SAMPLE_OUT} instead (see toile --help)."
    ));
    dress::dress(&Dress::sample(Path::new(FIRST_SAMPLE), Path::new(SAMPLE_OUT)))
}

/// On other systems there always is a display.
fn has_display() -> bool {
    let set = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    !cfg!(all(unix, not(target_os = "macos")))
        || set("DISPLAY")
        || set("WAYLAND_DISPLAY")
        || set("WAYLAND_SOCKET")
}

fn no_display(path: &Path) -> String {
    format!(
        "there is no display to open a window on. Without one:\n  toile dress {} --out out\nsee also: toile --help",
        path.display()
    )
}
