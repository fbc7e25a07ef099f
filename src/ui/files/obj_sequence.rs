//! Numbered OBJ files of a body, one per frame, read as an animation of it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;

use crate::body::{Unit, UpAxis, import};
use crate::geometry::mesh::TriMesh;
use crate::io::glb::animated::{bytes_per_frame, write_moving_body};
use crate::io::materials::Colours;
use crate::io::obj;
use crate::session::{AnimatedFile, Animations, Command};
use crate::ui::files::{read, unit_like};
use crate::ui::language::{said, say};

/// Frames per second.
const RATE: f64 = 30.0;
/// Largest size of an animation in a project, bytes.
const MOST_BYTES: usize = 256 << 20;

/// Reads the OBJ files numbered like the one at `path` as an animation of the body whose mesh is `dressed`: the same triangles in
/// other positions, in the unit that gives them the same edge lengths. Returns the command that takes it, and the number of
/// files.
pub fn read_sequence(path: &Path, dressed: &TriMesh) -> Result<(Command, usize), String> {
    let (name, files) = numbered_like(path)?;
    let bytes = files.len() * bytes_per_frame(0, dressed.positions.len());
    if bytes > MOST_BYTES {
        let [needed, most] = [bytes, MOST_BYTES].map(|bytes| bytes >> 20);
        return Err(say!(
            "{count} files like {path} would take {needed} MiB in the project, and {most} are the most there may be: leave some out",
            count = files.len(),
            path = path.display(),
            needed,
            most
        ));
    }
    let mut unit = None;
    let mut pictures: Vec<Vec<DVec3>> = Vec::new();
    for file in &files {
        let mesh = obj::read(&read(file)?);
        let mesh = mesh.map_err(|e| format!("{}: {}", file.display(), said(&e.words())))?.mesh;
        // The unit of the first file holds for all: guessed from each, it would change when the person sits down.
        let unit = *unit.get_or_insert_with(|| unit_like(dressed, &mesh));
        let positions = positions(mesh, unit, dressed);
        pictures.push(positions.ok_or_else(|| {
            say!("{path} has other triangles than the body: it is no pose of it", path = file.display())
        })?);
    }
    let written = write_moving_body(&dressed.triangles, &pictures, RATE, &Colours::default());
    let bytes = written.map_err(|e| format!("{}: {}", path.display(), said(&e.words())))?;
    let (up, unit, buffers) = (UpAxis::Y, Unit::Metre, BTreeMap::new());
    let animations = Animations::new(AnimatedFile { name, bytes, buffers, up, unit });
    let (animations, _) = animations.map_err(|why| said(&why))?;
    Ok((Command::TakeAnimations { animations: Arc::new(animations) }, files.len()))
}

/// Positions of the vertices of `dressed` in `mesh`, metres; None if it has other triangles.
fn positions(mesh: TriMesh, unit: Unit, dressed: &TriMesh) -> Option<Vec<DVec3>> {
    let is_same = |mesh: &TriMesh| {
        mesh.triangles == dressed.triangles && mesh.positions.len() == dressed.positions.len()
    };
    if is_same(&mesh) {
        return Some(mesh.positions.into_iter().map(|p| p * unit.metres()).collect());
    }
    let mesh = import(mesh, unit).mesh;
    is_same(&mesh).then_some(mesh.positions)
}

/// The OBJ files beside the one at `path` whose names differ from its own only in the last number, in the order of that number;
/// and their name without it.
fn numbered_like(path: &Path) -> Result<(String, Vec<PathBuf>), String> {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let digits = |c: char| c.is_ascii_digit();
    let unnumbered = || say!("There is no number in the name of {path}", path = path.display());
    let end = stem.rfind(digits).map(|last| last + 1).ok_or_else(unnumbered)?;
    let begin = stem[..end].trim_end_matches(digits).len();
    let (before, after) = (&stem[..begin], &stem[end..]);
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let entries = std::fs::read_dir(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let number = |path: PathBuf| {
        let is_obj = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("obj"));
        let stem = path.file_stem()?.to_str()?.to_owned();
        let number = stem.strip_prefix(before)?.strip_suffix(after)?;
        let is_number = !number.is_empty() && number.chars().all(digits);
        let number = number.trim_start_matches('0');
        (is_obj && is_number).then(|| ((number.len(), number.to_owned()), path))
    };
    let mut files: Vec<_> = entries.flatten().filter_map(|entry| number(entry.path())).collect();
    if files.len() < 2 {
        let path = path.display();
        return Err(say!("There is no other file beside {path} that is numbered like it", path));
    }
    files.sort();
    let name = format!("{before}{after}");
    let name = name.trim_matches([' ', '_', '-', '.']);
    let name = if name.is_empty() { "sequence" } else { name };
    Ok((name.to_owned(), files.into_iter().map(|(_, path)| path).collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::shapes::cylinder;
    use crate::session::Moment;

    /// A cylinder that leans over, the farther the later; in centimetres.
    fn leaning(picture: u32) -> TriMesh {
        let mut mesh = cylinder(10.0, 170.0, 12, 8);
        mesh.positions.iter_mut().for_each(|p| p.x += p.y * p.y * 1e-4 * f64::from(picture));
        mesh
    }

    fn body() -> TriMesh {
        import(leaning(0), Unit::Centimetre).mesh
    }

    fn write(folder: &Path, name: &str, mesh: &TriMesh) -> PathBuf {
        let path = folder.join(name);
        std::fs::write(&path, obj::mesh("body", mesh)).expect("a file");
        path
    }

    #[test]
    fn files_are_the_pictures_of_an_animation_by_their_numbers() {
        let folder = tempfile::tempdir().expect("a folder");
        for picture in [1, 2, 10] {
            write(folder.path(), &format!("lean_{picture}.obj"), &leaning(picture));
        }
        write(folder.path(), "lean_2b.obj", &cylinder(1.0, 2.0, 5, 1));
        let path = write(folder.path(), "lean_003.OBJ", &leaning(3));
        let (command, count) = read_sequence(&path, &body()).expect("an animation");
        let Command::TakeAnimations { animations } = command else { panic!("{command:?}") };
        assert_eq!((count, animations.name()), (4, "lean"));
        assert!((animations.seconds(0).expect("one") - 0.1).abs() < 1e-6);
        for (at, picture) in [1, 2, 3, 10].into_iter().enumerate() {
            let seconds = (at as f64 / RATE).min(animations.seconds(0).expect("one"));
            let moment = Some(Moment { animation: 0, seconds });
            let there = animations.body("it", moment).expect("a body");
            let crate::session::BodyChoice::Imported { mesh, .. } = there else { panic!("{there:?}") };
            assert_eq!(mesh.triangles, body().triangles);
            for (p, q) in mesh.positions.iter().zip(&leaning(picture).positions) {
                assert!(p.distance(*q / 100.0) < 1e-6, "picture {picture}: {p} {q}");
            }
        }
    }

    #[test]
    fn what_is_no_sequence_of_the_body_is_told() {
        let folder = tempfile::tempdir().expect("a folder");
        let why = |path: &Path| read_sequence(path, &body()).expect_err("no sequence");
        let alone = write(folder.path(), "pose.obj", &leaning(1));
        assert!(why(&alone).contains("no number"), "{}", why(&alone));
        let first = write(folder.path(), "pose1.obj", &leaning(1));
        assert!(why(&first).contains("no other file"), "{}", why(&first));
        write(folder.path(), "pose2.obj", &cylinder(10.0, 170.0, 12, 9));
        assert!(why(&first).contains("pose2.obj has other triangles"), "{}", why(&first));
        std::fs::write(folder.path().join("pose2.obj"), "v 1 2\n").expect("a file");
        assert!(why(&first).contains("pose2.obj"), "{}", why(&first));
        assert!(why(&folder.path().join("nowhere/pose1.obj")).contains("nowhere"));
    }
}
