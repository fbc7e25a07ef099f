//! The same work wherever the program runs: threads, stacks, languages, folders that are not there, others beside it.

use std::process::{Command, Stdio};

use crate::program::{Ended, Place, ended};

/// How long a name may be for the file that is written beside it to have one, too, bytes.
const LONG_NAME: usize = 240;

/// The hash and the garment of a run whose folder is `out`; it must have ended well.
fn came_of(place: &Place, out: &str, done: &Ended) -> (String, String) {
    assert_eq!(done.code, 0, "{done:#?}");
    let report = place.json(&format!("{out}/report.json"));
    let hash = report["state_hash"].as_str().expect("a hash").to_owned();
    (hash, place.read(&format!("{out}/garment.obj")))
}

#[test]
fn whatever_is_round_it_the_same_comes_of_it() {
    let place = Place::with_ball();
    let dress = |out: &str| place.command(&format!("dress ball.toile --out {out}"));
    let usual = came_of(&place, "usual", &ended(dress("usual").output().expect("started")));
    type Change = fn(&mut Command);
    let rounds: [(&str, Change); 8] = [
        ("one", |c| _ = c.args(["--threads", "1"])),
        ("sixteen", |c| _ = c.args(["--threads", "16"])),
        ("three", |c| _ = c.env("RAYON_NUM_THREADS", "3")),
        ("stack", |c| _ = c.env("RUST_MIN_STACK", "65536")),
        ("german", |c| _ = c.env("LC_ALL", "de_DE.UTF-8").env("LANG", "de_DE.UTF-8")),
        ("homeless", |c| _ = c.env_remove("HOME").env_remove("XDG_CONFIG_HOME").env_remove("XDG_DATA_HOME")),
        ("nowhere", |c| _ = c.env("HOME", "/nowhere/at/all").env("XDG_CONFIG_HOME", "/proc/none")),
        ("bare", |c| _ = c.env_clear().env("WGPU_BACKEND", "dx12")),
    ];
    for (name, change) in rounds {
        let mut command = dress(name);
        change(&mut command);
        let done = ended(command.output().expect("started"));
        assert!(came_of(&place, name, &done) == usual, "{name}: {done:#?}");
    }
}

#[test]
fn ten_at_once_in_one_folder_do_not_disturb_one_another() {
    let place = Place::with_ball();
    let begun: Vec<_> = (0..10)
        .map(|k| {
            // Two and two write to the same folder.
            let mut command =
                place.command(&format!("dress ball.toile --out out{} --save s{}.toile", k / 2, k / 2));
            command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("started")
        })
        .collect();
    let done: Vec<Ended> =
        begun.into_iter().map(|child| ended(child.wait_with_output().expect("ended"))).collect();
    let results: Vec<_> =
        done.iter().enumerate().map(|(k, done)| came_of(&place, &format!("out{}", k / 2), done)).collect();
    assert!(results.iter().all(|result| *result == results[0]));
    let saved = |k: usize| std::fs::read(place.path(&format!("s{k}.toile"))).expect("saved");
    assert!((1..5).all(|k| saved(k) == saved(0)), "all projects are the same and whole");
    let own = |name: &String| !name.ends_with(".bak");
    let left: Vec<String> = place.names("").into_iter().filter(own).collect();
    assert_eq!(left.len(), 1 + 5 + 5, "and nothing else is left: {left:?}");
}

#[test]
fn files_of_any_name_are_read_and_written() {
    let long = format!("{}.toile", "ä".repeat((LONG_NAME - 6) / 2));
    let names = ["with space.toile", "Übergröße.toile", "👗🧵.toile", "-dash.toile", "a'b\"c$d.toile", &long];
    for name in names {
        let place = Place::with_ball();
        std::fs::rename(place.path("ball.toile"), place.path(name)).expect("renamed");
        // What begins with a dash is named by its folder, as everywhere.
        let named = format!("./{name}");
        let mut command = place.command("dress --out");
        command.args(["out folder", &named, "--save", &named]);
        let done = ended(command.output().expect("started"));
        came_of(&place, "out folder", &done);
        let left = place.names("");
        assert_eq!(left.len(), 3, "{name}, what it was before, and the folder: {left:?}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn names_that_are_no_unicode_are_read_and_written() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let place = Place::with_ball();
    let name = OsStr::from_bytes(b"ball\xff\xfe.toile");
    std::fs::rename(place.path("ball.toile"), place.path("").join(name)).expect("renamed");
    let mut command = place.command("dress --out out --save saved.toile");
    let done = ended(command.arg(name).output().expect("started"));
    came_of(&place, "out", &done);
}

#[cfg(target_os = "linux")]
#[test]
fn a_folder_that_cannot_be_written_to_is_no_hindrance_to_work_elsewhere() {
    let (place, elsewhere) = (Place::with_ball(), Place::new());
    let out = elsewhere.path("out");
    let mut command = place.command("dress --out");
    let project = place.path("ball.toile");
    let done = command.arg(&out).arg(&project).current_dir("/proc/self").output();
    assert_eq!(ended(done.expect("started")).code, 0);
    assert!(out.join("report.json").exists());
}
