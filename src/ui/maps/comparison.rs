//! Comparison with another garment of the same pieces: it is shown beside the present one, and maps are subtracted.

use std::path::Path;
use std::sync::Arc;

use glam::{DVec3, Vec3};

use crate::cloth::Garment;
use crate::fit::{Map, MapKind, Matching};
use crate::geometry::words::Words;
use crate::render::{Mesh, Palette};
use crate::session::{Outfit, Session};
use crate::sim::{Runner, Simulation};
use crate::ui::files;
use crate::ui::language::{said, say};
use crate::ui::scenery::body_look::BodyLook;
use crate::ui::scenery::mapped::in_colours;
use crate::ui::scenery::scene::{body_mesh, cloth_mesh};

/// Gap between the two figures, metres on a body 1.5 m tall.
const GAP: f64 = 0.12;

/// The garment of another project.
#[derive(Debug)]
pub struct Comparison {
    /// Name of its file.
    pub name: String,
    /// Whether the present garment shows the difference of the maps instead of its own map.
    pub difference: bool,
    outfit: Outfit,
    /// Matching with the present garment that was compared last; the error names the pieces that differ.
    matched: Option<(Arc<Garment>, Result<Matching, Words>)>,
    /// The map of this garment, of the kind that was shown last.
    map: Option<Map>,
    drawn: Option<(Place, Arc<Vec<Arc<Mesh>>>)>,
}

/// Why a project cannot be shown beside, with the path of its file. It is put into words on the thread of the window.
#[derive(Debug)]
pub enum Unlike {
    /// The file cannot be read, in words.
    Unread(String),
    /// No cloth is on its body.
    NoCloth(String),
    /// The pieces differ, and how.
    Pieces(String, Words),
}

impl Unlike {
    /// A message.
    pub fn words(self) -> String {
        match self {
            Self::Unread(words) => words,
            Self::NoCloth(file) => say!("{file}: there is no cloth on its body", file),
            Self::Pieces(file, why) => {
                say!("{file}: it has not the pieces of this pattern: {why}", file, why = said(&why))
            }
        }
    }
}

/// Position and colours of the drawn garment, to tell whether it must be drawn again.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Place {
    shift: Vec3,
    colours: Option<(MapKind, [f64; 2])>,
    body_look: BodyLook,
}

impl Comparison {
    /// Opens the project at `path` and matches its garment with `present`.
    pub fn open(path: &Path, present: &Outfit) -> Result<Self, Unlike> {
        let file = || path.display().to_string();
        let project = files::open(path).map_err(Unlike::Unread)?;
        let mut session = Session::new(project, Runner::inline(Simulation::default()));
        session.update();
        let outfit = Outfit::of(session.snapshot(), &session.document().fabrics);
        let outfit = outfit.ok_or_else(|| Unlike::NoCloth(file()))?;
        let matching =
            Matching::new(outfit.worn(), present.worn()).map_err(|why| Unlike::Pieces(file(), why.0))?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let matched = Some((Arc::clone(&present.garment), Ok(matching)));
        Ok(Self { name, difference: false, outfit, matched, map: None, drawn: None })
    }

    /// This garment's map of `kind`.
    fn map(&mut self, kind: MapKind) -> &Map {
        if self.map.as_ref().is_some_and(|map| map.kind != kind) {
            self.map = None;
        }
        self.map.get_or_insert_with(|| Map::new(kind, self.outfit.worn()))
    }

    /// The difference: `map` of `present` minus the same map of this garment. None if their pieces differ.
    pub fn less(&mut self, present: &Outfit, map: &Map) -> Option<Map> {
        if !self.matched.as_ref().is_some_and(|(of, _)| Arc::ptr_eq(of, &present.garment)) {
            let matching = Matching::new(self.outfit.worn(), present.worn()).map_err(|why| why.0);
            self.matched = Some((Arc::clone(&present.garment), matching));
        }
        self.map(map.kind);
        let (Some((_, Ok(matching))), Some(own)) = (&self.matched, &self.map) else { return None };
        Some(matching.difference((&self.outfit.garment, own), (&present.garment, map)))
    }

    /// Why there is no difference to `present`, as a message.
    pub fn unlike(&self) -> Option<String> {
        self.matched.as_ref()?.1.as_ref().err().map(said)
    }

    /// Builds the meshes of this garment, on the right of `present` or on the left, in the colours of the given map and range, on
    /// its body with `body_look`.
    pub(super) fn draw_beside(
        &mut self,
        present: &Outfit,
        on_the_left: bool,
        colours: Option<(MapKind, [f64; 2], Palette)>,
        body_look: BodyLook,
    ) {
        let ((left, right), (own_left, own_right)) = (present.body.bounds(), self.outfit.body.bounds());
        let gap = GAP * present.body.scale();
        let aside = if on_the_left { left.x - own_right.x - gap } else { right.x - own_left.x + gap };
        let shift = (DVec3::X * aside).as_vec3();
        let place = Place { shift, colours: colours.map(|(kind, range, _)| (kind, range)), body_look };
        if self.drawn.as_ref().is_some_and(|(drawn, _)| *drawn == place) {
            return;
        }
        let mut cloth = cloth_mesh(&self.outfit.garment, &self.outfit.state);
        if let Some((kind, range, palette)) = colours {
            let inks: Vec<_> = self.map(kind).vertices.iter().map(|&v| palette.colour(v, range)).collect();
            cloth = in_colours(&cloth, &inks).unwrap_or(cloth);
        }
        let meshes = [body_mesh(&self.outfit.body, body_look), cloth].map(|mut mesh| {
            mesh.positions.iter_mut().for_each(|p| *p += shift);
            Arc::new(mesh)
        });
        self.drawn = Some((place, Arc::new(meshes.into())));
    }

    /// Removes the meshes while there is no cloth to compare with.
    pub(super) fn put_away(&mut self) {
        self.drawn = None;
    }

    /// The meshes of this garment; None while there is no cloth to compare with.
    pub fn meshes(&self) -> Option<&Arc<Vec<Arc<Mesh>>>> {
        self.drawn.as_ref().map(|(_, meshes)| meshes)
    }
}
