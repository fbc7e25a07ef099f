//! Frames of a sequence from an animation of a body in glTF.

use std::path::Path;
use std::sync::Arc;

use crate::body::Surface;
use crate::cli::arguments::BodyFile;
use crate::cli::failure::Failure;
use crate::cli::formats;
use crate::geometry::mesh::TriMesh;
use crate::io::moving_body::MovingBody;

/// An animated body.
pub struct Animated {
    body: MovingBody,
    /// Index of the animation that is used.
    clip: usize,
    at_rest: TriMesh,
    fps: f64,
}

impl Animated {
    /// Reads the body in `bytes` (from `path`) and chooses the animation `asked` for, or the first. `fps` is frames per second.
    /// The unit is the one that the body at rest has.
    pub fn new(
        path: &Path,
        bytes: &[u8],
        how: BodyFile,
        asked: Option<&str>,
        fps: f64,
    ) -> Result<Self, Failure> {
        let model = formats::model(path, bytes)?;
        let names: Vec<&str> = model.animations().collect();
        let clip = clip(&names, asked).map_err(|words| Failure::input(path, words))?;
        let up = how.up.unwrap_or_default();
        let mut mesh = model.mesh();
        up.set_upright(&mut mesh);
        let unit = formats::body_unit(path, bytes, &mesh, how)?;
        let (body, imported) = MovingBody::new(model, up, unit);
        Ok(Self { body, clip, at_rest: imported.mesh, fps })
    }

    /// Number of frames of the animation, the last one included.
    pub fn frames(&self) -> usize {
        ((self.body.seconds(self.clip).unwrap_or(0.0) * self.fps + 1e-6).floor() as usize).saturating_add(1)
    }

    /// A note on the other animations if none was `asked` for.
    pub fn notes(&self, asked: Option<&str>) -> Vec<String> {
        let names: Vec<&str> = self.body.animations().collect();
        let words = || format!("it has {}: the first is taken (see --animation)", listed(&names));
        if names.len() > 1 && asked.is_none() { vec![words()] } else { Vec::new() }
    }

    /// The body in frame `i`. The body at rest must have the triangles of `dressed`.
    pub fn body(&self, i: usize, dressed: &Surface, path: &Path) -> Result<Arc<Surface>, Failure> {
        formats::same_triangles(path, &self.at_rest, &dressed.mesh)?;
        let positions = self.body.positions(Some((self.clip, i as f64 / self.fps)));
        let words = || format!("frame {}: a vertex of it is no place", i + 1);
        dressed.reposed(positions).map(Arc::new).ok_or_else(|| Failure::input(path, words()))
    }
}

/// The index of the animation `asked` for, by its name or by its number from 1; the first if none is. The error says that there
/// is none, or more than one of that name.
fn clip(names: &[&str], asked: Option<&str>) -> Result<usize, String> {
    if names.is_empty() {
        return Err("there is no animation in it".to_owned());
    }
    let Some(asked) = asked else { return Ok(0) };
    let called: Vec<usize> = (0..names.len()).filter(|&i| names[i] == asked).collect();
    match called[..] {
        [one] => Ok(one),
        [] => {
            let number = asked.parse::<usize>().ok().and_then(|number| number.checked_sub(1));
            let known = number.filter(|&i| i < names.len());
            known.ok_or_else(|| format!("there is no animation {asked:?} in it; it has {}", listed(names)))
        }
        _ => Err(format!(
            "{} animations in it are called {asked:?}: give a number; it has {}",
            called.len(),
            listed(names)
        )),
    }
}

/// A list of animations in words, such as "2 animations: 1 walk, 2 run".
fn listed(names: &[&str]) -> String {
    let each = names.iter().enumerate().map(|(i, name)| format!("{} {name}", i + 1).trim_end().to_owned());
    let plural = if names.len() == 1 { "" } else { "s" };
    format!("{} animation{plural}: {}", names.len(), each.collect::<Vec<_>>().join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_animation_is_chosen_by_name_or_number() {
        let names = ["walk", "run", "1", "", "run"];
        assert_eq!(clip(&names, None), Ok(0));
        assert_eq!(clip(&names, Some("walk")), Ok(0));
        assert_eq!(clip(&names, Some("1")), Ok(2), "a name goes before a number");
        assert_eq!(clip(&names, Some("5")), Ok(4));
        for asked in ["0", "6", "-1", "jump", "99999999999999999999", "run"] {
            let why = clip(&names, Some(asked)).expect_err(asked);
            assert!(why.contains("5 animations: 1 walk, 2 run, 3 1, 4, 5 run"), "{why}");
        }
        assert!(clip(&[], None).is_err() && clip(&[], Some("1")).is_err());
    }
}
