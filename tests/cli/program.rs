//! Running the program with no display, no home and nothing in its folder.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use toile::session::Project;
use toile::session::project_file;

/// An empty folder and the program in it.
pub struct Place {
    folder: tempfile::TempDir,
}

/// How a run ended.
#[derive(Debug)]
pub struct Ended {
    pub code: i32,
    pub out: String,
    pub err: String,
}

impl Place {
    pub fn new() -> Self {
        Self { folder: tempfile::tempdir().expect("a folder") }
    }

    /// With the ball and its two patches in "ball.toile".
    pub fn with_ball() -> Self {
        let place = Self::new();
        place.save("ball.toile", &crate::common::project());
        place
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn write(&self, name: &str, bytes: impl AsRef<[u8]>) {
        std::fs::write(self.path(name), bytes).expect("written");
    }

    pub fn save(&self, name: &str, project: &Project) {
        project_file::save(&self.path(name), project).expect("saved");
    }

    pub fn read(&self, name: &str) -> String {
        let path = self.path(name);
        std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
    }

    pub fn json(&self, name: &str) -> serde_json::Value {
        serde_json::from_str(&self.read(name)).expect("JSON")
    }

    /// Names in the folder `name`, in order.
    pub fn names(&self, name: &str) -> Vec<String> {
        let Ok(entries) = std::fs::read_dir(self.path(name)) else { return Vec::new() };
        let mut names: Vec<String> =
            entries.flatten().map(|e| e.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// The program with `arguments`, parted by spaces, not started.
    pub fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_toile"));
        command.args(arguments.split_whitespace()).current_dir(self.folder.path()).stdin(Stdio::null());
        for name in
            ["HOME", "DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET", "XDG_RUNTIME_DIR", "RUST_BACKTRACE"]
        {
            command.env_remove(name);
        }
        // No adapter unless a test asks for one: no system has both.
        command.env("WGPU_BACKEND", if cfg!(windows) { "metal" } else { "dx12" });
        command
    }

    pub fn run(&self, arguments: &str) -> Ended {
        ended(self.command(arguments).output().expect("the program starts"))
    }

    /// Runs it with the adapters that there are.
    pub fn draws(&self, arguments: &str) -> Ended {
        ended(self.command(arguments).env_remove("WGPU_BACKEND").output().expect("the program starts"))
    }

    /// Runs and expects this exit code, and never a panic.
    pub fn ends(&self, code: i32, arguments: &str) -> Ended {
        let ended = self.run(arguments);
        assert_eq!(ended.code, code, "toile {arguments}: {ended:#?}");
        assert!(!ended.err.contains("internal error"), "{ended:#?}");
        ended
    }

    /// Runs and expects this exit code with `words` on standard error.
    pub fn ends_with_words(&self, code: i32, arguments: &str, words: &str) {
        let ended = self.ends(code, arguments);
        assert!(ended.err.contains(words), "toile {arguments} should speak of {words:?}: {ended:#?}");
    }
}

pub fn ended(output: Output) -> Ended {
    let text = |bytes| String::from_utf8_lossy(bytes).into_owned();
    Ended { code: output.status.code().unwrap_or(-1), out: text(&output.stdout), err: text(&output.stderr) }
}

/// Whether `sign` stands between two digits of `text`, as decimal signs do.
pub fn has_between_digits(text: &str, sign: char) -> bool {
    let characters: Vec<char> = text.chars().collect();
    characters.windows(3).any(|w| w[1] == sign && w[0].is_ascii_digit() && w[2].is_ascii_digit())
}

/// Whether tests that draw may step aside for want of an adapter.
pub fn adapter_required() -> bool {
    std::env::var_os("TOILE_REQUIRE_ADAPTER").is_some()
}

#[test]
fn help_and_version_are_no_failure() {
    let place = Place::new();
    let help = place.ends(0, "--help").out;
    for task in [
        "dress", "repose", "replay", "render", "fit", "import", "export", "check", "measure", "simulate",
        "bench", "compare",
    ] {
        assert!(help.contains(&format!("\n  {task} ")), "{help}");
        assert!(place.ends(0, &format!("{task} --help")).out.contains("Usage"));
    }
    assert!(place.ends(0, "--version").out.starts_with("toile 0."));
}

#[test]
fn wrong_arguments_are_told() {
    let place = Place::with_ball();
    place.ends_with_words(2, "dress", "PROJECT");
    place.ends_with_words(2, "dress ball.toile", "--out");
    place.ends_with_words(2, "dres ball.toile --out o", "dres is neither a command nor a file");
    place.ends_with_words(2, "dres ball.toile --out o", "; did you mean dress?");
    place.ends_with_words(2, "measur", "measur is neither a command nor a file; did you mean measure?");
    place.ends_with_words(2, "Gown", "neither a command nor a file; did you mean sample:gown?");
    assert!(!place.ends(2, "xyzzy").err.contains("did you mean"));
    place.ends_with_words(6, "dress gown --out o", "the sample of this name is sample:gown");
    place.ends_with_words(6, "measur.toile", "there is no such file");
    place.ends_with_words(2, "dress ball.toile --out o --view inside", "inside");
    place.ends_with_words(2, "dress ball.toile --out o --size 0x7", "0x7");
    place.ends_with_words(2, "dress ball.toile --out o --threads 0", "--threads");
    place.ends_with_words(2, "dress ball.toile ball.toile --out o --save p.toile", "one project");
    place.ends_with_words(2, "export ball.toile -o cloth.dwg", ".obj, .glb, .usda or .usdz");
    place.ends_with_words(2, "import ball.toile --marks m --suggest-marks -o p", "cannot be used with");
}

#[test]
fn without_a_display_it_says_how_to_do_without() {
    let place = Place::with_ball();
    place.ends_with_words(5, "ball.toile", "toile dress ball.toile --out out");
    assert_eq!(place.names(""), ["ball.toile"]);
}

#[test]
fn with_nothing_named_and_no_display_it_dresses_the_sample() {
    let place = Place::new();
    place.ends_with_words(0, "", "no display");
    assert_eq!(place.names("toile-out"), ["body.obj", "garment.obj", "report.json"]);
}

#[test]
fn a_folder_is_no_project() {
    let place = Place::new();
    std::fs::create_dir(place.path("folder")).expect("made");
    assert!(Path::new(&place.path("folder")).is_dir());
    place.ends_with_words(6, "check folder", "folder");
}
