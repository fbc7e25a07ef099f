//! The list of `dress --list`: each line is the path of a project, or a JSON object with its path and options of its own.

use std::path::{Path, PathBuf};

use clap::builder::{OsStr, Resettable};
use clap::{Arg, ArgAction, CommandFactory, FromArgMatches, Parser};
use serde_json::{Map, Value};

use crate::cli::arguments::Dress;
use crate::cli::failure::Failure;
use crate::cli::files;

/// Keys of a line that are no options.
const PROJECT: &str = "project";
const NAME: &str = "name";
/// The option that names a file in the garment's own folder.
const SAVE: &str = "save";
/// Options of the whole list, which no line can change.
const OF_ALL: [&str; 8] = ["list", "shard", "out", "record", "resume", "progress", "json", "threads"];
/// Options that exclude each other: where a line has one of them, those of the command line give way.
const EXCLUDING: [&[&str]; 2] = [&["body", "sizes"], &["marks", "suggest-marks", "start"]];
/// Characters that some system does not allow in the name of a folder.
const NOT_IN_NAMES: [char; 9] = ['/', '\\', ':', '*', '?', '"', '<', '>', '|'];

/// A garment that a list names.
#[derive(Debug)]
pub struct Entry {
    pub project: PathBuf,
    /// Wanted name of its folder; others of the list may want it, too.
    pub name: String,
    own: Own,
}

/// What a line says beside the path.
#[derive(Debug)]
enum Own {
    Nothing,
    /// The JSON object; read again when its turn comes, so that long lists take little memory.
    Line {
        text: String,
        list: PathBuf,
        number: usize,
    },
    /// Why the line cannot be used.
    Wrong(String),
}

impl Entry {
    /// The garment of a project that is named on the command line.
    pub fn named(project: &Path) -> Self {
        Self { project: project.to_owned(), name: files::name_of(project), own: Own::Nothing }
    }

    /// `all` with the options of the line in their place; `folder` is the garment's.
    ///
    /// # Errors
    /// The line cannot be used.
    pub fn arguments(&self, all: &Dress, folder: &Path) -> Result<Dress, Failure> {
        match &self.own {
            Own::Nothing => Ok(all.clone()),
            Own::Wrong(words) => Err(Failure::input(&self.project, words)),
            Own::Line { text, list, number } => {
                let wrong = |words: String| Failure::input(list, format!("line {number}: {words}"));
                let options = serde_json::from_str(text).map_err(|e| wrong(e.to_string()))?;
                with(all, &options, list.parent().unwrap_or(Path::new("")), folder).map_err(wrong)
            }
        }
    }

    /// The options of the line, for its report.
    pub fn options(&self) -> Option<Map<String, Value>> {
        let Own::Line { text, .. } = &self.own else { return None };
        let mut options: Map<String, Value> = serde_json::from_str(text).ok()?;
        options.retain(|key, _| key != PROJECT && key != NAME);
        (!options.is_empty()).then_some(options)
    }
}

/// The garments that the list at `path` names.
pub fn entries(path: &Path) -> Result<Vec<Entry>, Failure> {
    let text = String::from_utf8(files::read(path)?).map_err(|e| {
        Failure::input(path, format!("not a list: no UTF-8 at byte {}", e.utf8_error().valid_up_to()))
    })?;
    let lines = text.trim_start_matches('\u{feff}').lines().map(str::trim).enumerate();
    let named = lines.filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    let entries: Vec<Entry> = named.map(|(i, line)| entry(path, i + 1, line)).collect();
    match entries.is_empty() {
        true => Err(Failure::input(path, "this list names no project")),
        false => Ok(entries),
    }
}

fn entry(list: &Path, number: usize, line: &str) -> Entry {
    let folder = list.parent().unwrap_or(Path::new(""));
    if !line.starts_with('{') {
        return Entry::named(&beside(folder, line));
    }
    let wrong = |words: String| Entry {
        project: list.to_owned(),
        name: format!("line-{number}"),
        own: Own::Wrong(format!("line {number}: {words}")),
    };
    let options: Map<String, Value> = match serde_json::from_str(line) {
        Ok(options) => options,
        Err(error) => return wrong(format!("no JSON object: {error}")),
    };
    let Some(Value::String(project)) = options.get(PROJECT) else {
        return wrong(format!("it has no {PROJECT:?}, the path of a project or pattern"));
    };
    let project = beside(folder, project);
    let name = match options.get(NAME) {
        None => files::name_of(&project),
        Some(Value::String(name)) if is_name(name) => name.clone(),
        Some(other) => return wrong(format!("{NAME:?} is {other}, which is no name of a folder")),
    };
    Entry { project, name, own: Own::Line { text: line.to_owned(), list: list.to_owned(), number } }
}

/// Whether any system can give a file or folder this name.
fn is_name(name: &str) -> bool {
    let is_sign = |c: char| c.is_control() || NOT_IN_NAMES.contains(&c);
    !name.is_empty()
        && name.len() <= 200
        && !name.starts_with('.')
        && !name.ends_with(['.', ' '])
        && !name.contains(is_sign)
}

/// What `name` stands for in a list in `folder`.
fn beside(folder: &Path, name: impl AsRef<Path>) -> PathBuf {
    let name = name.as_ref();
    let is_built_in = files::is_sample(name) || files::table_name(name).is_some();
    match is_built_in || name == Path::new(files::MANNEQUIN) {
        true => name.to_owned(),
        false => folder.join(name),
    }
}

/// The options of a line, read as a command line is.
#[derive(Debug, Parser)]
#[command(no_binary_name = true, disable_help_flag = true)]
struct Line {
    #[command(flatten)]
    dress: Dress,
}

/// `all` with `options` of a list in `list_folder`, for a garment that is written to `folder`.
fn with(
    all: &Dress,
    options: &Map<String, Value>,
    list_folder: &Path,
    folder: &Path,
) -> Result<Dress, String> {
    let mut words: Vec<String> = Vec::new();
    let (mut dress, command) = (all.clone(), command());
    let mut given: Vec<String> = Vec::new();
    for (key, value) in options.iter().filter(|(key, _)| ![PROJECT, NAME].contains(&key.as_str())) {
        let option = key.replace('_', "-");
        if OF_ALL.contains(&option.as_str()) {
            return Err(format!("{key:?} is for all garments: no line can have it"));
        }
        if command.get_arguments().all(|own| own.get_long() != Some(&option)) {
            return Err(format!("there is no option {key:?}"));
        }
        let values = match value {
            Value::Array(values) => &values[..],
            other => std::slice::from_ref(other),
        };
        for value in values {
            words.extend(word(&option, value, folder)?);
        }
        match value {
            Value::Array(values) if values.is_empty() => empty(&mut dress, &option)?,
            // What is not there excludes nothing.
            Value::Null | Value::Bool(false) => {}
            _ => {
                if EXCLUDING.iter().any(|group| group.contains(&option.as_str())) {
                    give_way(&mut dress, &option);
                }
                given.push(option);
            }
        }
    }
    words.extend(needed(&given, all));
    // The project itself and its folder are needed where options are read; the list's own are put back.
    words.extend(["--out", ".", "--", "."].map(str::to_owned));
    let matches = command.try_get_matches_from(words).map_err(|error| reason(&error))?;
    dress.update_from_arg_matches(&matches).map_err(|error| reason(&error))?;
    (dress.projects, dress.out) = (Vec::new(), all.out.clone());
    for option in &given {
        files_of(&mut dress, option).into_iter().for_each(|file| *file = beside(list_folder, &*file));
    }
    Ok(dress)
}

/// The one of `--sizes` and `--body-size` that a line does not give, from the command line: neither goes without the other.
fn needed(given: &[String], all: &Dress) -> Option<String> {
    let [has_sizes, has_size] = ["sizes", "body-size"].map(|own| given.iter().any(|option| option == own));
    match (has_sizes, has_size, &all.input.sized.sizes, &all.input.sized.body_size) {
        (false, true, Some(sizes), _) => Some(format!("--sizes={}", sizes.display())),
        (true, false, _, Some(size)) => Some(format!("--body-size={size}")),
        _ => None,
    }
}

/// The files that `option` names, which are relative to the list.
fn files_of<'a>(dress: &'a mut Dress, option: &str) -> Vec<&'a mut PathBuf> {
    let input = &mut dress.input;
    match option {
        "body" => input.body.iter_mut().collect(),
        "sizes" => input.sized.sizes.iter_mut().collect(),
        "marks" => input.marks.iter_mut().collect(),
        "over" => input.over.iter_mut().collect(),
        "image" => dress.cloth.art.image_file_mut().into_iter().collect(),
        "graphic" => dress.cloth.art.graphic_files_mut().collect(),
        _ => Vec::new(),
    }
}

/// Takes back the values of an option that has several.
fn empty(dress: &mut Dress, option: &str) -> Result<(), String> {
    match option {
        "over" => dress.input.over.clear(),
        "graphic" => dress.cloth.art.graphics.clear(),
        _ => return Err(format!("{option:?} takes no list without a value")),
    }
    Ok(())
}

/// The option with one of its values as it is typed; None for null.
fn word(option: &str, value: &Value, folder: &Path) -> Result<Option<String>, String> {
    let value = match value {
        Value::Null => return Ok(None),
        Value::String(text) if option == SAVE => match is_name(text) {
            true => folder.join(text).display().to_string(),
            false => return Err(format!("{SAVE:?} is {text:?}, which is no name of a file")),
        },
        Value::String(text) => text.clone(),
        Value::Bool(_) | Value::Number(_) => value.to_string(),
        Value::Array(_) | Value::Object(_) => return Err(format!("{option:?} takes no {value}")),
    };
    Ok(Some(format!("--{option}={value}")))
}

/// Takes back what excludes `option`.
fn give_way(dress: &mut Dress, option: &str) {
    let input = &mut dress.input;
    match option {
        "body" | "sizes" => {
            (input.body, input.sized) = Default::default();
        }
        _ => {
            (input.marks, input.suggest_marks) = (None, false);
            dress.start = None;
        }
    }
}

/// Reads options alone: without the defaults of those that are not there, and with `true` and `false` for those without value.
fn command() -> clap::Command {
    Line::command_for_update().mut_args(|arg: Arg| {
        let arg = arg.default_value(Resettable::<OsStr>::Reset);
        match arg.get_action() {
            ArgAction::SetTrue => {
                arg.action(ArgAction::Set).num_args(0..=1).require_equals(true).default_missing_value("true")
            }
            _ => arg,
        }
    })
}

/// What clap says on one line, without its "error: " and its advice.
fn reason(error: &clap::Error) -> String {
    let words = error.render().to_string();
    let lines: Vec<&str> = words.lines().map(str::trim).take_while(|line| !line.is_empty()).collect();
    let line = lines.join(" ");
    line.strip_prefix("error: ").unwrap_or(&line).to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::NamedPose;
    use crate::cli::arguments::Arguments;
    use crate::cli::arguments::Task;

    fn base(options: &str) -> Dress {
        let line = format!("toile dress --list l --out o {options}");
        let arguments = Arguments::try_parse_from(line.split_whitespace()).expect("arguments");
        let Some(Task::Dress(dress)) = arguments.task else { panic!("{line}") };
        dress
    }

    fn read(base: &Dress, line: &str) -> Result<Dress, String> {
        let options = serde_json::from_str(line).expect("an object");
        with(base, &options, Path::new("lists"), Path::new("o/a"))
    }

    #[test]
    fn a_line_changes_what_it_names_and_nothing_else() {
        let all = base("--drape --view back --max-ticks 7 --fabric denim-11oz");
        let same = read(&all, r#"{"project": "a", "name": "b"}"#).expect("no options");
        let text = |dress: &Dress| format!("{dress:?}");
        assert_eq!(text(&same), text(&all), "defaults do not count");
        let own = r#"{"project": "a", "drape": false, "edge_length": 0.03, "pose": "t", "no-picture": true, "view": null}"#;
        let own = read(&all, own).expect("read");
        assert!(!own.drape && own.no_picture && own.input.pose == Some(NamedPose::T));
        assert_eq!((own.input.edge_length, own.max_ticks), (Some(0.03), 7));
        assert_eq!((own.picture.view, own.cloth.fabric.as_deref()), (all.picture.view, Some("denim-11oz")));
    }

    #[test]
    fn files_are_found_beside_the_list_and_saved_in_the_folder() {
        let own = r#"{"body": "b.obj", "over": ["coat.json", "/x/hat.json"], "save": "dressed.toile"}"#;
        let own = read(&base(""), own).expect("read");
        assert_eq!(own.input.body.as_deref(), Some(Path::new("lists/b.obj")));
        assert_eq!(own.input.over, [Path::new("lists/coat.json"), Path::new("/x/hat.json")]);
        assert_eq!(own.save.as_deref(), Some(Path::new("o/a/dressed.toile")));
        let own =
            r#"{"image": "silk.png:120", "graphic": ["logo.png:front:0,0:0.1", "/x/a.png:back:0,0:1"]}"#;
        let mut own = read(&base(""), own).expect("read");
        let image = own.cloth.art.image_file_mut().expect("an image").clone();
        let graphics: Vec<PathBuf> = own.cloth.art.graphic_files_mut().map(|file| file.clone()).collect();
        assert_eq!(image, Path::new("lists/silk.png"));
        assert_eq!(graphics, [Path::new("lists/logo.png"), Path::new("/x/a.png")]);
        let own = read(&base("--body b.obj --over c.json"), r#"{"over": []}"#).expect("read");
        assert!(own.input.over.is_empty() && own.input.body.as_deref() == Some(Path::new("b.obj")));
        let mannequin = read(&base(""), r#"{"body": "mannequin"}"#).expect("read");
        assert_eq!(mannequin.input.body.as_deref(), Some(Path::new("mannequin")));
    }

    #[test]
    fn options_of_a_line_come_in_place_of_those_they_exclude() {
        let own = read(&base("--body b.obj"), r#"{"sizes": "s.csv", "body_size": "m"}"#).expect("read");
        assert!(own.input.body.is_none() && own.input.sized.body_size.as_deref() == Some("m"));
        let own = read(&base("--suggest-marks"), r#"{"start": "placement"}"#).expect("read");
        assert!(!own.input.suggest_marks && own.start.is_some());
        let own = read(&base("--start placement"), r#"{"marks": "m.json"}"#).expect("read");
        assert!(own.input.marks.is_some() && own.start.is_none());
        for nothing in [r#"{"suggest_marks": false}"#, r#"{"start": null}"#, r#"{"sizes": null}"#] {
            let own = read(&base("--body b.obj --marks m.json"), nothing).expect("read");
            assert!(own.input.marks.is_some() && own.input.body.is_some(), "{nothing} takes nothing back");
        }
    }

    #[test]
    fn a_size_table_and_a_size_may_come_from_different_places() {
        let all = base("--sizes s.csv --body-size m");
        let of = |line: &str| {
            let own = read(&all, line).expect("read").input.sized;
            (own.sizes.expect("a table"), own.body_size.expect("a size"))
        };
        assert_eq!(of(r#"{"body_size": "l"}"#), (PathBuf::from("s.csv"), "l".to_owned()));
        assert_eq!(of(r#"{"sizes": "t.csv"}"#), (PathBuf::from("lists/t.csv"), "m".to_owned()));
    }

    #[test]
    fn wrong_options_are_told() {
        for (line, words) in [
            (r#"{"edge_length": "wide"}"#, "wide"),
            (r#"{"sleeves": 3}"#, "sleeves"),
            (r#"{"sleeves": null}"#, "sleeves"),
            (r#"{"drape": 3}"#, "3"),
            (r#"{"out": "x"}"#, "for all garments"),
            (r#"{"save": "../x"}"#, "no name of a file"),
            (r#"{"view": {"a": 1}}"#, "takes no"),
            (r#"{"sizes": "s.csv"}"#, "--body-size"),
        ] {
            let why = read(&base(""), line).expect_err(line);
            assert!(why.contains(words) && !why.contains('\n'), "{line}: {why}");
        }
    }

    #[test]
    fn a_wrong_line_is_an_entry_that_says_why() {
        let list = Path::new("lists/all.jsonl");
        let why = |line: &str| {
            let entry = entry(list, 4, line);
            assert_eq!((entry.name.as_str(), entry.project.as_path()), ("line-4", list), "{line}");
            entry.arguments(&base(""), Path::new("o/a")).expect_err(line).to_string()
        };
        assert!(why("{\"project\": ").starts_with("lists/all.jsonl: line 4: no JSON"));
        assert!(why("{}").contains("\"project\""));
        assert!(why(r#"{"project": 3}"#).contains("\"project\""));
        for name in [r#""a/b""#, r#""..""#, r#""""#, "7"] {
            let line = format!(r#"{{"project": "a.json", "name": {name}}}"#);
            assert!(why(&line).contains("no name of a folder"), "{line}");
        }
    }
}
