//! The Python package: built as a wheel, installed, and used on a ball.

use std::path::Path;
use std::process::Command;

use crate::program::{Place, ended};

/// What is done with the package; its arguments are the folder of the wheel and what is to be dressed.
const SCRIPT: &str = r#"
import sys
import numpy as np
import toile

assert toile.__file__.startswith(sys.argv[1]), toile.__file__
ball = toile.dress("ball.toile", no_picture=True)
assert ball.faults == [] and ball.vertices.shape[1] == 3 and ball.vertices.dtype == np.float64
assert ball.triangles.shape == ball.flat_triangles.shape == (ball.report["triangles"], 3)
assert ball.triangles.min() == 0 and ball.triangles.max() == len(ball.vertices) - 1
assert ball.flat_triangles.min() == 0 and ball.flat_triangles.max() == len(ball.flat) - 1
assert set(ball.pieces) == {"left", "right"}
assert sorted(np.concatenate(list(ball.pieces.values()))) == list(range(len(ball.triangles)))
# The cloth lies round the body, and its flat triangles have the areas of those on it.
middle = ball.body.vertices.mean(axis=0)
assert np.linalg.norm(ball.vertices - middle, axis=1).min() > 0.9 * np.linalg.norm(ball.body.vertices - middle, axis=1).min()
def area(points, triangles):
    a, b, c = (np.pad(points, ((0, 0), (0, 3 - points.shape[1])))[triangles[:, i]] for i in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2
assert abs(area(ball.vertices, ball.triangles) / area(ball.flat, ball.flat_triangles) - 1) < 0.1

coarse = toile.dress("ball.toile", out="kept", edge_length=0.08, no_picture=True)
assert coarse.folder.name == "kept" and len(coarse.triangles) < len(ball.triangles)

fit = toile.fit(ball, maps=["strain", "ease"])
assert {"ease", "warp", "weft"} <= set(fit.maps), set(fit.maps)
ease = fit.maps["ease"]
assert ease.unit == "mm" and len(ease.values) == len(ease.flat) == len(ease.pieces) > 0
assert set(ease.pieces) == {"left", "right"} and ease.vertices.max() < len(ball.vertices)

again = toile.repose(ball, body=ball.folder / "body.obj", no_such_option=None)
assert again.report["reposed"] and again.triangles.tolist() == ball.triangles.tolist()
assert np.abs(again.vertices - ball.vertices).max() < 0.01

def fails(kind, words, call):
    try:
        call()
    except kind as error:
        assert words in str(error), (words, str(error))
        return error
    raise AssertionError(kind)

fails(toile.FileError, "none.toile", lambda: toile.dress("none.toile"))
fails(toile.BadInput, "broken.toile: ", lambda: toile.dress("broken.toile"))
fails(toile.OverLimit, "after 2 ticks", lambda: toile.dress("ball.toile", max_ticks=2))
fails(toile.UsageError, "--sleeves", lambda: toile.dress("ball.toile", sleeves=2))
print("done")
"#;

/// The Python to test with: TOILE_PYTHON, or what the path has.
fn python(arguments: &[&str], place: &Place) -> Command {
    let program = std::env::var_os("TOILE_PYTHON").unwrap_or_else(|| "python3".into());
    let mut command = Command::new(program);
    command.args(arguments).current_dir(place.path("")).env("TOILE", env!("CARGO_BIN_EXE_toile"));
    command.env("WGPU_BACKEND", "dx12").env("PYTHONDONTWRITEBYTECODE", "1");
    command
}

/// Copies the files of a folder, without those that others have left in it.
fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).expect("made");
    for entry in std::fs::read_dir(from).expect("a folder").flatten() {
        let (path, to) = (entry.path(), to.join(entry.file_name()));
        match path.is_dir() {
            true => copy(&path, &to),
            false => drop(std::fs::copy(path, to).expect("copied")),
        }
    }
}

#[test]
fn a_wheel_is_built_and_its_arrays_are_right() {
    let place = Place::with_ball();
    place.write("broken.toile", "{}");
    let needs =
        "import importlib.util as u; assert all(map(u.find_spec, ['numpy', 'pip', 'setuptools', 'wheel']))";
    if !python(&["-c", needs], &place).output().is_ok_and(|output| output.status.success()) {
        println!("there is no Python with NumPy, pip, setuptools and wheel: its package is not tested");
        return;
    }
    copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/python"), &place.path("source"));
    let pip = |arguments: &[&str]| {
        let all: Vec<&str> =
            ["-m", "pip", "--quiet", "--no-input"].iter().chain(arguments).copied().collect();
        let done = ended(python(&all, &place).output().expect("it was here"));
        assert_eq!(done.code, 0, "pip {arguments:?}: {done:#?}");
    };
    pip(&["wheel", "--no-deps", "--no-build-isolation", "--no-index", "--wheel-dir", "wheels", "./source"]);
    let wheels = place.names("wheels");
    assert_eq!(wheels, [format!("toile-{}-py3-none-any.whl", env!("CARGO_PKG_VERSION"))]);
    let wheel = format!("wheels/{}", wheels[0]);
    pip(&["install", "--no-deps", "--no-index", "--target", "installed", &wheel]);
    assert!(place.path("installed/toile/py.typed").exists());
    place.write("script.py", SCRIPT);
    let installed = place.path("installed").display().to_string();
    let used = python(&["script.py", &installed], &place).env("PYTHONPATH", &installed).output();
    let used = ended(used.expect("it was here"));
    assert!(used.code == 0 && used.out == "done\n", "{used:#?}");
}
