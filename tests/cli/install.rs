//! What is installed: completions, manual pages, and the packages with their desktop file, icon and file type.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::program::Place;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Runs `program`; None, with words, where it is not on this machine.
fn run(program: &str, arguments: &[&str]) -> Option<Output> {
    match Command::new(program).args(arguments).output() {
        Ok(output) => Some(output),
        Err(_) => {
            println!("{program} is not here: what it would check is not checked");
            None
        }
    }
}

/// Runs `program`, if it is here, and expects success.
fn succeeds(program: &str, arguments: &[&str]) -> Option<String> {
    let output = run(program, arguments)?;
    let said =
        [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
    assert!(output.status.success(), "{program} {arguments:?}: {said}");
    Some(said)
}

fn text(path: &Path) -> &str {
    path.to_str().expect("a plain path")
}

#[test]
fn shells_complete_commands_and_options() {
    let place = Place::new();
    for (shell, words) in [
        ("bash", "complete -F _toile"),
        ("zsh", "#compdef toile"),
        ("fish", "complete -c toile"),
        ("powershell", "Register-ArgumentCompleter"),
        ("elvish", "edit:completion"),
    ] {
        let script = place.ends(0, &format!("completions {shell}")).out;
        for word in [words, "repose", "edge-length", "merge"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
        place.write(shell, &script);
    }
    for shell in ["bash", "zsh", "fish"] {
        succeeds(shell, &["-n", text(&place.path(shell))]);
    }
    place.ends_with_words(2, "completions csh", "csh");
}

#[test]
fn there_is_a_manual_page_for_each_command() {
    let place = Place::new();
    place.ends(0, "man --out pages");
    let names = place.names("pages");
    for task in ["", "-dress", "-fit", "-report", "-report-merge", "-man"] {
        assert!(names.contains(&format!("toile{task}.1")), "{names:?}");
    }
    let page = place.read("pages/toile-dress.1");
    assert!(page.contains(".TH toile-dress 1") && page.contains("\\-\\-edge\\-length"), "{page}");
    if let Some(shown) = succeeds("man", &["-P", "cat", "-l", text(&place.path("pages/toile-dress.1"))]) {
        assert!(shown.contains("--edge-length") && !shown.contains("warning"), "{shown}");
    }
    place.write("file", "");
    place.ends_with_words(6, "man --out file/pages", "file");
}

/// The values of `key` in a desktop file.
fn values<'a>(desktop: &'a str, key: &'a str) -> impl Iterator<Item = &'a str> {
    desktop.lines().filter_map(move |line| line.strip_prefix(key)?.strip_prefix('='))
}

/// Checks what is below a prefix, and uses the program there as a desktop would.
fn check_installed(prefix: &Path, place: &Place) {
    let file = |name: &str| {
        let path = prefix.join(name);
        std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
    };
    let desktop = file("share/applications/toile.desktop");
    let mime = file("share/mime/packages/toile.xml");
    let metainfo = file("share/metainfo/toile.metainfo.xml");
    let kind = values(&desktop, "MimeType").next().expect("a type").trim_end_matches(';');
    assert!(mime.contains(&format!("<mime-type type=\"{kind}\">")) && mime.contains("*.toile"));
    assert!(metainfo.contains(&format!("<mediatype>{kind}</mediatype>")), "{metainfo}");
    let icon = values(&desktop, "Icon").next().expect("an icon");
    assert!(file(&format!("share/icons/hicolor/scalable/apps/{icon}.svg")).contains("<svg"));
    for size in [48, 128, 256] {
        let path = prefix.join(format!("share/icons/hicolor/{size}x{size}/apps/{icon}.png"));
        assert_eq!(image::image_dimensions(&path).expect("a picture"), (size, size));
    }
    assert!(prefix.join("share/man/man1/toile-dress.1.gz").exists());
    assert!(file("share/bash-completion/completions/toile").contains("complete -F _toile"));
    assert!(prefix.join("share/doc/toile/recipes/dress.mk").exists());
    assert!(prefix.join("share/doc/toile/languages/de.json").exists());
    file("share/doc/toile/copyright");
    succeeds("desktop-file-validate", &[text(&prefix.join("share/applications/toile.desktop"))]);
    succeeds("xmllint", &["--noout", text(&prefix.join("share/mime/packages/toile.xml"))]);
    succeeds("xmllint", &["--noout", text(&prefix.join("share/metainfo/toile.metainfo.xml"))]);
    succeeds("update-mime-database", &[text(&prefix.join("share/mime"))]);
    // The desktop runs Exec with the file in place of %f. Without a display the program says what it was given.
    let exec = values(&desktop, "Exec").next().expect("a command").replace("%f", "ball.toile");
    let (program, rest) = exec.split_once(' ').expect("a file");
    let mut command = place.command(rest);
    command = {
        let mut installed = Command::new(prefix.join("bin").join(program));
        installed.args(command.get_args()).current_dir(place.path(""));
        for (name, value) in command.get_envs() {
            match value {
                Some(value) => installed.env(name, value),
                None => installed.env_remove(name),
            };
        }
        installed
    };
    let opened = crate::program::ended(command.output().expect("the program starts"));
    assert_eq!(opened.code, 5, "{opened:#?}");
    assert!(opened.err.contains("toile dress ball.toile --out out"), "{opened:#?}");
}

#[test]
fn packages_hold_what_a_desktop_needs_and_a_program_that_runs() {
    if !cfg!(target_os = "linux") {
        return;
    }
    let place = Place::with_ball();
    let script = root().join("assets/install/package.sh");
    let out = place.path("dist");
    let binary = env!("CARGO_BIN_EXE_toile");
    let packed = succeeds("bash", &[text(&script), "--binary", binary, "--out", text(&out), "--quick"]);
    let Some(packed) = packed else { return };
    let packages: Vec<PathBuf> = packed.lines().map(PathBuf::from).filter(|path| path.exists()).collect();
    let ends = |ending: &str| packages.iter().find(|path| text(path).ends_with(ending));
    let tarball = ends(".tar.gz").unwrap_or_else(|| panic!("{packed}"));
    let prefix = place.path("prefix");
    std::fs::create_dir(&prefix).expect("made");
    let unpack = ["-xzf", text(tarball), "-C", text(&prefix), "--strip-components=1"];
    succeeds("tar", &unpack).expect("tar is here");
    check_installed(&prefix, &place);
    assert!(prefix.join("share/zsh/site-functions/_toile").exists());
    let Some(deb) = ends(".deb") else {
        println!("dpkg-deb is not here: no .deb was packed");
        return;
    };
    let control = succeeds("dpkg-deb", &["--field", text(deb)]).expect("it was here");
    for words in
        [format!("Version: {}", env!("CARGO_PKG_VERSION")), "libc6 (>= 2.".into(), "libvulkan1".into()]
    {
        assert!(control.contains(&words), "{control}");
    }
    let system = place.path("system");
    succeeds("dpkg-deb", &["--extract", text(deb), text(&system)]).expect("it was here");
    check_installed(&system.join("usr"), &place);
    assert!(system.join("usr/share/zsh/vendor-completions/_toile").exists());
}

#[test]
fn a_project_is_known_by_its_first_bytes() {
    let place = Place::with_ball();
    let mime = std::fs::read_to_string(root().join("assets/install/toile.xml")).expect("the file type");
    // Projects on the mannequin that are not dressed are JSON, all others are zips.
    let small = std::fs::read(root().join("assets/samples/tshirt.toile")).expect("a project");
    assert!(mime.contains("offset=\"0:64\" value=\"&quot;toile-project&quot;\""));
    assert!(small[..79].windows(15).any(|bytes| bytes == b"\"toile-project\""));
    let zipped = std::fs::read(place.path("ball.toile")).expect("a project");
    assert!(mime.contains("offset=\"30\" value=\"project.json\""));
    assert!(zipped.starts_with(b"PK\x03\x04") && zipped[30..].starts_with(b"project.json"));
}

/// cargo-deb packs the same files, but for what the program writes itself.
#[test]
fn both_ways_to_a_debian_package_hold_the_same_files() {
    let read = |name: &str| std::fs::read_to_string(root().join(name)).expect("a file");
    let (manifest, script) = (read("Cargo.toml"), read("assets/install/package.sh"));
    let assets =
        manifest.split("\nassets = [").nth(1).and_then(|rest| rest.split("\n]").next()).expect("assets");
    let sources: Vec<&str> = assets.lines().filter_map(|line| line.split('"').nth(1)).collect();
    assert!(sources.len() > 8, "{sources:?}");
    for source in sources.iter().filter(|source| !source.starts_with("target/") && !source.ends_with('*')) {
        assert!(root().join(source).is_file(), "{source}");
        let name = source.rsplit('/').next().unwrap_or_default();
        let name = name.split("-").next().unwrap_or_default();
        assert!(script.contains(name), "{source}");
    }
    let depends = |text: &str| -> Vec<String> {
        let line = text.lines().find(|line| line.to_lowercase().starts_with("depends")).expect("depends");
        line.split(", ")
            .map(|word| word.trim_matches('"').to_owned())
            .filter(|word| word.starts_with("lib"))
            .collect()
    };
    let mut of_script = depends(&script);
    of_script.retain(|word| word != "libgcc-s1" && !word.starts_with("libc6"));
    assert_eq!(depends(&manifest), of_script);
    let readme = read("README.md");
    of_script.iter().for_each(|package| assert!(readme.contains(package), "{package} is in the README, too"));
}
