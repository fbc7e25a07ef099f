//! Materials of USD: UsdPreviewSurface with its textures.

use super::prim::{Prim, asset, quoted, tuple};

/// Numbers of a normal map, 0..=1, are multiplied and added to for a direction, -1..=1.
const NORMAL_SCALE: [f32; 4] = [2.0, 2.0, 2.0, 1.0];
const NORMAL_BIAS: [f32; 4] = [-1.0, -1.0, -1.0, 0.0];

/// What a surface looks like.
#[derive(Clone, Debug, Default)]
pub(super) struct Look {
    /// Base colour, linear RGB, 0..=1; a texture replaces it.
    pub colour: [f32; 3],
    /// Roughness, 0..=1.
    pub roughness: f32,
    /// Opacity, 0..=1.
    pub opacity: f32,
    /// Image of base colours.
    pub colours: Option<Map>,
    /// Image of normals.
    pub normals: Option<Map>,
}

/// An image on a surface.
#[derive(Clone, Debug)]
pub(super) struct Map {
    /// Path of the image.
    pub path: String,
    /// The texture coordinates that it is read with.
    pub coordinates: &'static str,
    /// Whether it is repeated all over the surface.
    pub is_repeated: bool,
}

/// The material called `name` in the prim at `folder`.
pub(super) fn material(folder: &str, name: &str, look: &Look) -> Prim {
    let path = format!("{folder}/{name}");
    let Look { colour, roughness, opacity, colours, normals } = look;
    let mut surface = shader("surface", "UsdPreviewSurface");
    match colours {
        Some(_) => surface.connect("color3f inputs:diffuseColor", &format!("{path}/colour.outputs:rgb")),
        None => surface.attribute("color3f inputs:diffuseColor", &tuple(*colour)),
    }
    surface.attribute("float inputs:metallic", "0");
    if normals.is_some() {
        surface.connect("normal3f inputs:normal", &format!("{path}/normal.outputs:rgb"));
    }
    surface.attribute("float inputs:opacity", &opacity.to_string());
    surface.attribute("float inputs:roughness", &roughness.to_string());
    surface.output("token outputs:surface");
    let mut material = Prim::new("Material", name);
    material.connect("token outputs:surface", &format!("{path}/surface.outputs:surface"));
    material.children.push(surface);
    if let Some(map) = colours {
        let mut colour = texture(&path, "colour", map, "sRGB");
        colour.output("float3 outputs:rgb");
        material.children.push(colour);
    }
    if let Some(map) = normals {
        let mut normal = texture(&path, "normal", map, "raw");
        normal.attribute("float4 inputs:scale", &tuple(NORMAL_SCALE));
        normal.attribute("float4 inputs:bias", &tuple(NORMAL_BIAS));
        normal.output("float3 outputs:rgb");
        material.children.push(normal);
    }
    let mut sets: Vec<&str> = colours.iter().chain(normals).map(|map| map.coordinates).collect();
    sets.dedup();
    material.children.extend(sets.into_iter().map(reader));
    material
}

fn shader(name: &str, id: &str) -> Prim {
    let mut shader = Prim::new("Shader", name);
    shader.attribute("uniform token info:id", &quoted(id));
    shader
}

/// The reader of a set of texture coordinates, called like it.
fn reader(coordinates: &str) -> Prim {
    let mut reader = shader(coordinates, "UsdPrimvarReader_float2");
    reader.attribute("string inputs:varname", &quoted(coordinates));
    reader.output("float2 outputs:result");
    reader
}

/// The texture called `name` in the material at `material`.
fn texture(material: &str, name: &str, map: &Map, colour_space: &str) -> Prim {
    let Map { path, coordinates, is_repeated } = map;
    let wrap = quoted(if *is_repeated { "repeat" } else { "clamp" });
    let mut texture = shader(name, "UsdUVTexture");
    texture.attribute("asset inputs:file", &asset(path));
    texture.attribute("token inputs:sourceColorSpace", &quoted(colour_space));
    texture.connect("float2 inputs:st", &format!("{material}/{coordinates}.outputs:result"));
    texture.attribute("token inputs:wrapS", &wrap);
    texture.attribute("token inputs:wrapT", &wrap);
    texture
}
