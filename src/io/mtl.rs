//! Writes materials as Wavefront MTL text, with the keys that programs agreed on for physically based ones (Pr: roughness, Pm:
//! metalness, norm: normal map).

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::geometry::ids::PieceId;
use crate::io::materials::{ClothMaterial, Colours};

/// Materials of a garment as a file beside an OBJ file.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialFile {
    /// The text.
    pub text: String,
    /// Name of the material of each piece.
    pub names: BTreeMap<PieceId, String>,
}

/// Writes the materials of `pieces`. OBJ knows no sides of a surface: those of the outer side are written. Images are expected
/// in files called `file_name` of their names.
pub fn write(
    pieces: impl Iterator<Item = PieceId>,
    colours: &Colours,
    file_name: impl Fn(&str) -> String,
) -> MaterialFile {
    let mut text = String::from("# materials of the outer side\n");
    let mut written: Vec<(ClothMaterial, String)> = Vec::new();
    let mut names = BTreeMap::new();
    for piece in pieces {
        let material = colours.of(piece);
        let known = written.iter().find(|(other, _)| *other == material).map(|(_, name)| name.clone());
        let name = known.unwrap_or_else(|| {
            let name = unique(&material.name, &written);
            text += &one(&name, &material, colours, &file_name);
            written.push((material, name.clone()));
            name
        });
        names.insert(piece, name);
    }
    MaterialFile { text, names }
}

/// `name` without spaces, at which names in such files end.
pub fn plain(name: &str) -> String {
    name.chars().map(|c| if c.is_control() || c.is_whitespace() { '_' } else { c }).collect()
}

/// A name without spaces that no other material has.
fn unique(name: &str, written: &[(ClothMaterial, String)]) -> String {
    let plain = plain(name);
    let is_free = |name: &String| written.iter().all(|(_, other)| other != name);
    let mut numbered = (2..).map(|i| format!("{plain}-{i}"));
    std::iter::once(plain.clone()).chain(&mut numbered).find(is_free).unwrap_or(plain)
}

fn one(
    name: &str,
    material: &ClothMaterial,
    colours: &Colours,
    file_name: &impl Fn(&str) -> String,
) -> String {
    let ClothMaterial { name: _, sides: [outside, _], roughness, opacity, textures } = material;
    let image = |i: usize| {
        let image = colours.textures.as_ref()?.images.get(i)?;
        Some(file_name(&image.name))
    };
    let colour = textures.and_then(|own| image(own.sides[0]));
    let [r, g, b] = if colour.is_some() { [1.0; 3] } else { *outside };
    // The exponent of a highlight of this roughness, for programs that know no other.
    let shine = 1000.0 * (1.0 - roughness) * (1.0 - roughness);
    let mut text = format!("\nnewmtl {name}\nKd {r:.4} {g:.4} {b:.4}\nKs 0.04 0.04 0.04\nNs {shine:.1}\n");
    let _ = write!(text, "Pr {roughness:.3}\nPm 0\nd {opacity:.3}\nillum 2\n");
    if let Some(file) = colour {
        let _ = writeln!(text, "map_Kd {file}");
    }
    if let Some(file) = textures.and_then(|own| image(own.normal?)) {
        let _ = write!(text, "norm {file}\nmap_Bump -bm 1.0 {file}\n");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_have_no_spaces() {
        assert_eq!(plain("my\tshirt 2"), "my_shirt_2");
    }

    #[test]
    fn equal_materials_are_written_once_and_names_are_unique() {
        let material = |name: &str, red: f32| ClothMaterial {
            name: name.to_owned(),
            sides: [[red, 0.5, 0.5], [0.0; 3]],
            roughness: 0.75,
            opacity: 1.0,
            textures: None,
        };
        let pieces = [(1, "a b", 0.1), (2, "a b", 0.1), (3, "a b", 0.2)];
        let pieces = pieces.map(|(id, name, red)| (PieceId(id), material(name, red)));
        let colours = Colours { pieces: BTreeMap::from(pieces), ..Colours::default() };
        let file = write((1..=4).map(PieceId), &colours, str::to_owned);
        assert_eq!(file.names.values().collect::<Vec<_>>(), ["a_b", "a_b", "a_b-2", "cloth"]);
        assert_eq!(file.text.matches("newmtl").count(), 3);
        assert!(
            file.text.contains("Kd 0.1000 0.5000 0.5000") && file.text.contains("Pr 0.750"),
            "{}",
            file.text
        );
    }
}
