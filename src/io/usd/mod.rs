//! Writes scenes as USD: the garment as one mesh per piece, its trims as one mesh for each kind and colour, and the body, with
//! materials as UsdPreviewSurface; as text (.usda) with images beside it, or as one package (.usdz).
//!
//! Texture coordinates `st` are the pattern plane in metres, or with textures those of the atlas; `st1` then counts repeats of
//! the weave. Materials of USD know no sides: those of the outer side are seen from both.

mod meshes;
mod names;
mod package;
mod prim;
mod shading;

use std::sync::Arc;

use glam::DVec3;

use crate::cloth::{ClothState, Wedges};
use crate::geometry::mesh::{TriMesh, vertex_normals};
use crate::geometry::words::{Words, words};
use crate::io::dressed::{Dressed, Frame, PieceArrays, TrimArrays};
use crate::io::materials::{ClothMaterial, Colours, ROUGHNESS};
use crate::io::normals::{Normals, wedges_of_piece};
use meshes::{MeshArrays, MovedMesh};
use names::Names;
use prim::{Prim, quoted};
use shading::{Look, Map};

/// The prim that all others are in.
const ROOT: &str = "garment";
/// The prim that materials are in.
const MATERIALS: &str = "materials";
/// Name of the scene in a package.
const IN_PACKAGE: &str = "garment.usda";
/// Names of texture coordinates: of the atlas, and of the weave.
const COORDINATES: [&str; 2] = ["st", "st1"];

/// Why no scene was written.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.words())]
pub enum UsdError {
    /// There is neither cloth nor body to write.
    Empty,
    /// The package exceeds 4 GiB; lengths in it are 32-bit.
    TooLarge,
    /// The package could not be written.
    Package(String),
}

impl UsdError {
    /// The error in words.
    pub fn words(&self) -> Words {
        match self {
            Self::Empty => words!("there is nothing to write: no cloth is on the body yet"),
            Self::TooLarge => words!("the scene is larger than 4 GiB, which is all a USDZ file can hold"),
            Self::Package(why) => words!("the USDZ file cannot be packed: {why}", why),
        }
    }
}

/// How a scene is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UsdFormat {
    /// Text with its images beside it (.usda).
    Text,
    /// One file with its images in it (.usdz).
    Package,
}

impl UsdFormat {
    /// The format of files with this ending, in lower case.
    pub fn of_ending(ending: &str) -> Option<Self> {
        match ending {
            "usda" => Some(Self::Text),
            "usdz" => Some(Self::Package),
            _ => None,
        }
    }
}

/// Approximate number of bytes that one frame adds to a moving scene; trims count as the body does.
pub fn bytes_per_frame(cloth_vertices: usize, body_vertices: usize) -> usize {
    84 * (cloth_vertices + body_vertices)
}

/// A scene in USD.
#[derive(Clone, Debug)]
pub struct UsdScene {
    text: String,
    images: Vec<(String, Arc<Vec<u8>>)>,
}

impl UsdScene {
    /// The scene of `dressed` on `body`. Triangles that are not yet placed on the body are left out. Images are expected at
    /// `image_path` of their names, a path with slashes beside the scene.
    ///
    /// # Errors
    /// There is neither cloth nor body.
    pub fn new(
        dressed: Dressed<'_>,
        body: Option<&TriMesh>,
        colours: &Colours,
        image_path: impl Fn(&str) -> String,
    ) -> Result<Self, UsdError> {
        let mut builder = Builder::new(colours, &image_path);
        builder.garment(&dressed, &[]);
        if let Some(body) = body {
            builder.body(body, &[]);
        }
        builder.finish(&[])
    }

    /// The scene of `dressed` on `body` that moves through `frames`, one at each time code from 0. The vertices of each frame are
    /// those of `dressed.garment` and of `body`, of which only the triangles are used. Triangles that are not yet placed on the
    /// body are left out. Images are expected as by [`UsdScene::new`].
    ///
    /// # Errors
    /// There is neither cloth nor body, or there are no frames.
    pub fn moving(
        dressed: Dressed<'_>,
        body: &TriMesh,
        frames: &[Frame],
        frames_per_second: f64,
        colours: &Colours,
        image_path: impl Fn(&str) -> String,
    ) -> Result<Self, UsdError> {
        let first = frames.first().ok_or(UsdError::Empty)?;
        let state = ClothState { positions: first.cloth.clone(), mapped: dressed.state.mapped.clone() };
        let mut builder = Builder::new(colours, &image_path);
        builder.garment(&Dressed { state: &state, ..dressed }, frames);
        builder.body(&TriMesh { positions: first.body.clone(), triangles: body.triangles.clone() }, frames);
        builder.finish(&[
            format!("endTimeCode = {}", frames.len() - 1),
            format!("framesPerSecond = {frames_per_second}"),
            "startTimeCode = 0".to_owned(),
            format!("timeCodesPerSecond = {frames_per_second}"),
        ])
    }

    /// The images that materials name, by their paths, as PNG.
    pub fn images(&self) -> &[(String, Arc<Vec<u8>>)] {
        &self.images
    }

    /// The scene as text (.usda), without its images.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The scene and its images in one file (.usdz).
    ///
    /// # Errors
    /// They are larger than 4 GiB.
    pub fn package(&self) -> Result<Vec<u8>, UsdError> {
        let images = self.images.iter().map(|(path, png)| (path.as_str(), png.as_slice()));
        package::package(std::iter::once((IN_PACKAGE, self.text.as_bytes())).chain(images))
    }
}

struct Builder<'a> {
    colours: &'a Colours,
    /// The path of an image by its name.
    image_path: &'a dyn Fn(&str) -> String,
    meshes: Vec<Prim>,
    mesh_names: Names,
    materials: Vec<Prim>,
    material_names: Names,
    /// Materials of cloth that are written, and their paths.
    cloth: Vec<(ClothMaterial, String)>,
    /// Images that are written, by their numbers and paths.
    images: Vec<(usize, String)>,
}

impl<'a> Builder<'a> {
    fn new(colours: &'a Colours, image_path: &'a dyn Fn(&str) -> String) -> Self {
        let mut mesh_names = Names::default();
        mesh_names.take(MATERIALS, MATERIALS);
        Self {
            colours,
            image_path,
            meshes: Vec::new(),
            mesh_names,
            materials: Vec::new(),
            material_names: Names::default(),
            cloth: Vec::new(),
            images: Vec::new(),
        }
    }

    /// Adds the pieces; `frames` move them, if there are several.
    fn garment(&mut self, dressed: &Dressed<'_>, frames: &[Frame]) {
        let Dressed { garment, state, .. } = *dressed;
        let triangles = dressed.laid();
        let wedges = Wedges::new(garment);
        let normals_at = |positions: &[DVec3]| Normals::new(garment, &wedges, positions, &triangles);
        let normals = normals_at(&state.positions);
        let moved: Vec<Normals> = frames.iter().map(|frame| normals_at(&frame.cloth)).collect();
        for (id, name) in &garment.pieces {
            let own = triangles.iter().copied().filter(|&t| garment.triangle_pieces[t] == *id);
            let piece =
                PieceArrays::new(dressed, *id, own, (&wedges, &normals), self.colours.textures.as_deref());
            if piece.triangles.is_empty() {
                continue;
            }
            let own = wedges_of_piece(&wedges, garment, *id);
            let vertex = |wedge: usize| garment.corners[wedges.corners[wedge] as usize].vertex as usize;
            let of = |(frame, normals): (&Frame, &Normals)| {
                let positions = own.iter().map(|wedge| frame.cloth[vertex(wedge)]).collect();
                (positions, own.iter().map(|wedge| normals.wedges[wedge]).collect())
            };
            let moved: Vec<MovedMesh> = frames.iter().zip(&moved).map(of).collect();
            self.piece(name, &piece, &self.colours.of(*id), &moved);
        }
        let state_of =
            |frame: &Frame| ClothState { positions: frame.cloth.clone(), mapped: state.mapped.clone() };
        let states: Vec<ClothState> = frames.iter().map(state_of).collect();
        for (part, material) in dressed.trims(self.colours) {
            let trim = |(state, normals): (&ClothState, &Normals)| {
                let moved = TrimArrays::new(&Dressed { state, ..*dressed }, part, normals);
                (moved.positions, moved.normals)
            };
            let moved: Vec<MovedMesh> = states.iter().zip(&moved).map(trim).collect();
            self.trim(&TrimArrays::new(dressed, part, &normals), &material, &moved);
        }
    }

    /// Adds trims, which are called like their material. The layer of a hem is seen from both sides.
    fn trim(&mut self, trim: &TrimArrays, material: &ClothMaterial, frames: &[MovedMesh]) {
        let made_of = self.cloth_material(material);
        let arrays = MeshArrays {
            positions: &trim.positions,
            normals: &trim.normals,
            triangles: &trim.triangles,
            coordinates: COORDINATES.map(|name| (name, &[][..])),
            is_double_sided: true,
            colour: material.sides[0],
        };
        self.mesh(&material.name, &made_of, arrays, frames);
    }

    fn piece(&mut self, name: &str, piece: &PieceArrays, material: &ClothMaterial, frames: &[MovedMesh]) {
        let made_of = self.cloth_material(material);
        let PieceArrays { positions, normals, uv, weave, triangles } = piece;
        let [atlas, repeats] = COORDINATES;
        let arrays = MeshArrays {
            positions,
            normals,
            triangles,
            coordinates: [(atlas, uv), (repeats, weave)],
            is_double_sided: true,
            colour: material.sides[0],
        };
        self.mesh(name, &made_of, arrays, frames);
    }

    fn body(&mut self, body: &TriMesh, frames: &[Frame]) {
        let colour = self.colours.body;
        let look = Look { colour, roughness: ROUGHNESS, opacity: 1.0, ..Look::default() };
        let made_of = self.material("body", &look);
        let arrays = MeshArrays {
            positions: &body.positions,
            normals: &body.vertex_normals(),
            triangles: &body.triangles,
            coordinates: COORDINATES.map(|name| (name, &[][..])),
            is_double_sided: false,
            colour,
        };
        let moved = |frame: &Frame| (frame.body.clone(), vertex_normals(&frame.body, &body.triangles));
        let moved: Vec<MovedMesh> = frames.iter().map(moved).collect();
        self.mesh("body", &made_of, arrays, &moved);
    }

    fn mesh(&mut self, name: &str, made_of: &str, arrays: MeshArrays<'_>, frames: &[MovedMesh]) {
        let own = self.mesh_names.take(name, "piece");
        let mut mesh = named(meshes::mesh(&own, made_of, arrays), &own, name);
        if frames.len() > 1 {
            meshes::move_through(&mut mesh, frames);
        }
        self.meshes.push(mesh);
    }

    /// The path of a material of cloth, which is written once.
    fn cloth_material(&mut self, wanted: &ClothMaterial) -> String {
        if let Some((_, path)) = self.cloth.iter().find(|(material, _)| material == wanted) {
            return path.clone();
        }
        let ClothMaterial { name, sides: [colour, _], roughness, opacity, textures } = wanted;
        let [atlas, repeats] = COORDINATES;
        let mut map = |image: usize, coordinates: &'static str, is_repeated: bool| {
            Some(Map { path: self.image(image)?, coordinates, is_repeated })
        };
        let colours = textures.and_then(|own| map(own.sides[0], atlas, false));
        let normals = textures.and_then(|own| match own.weave {
            Some(image) => map(image, repeats, true),
            None => map(own.normal?, atlas, false),
        });
        let look = Look { colour: *colour, roughness: *roughness, opacity: *opacity, colours, normals };
        let path = self.material(name, &look);
        self.cloth.push((wanted.clone(), path.clone()));
        path
    }

    /// Adds a material; its path.
    fn material(&mut self, name: &str, look: &Look) -> String {
        let own = self.material_names.take(name, "material");
        let folder = format!("/{ROOT}/{MATERIALS}");
        self.materials.push(named(shading::material(&folder, &own, look), &own, name));
        format!("{folder}/{own}")
    }

    /// The path of an image that a material names; None where there is no such image.
    fn image(&mut self, image: usize) -> Option<String> {
        if let Some((_, path)) = self.images.iter().find(|(written, _)| *written == image) {
            return Some(path.clone());
        }
        let path = (self.image_path)(&self.colours.textures.as_ref()?.images.get(image)?.name);
        self.images.push((image, path.clone()));
        Some(path)
    }

    /// The scene; `metadata` are lines of it.
    fn finish(self, metadata: &[String]) -> Result<UsdScene, UsdError> {
        if self.meshes.is_empty() {
            return Err(UsdError::Empty);
        }
        let mut materials = Prim::new("Scope", MATERIALS);
        materials.children = self.materials;
        let mut root = Prim::new("Xform", ROOT);
        root.metadata("kind", &quoted("component"));
        root.children = std::iter::once(materials).chain(self.meshes).collect();
        let files = self.colours.textures.as_ref().map(|textures| &textures.images);
        let png = |image: usize| files.and_then(|files| files.get(image)).map(|file| Arc::clone(&file.png));
        let images = self.images.into_iter().filter_map(|(image, path)| Some((path, png(image)?))).collect();
        Ok(UsdScene { text: prim::layer(metadata, &root), images })
    }
}

/// `prim`, called `own`, with the `name` that it has here where that is another.
fn named(mut prim: Prim, own: &str, name: &str) -> Prim {
    if own != name {
        prim.metadata("displayName", &quoted(name));
    }
    prim
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
