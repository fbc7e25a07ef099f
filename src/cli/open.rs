//! `toile [PROJECT]`: the editor.

use std::fs::File;
use std::path::Path;

use crate::cli::arguments::InputOptions;
use crate::cli::failure::Failure;
use crate::cli::input;

/// What opens when nothing is named.
const FIRST_SAMPLE: &str = "sample:tshirt";

/// Opens the editor and returns when it is closed.
pub fn open(project: Option<&Path>, record: Option<&Path>) -> Result<(), Failure> {
    let path = project.unwrap_or(Path::new(FIRST_SAMPLE));
    let input = input::load(path, &InputOptions::default())?;
    if !has_display() {
        return Err(Failure::Graphics(no_display(path)));
    }
    let record = match record {
        Some(path) => Some(File::create(path).map_err(|e| Failure::file(path, e))?),
        None => None,
    };
    let file = input.is_project_file.then(|| path.to_owned());
    crate::ui::run(input.project, file, record).map_err(|e| Failure::Graphics(e.to_string()))
}

/// Other systems always have one.
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
