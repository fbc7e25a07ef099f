//! Reads a cloth mesh with its rest shape: an OBJ file whose texture coordinates are the flat pattern, in metres.

use glam::DVec2;

use crate::geometry::mesh::TriMesh;
use crate::geometry::words::{Words, words};
use crate::io::obj::{self, ObjError};

/// A cloth mesh and, where the file has texture coordinates, its rest shape in the pattern plane.
#[derive(Clone, Debug, PartialEq)]
pub struct ClothMesh {
    /// The mesh in space, metres.
    pub mesh: TriMesh,
    /// For each triangle its three corners in the pattern plane, metres; None when no corner of the file has a `vt`.
    pub rest: Option<Vec<[DVec2; 3]>>,
}

/// Reads a cloth mesh. All faces must be triangles, and either all corners or none must have texture coordinates.
pub fn read(bytes: &[u8]) -> Result<ClothMesh, ObjError> {
    let mesh = obj::read(bytes)?.mesh;
    let text = String::from_utf8_lossy(bytes);
    let (mut coordinates, mut rest) = (Vec::new(), Vec::new());
    let mut bare = 0_usize;
    for (i, line) in text.lines().enumerate() {
        let fault = |words: Words| ObjError::Line { line: i + 1, words };
        let mut words = line.split('#').next().unwrap_or_default().split_whitespace();
        match words.next() {
            Some("vt") => {
                let mut number =
                    || words.next().and_then(|w| w.parse::<f64>().ok()).filter(|n| n.is_finite());
                let (Some(u), Some(v)) = (number(), number()) else {
                    return Err(fault(words!("a texture coordinate needs two numbers")));
                };
                coordinates.push(DVec2::new(u, v));
            }
            Some("f") => {
                let corners: Vec<&str> = words.collect();
                let [a, b, c] = corners[..] else {
                    return Err(fault(words!("a face of cloth has three corners")));
                };
                match [a, b, c].map(|w| w.split('/').nth(1).filter(|t| !t.is_empty())) {
                    [None, None, None] => bare += 1,
                    [Some(a), Some(b), Some(c)] => {
                        let at = |word: &str| {
                            coordinate(word, &coordinates).ok_or_else(|| fault(words!("there is no such vt")))
                        };
                        rest.push([at(a)?, at(b)?, at(c)?]);
                    }
                    _ => return Err(fault(words!("only some corners have a texture coordinate"))),
                }
            }
            _ => {}
        }
    }
    if bare > 0 && !rest.is_empty() {
        return Err(ObjError::File(words!(
            "{bare} faces have no texture coordinates and {n} have",
            bare,
            n = rest.len()
        )));
    }
    // The OBJ reader drops degenerate faces; then `rest` no longer matches the triangles.
    if !rest.is_empty() && rest.len() != mesh.triangles.len() {
        return Err(ObjError::File(words!("a face of cloth is degenerate")));
    }
    Ok(ClothMesh { mesh, rest: (!rest.is_empty()).then_some(rest) })
}

fn coordinate(word: &str, known: &[DVec2]) -> Option<DVec2> {
    let index: i64 = word.parse().ok()?;
    let at = if index > 0 { index - 1 } else { known.len() as i64 + index };
    known.get(usize::try_from(at).ok()?).copied()
}

#[cfg(test)]
mod tests {
    use super::*;

    const FACES: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 2 0\nvt 0 3\n";

    fn refused(text: &str, words: &str) {
        let error = read(text.as_bytes()).expect_err(text).to_string();
        assert!(error.contains(words), "{error}");
    }

    #[test]
    fn corners_have_their_place_in_the_pattern() {
        let cloth = read(format!("{FACES}f 1/1 2/2 3/-1\n").as_bytes()).expect("cloth");
        assert_eq!(cloth.rest, Some(vec![[DVec2::ZERO, DVec2::new(2.0, 0.0), DVec2::new(0.0, 3.0)]]));
        assert_eq!(read(format!("{FACES}f 1 2 3\n").as_bytes()).expect("cloth").rest, None);
    }

    #[test]
    fn half_a_rest_shape_is_refused() {
        refused(&format!("{FACES}f 1/1 2 3/3\n"), "line 7: only some corners");
        refused(&format!("{FACES}f 1/1 2/2 3/3\nf 1 2 3\n"), "1 faces have no texture");
        refused(&format!("{FACES}f 1/1 2/2 3/4\n"), "line 7: there is no such vt");
        refused(&format!("{FACES}v 1 1 0\nf 1 2 4 3\n"), "line 8: a face of cloth has three");
        refused("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 x\nf 1 2 3\n", "line 4");
    }
}
