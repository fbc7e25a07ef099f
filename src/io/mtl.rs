//! Writes materials as Wavefront MTL text, with the keys that programs agreed on for physically based ones (Pr: roughness, Pm:
//! metalness, norm: normal map).

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::geometry::ids::PieceId;
use crate::io::dressed::Dressed;
use crate::io::materials::{ClothMaterial, Colours};

/// Materials of a garment as a file beside an OBJ file.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialFile {
    /// The text.
    pub text: String,
    /// Name of the material of each piece.
    pub names: BTreeMap<PieceId, String>,
    /// Name of the material of each part of the trims.
    pub trims: Vec<String>,
}

/// Writes the materials of the pieces of `dressed`, then those of its trims. OBJ knows no sides of a surface: those of the outer
/// side are written. Images are expected in files called `file_name` of their names.
pub fn write(dressed: &Dressed<'_>, colours: &Colours, file_name: impl Fn(&str) -> String) -> MaterialFile {
    let mut text = String::from("# materials of the outer side\n");
    let mut written: Vec<(ClothMaterial, String)> = Vec::new();
    let mut add = |material: ClothMaterial| {
        let known = written.iter().find(|(other, _)| *other == material).map(|(_, name)| name.clone());
        known.unwrap_or_else(|| {
            let name = unique(&material.name, &written);
            text += &one(&name, &material, colours, &file_name);
            written.push((material, name.clone()));
            name
        })
    };
    let names = dressed.garment.pieces.iter().map(|&(id, _)| (id, add(colours.of(id)))).collect();
    let trims = dressed.trims(colours).into_iter().map(|(_, material)| add(material)).collect();
    MaterialFile { text, names, trims }
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
    use crate::cloth::{ClothState, Garment};
    use crate::io::dressed::tests::trimmed_squares;
    use crate::pattern::Pattern;

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
        let pieces = (1..=4).map(|id| (PieceId(id), "piece".to_owned())).collect();
        let garment = Garment { pieces, ..Garment::default() };
        let (state, pattern) = (ClothState::default(), Pattern::default());
        let dressed = Dressed { garment: &garment, state: &state, pattern: &pattern, trims: &[] };
        let file = write(&dressed, &colours, str::to_owned);
        assert_eq!(file.names.values().collect::<Vec<_>>(), ["a_b", "a_b", "a_b-2", "cloth"]);
        assert_eq!(file.text.matches("newmtl").count(), 3);
        assert!(
            file.text.contains("Kd 0.1000 0.5000 0.5000") && file.text.contains("Pr 0.750"),
            "{}",
            file.text
        );
    }

    #[test]
    fn trims_have_materials_of_their_own_after_those_of_cloth() {
        let (pattern, garment, state, trims) = trimmed_squares();
        let dressed = Dressed { garment: &garment, state: &state, pattern: &pattern, trims: &trims };
        let mut colours = Colours::default();
        let cloth = ClothMaterial { name: "Button".to_owned(), ..colours.of(PieceId(0)) };
        colours.pieces = pattern.pieces.keys().map(|&id| (id, cloth.clone())).collect();
        let file = write(&dressed, &colours, str::to_owned);
        assert_eq!(file.trims, ["Piping", "Button-2", "Button_thread", "Buttonhole", "Stitches"]);
        let made: Vec<&str> = file.text.lines().filter_map(|line| line.strip_prefix("newmtl ")).collect();
        assert_eq!(made[0], "Button", "the cloth's");
        assert_eq!(made[1..], file.trims.iter().map(String::as_str).collect::<Vec<_>>());
        assert!(file.text.contains("newmtl Piping\nKd 0.5776 0.0000 0.0000\n"), "{}", file.text);
    }
}
