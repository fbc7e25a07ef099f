//! The shaders, each assembled from its own file and the headers it needs.

/// A shader and its name.
#[derive(Clone, Debug)]
pub(super) struct Shader {
    /// Name of the file in shaders/.
    pub(super) name: &'static str,
    /// The WGSL text: headers, then the shader's own file.
    pub(super) text: String,
}

const FRAME: &str = include_str!("../../shaders/frame.wgsl");
const LIGHT: &str = include_str!("../../shaders/light.wgsl");
const MATERIAL: &str = include_str!("../../shaders/material.wgsl");
const TEXTILE: &str = include_str!("../../shaders/textile.wgsl");
const FLOOR: &str = include_str!("../../shaders/floor.wgsl");
const LENS: &str = include_str!("../../shaders/lens.wgsl");
const LENS_DEPTH: &str = include_str!("../../shaders/lens_depth.wgsl");
const LENS_DEPTHS: &str = include_str!("../../shaders/lens_depths.wgsl");

fn shader(name: &'static str, headers: &[&str], own: &str) -> Shader {
    Shader { name, text: format!("{}\n{own}", headers.join("\n")) }
}

pub(super) fn background() -> Shader {
    shader("background.wgsl", &[FRAME], include_str!("../../shaders/background.wgsl"))
}

pub(super) fn ground() -> Shader {
    shader("ground.wgsl", &[FRAME, LIGHT, FLOOR], include_str!("../../shaders/ground.wgsl"))
}

pub(super) fn mesh() -> Shader {
    shader("mesh.wgsl", &[FRAME, LIGHT, MATERIAL, TEXTILE], include_str!("../../shaders/mesh.wgsl"))
}

pub(super) fn draft() -> Shader {
    shader("draft.wgsl", &[FRAME, MATERIAL], include_str!("../../shaders/draft.wgsl"))
}

pub(super) fn draft_ground() -> Shader {
    shader("draft_ground.wgsl", &[FRAME, FLOOR], include_str!("../../shaders/draft_ground.wgsl"))
}

pub(super) fn line() -> Shader {
    shader("line.wgsl", &[FRAME], include_str!("../../shaders/line.wgsl"))
}

pub(super) fn wire() -> Shader {
    shader("wire.wgsl", &[FRAME], include_str!("../../shaders/wire.wgsl"))
}

pub(super) fn depth() -> Shader {
    shader("depth.wgsl", &[FRAME], include_str!("../../shaders/depth.wgsl"))
}

pub(super) fn hollows() -> Shader {
    shader("hollows.wgsl", &[FRAME], include_str!("../../shaders/hollows.wgsl"))
}

pub(super) fn blur() -> Shader {
    shader("blur.wgsl", &[FRAME], include_str!("../../shaders/blur.wgsl"))
}

/// Depth and circles of confusion, from depths with several samples for each pixel or with one.
pub(super) fn focus(is_multisampled: bool) -> Shader {
    let depths = if is_multisampled { LENS_DEPTHS } else { LENS_DEPTH };
    shader("focus.wgsl", &[FRAME, LENS, depths], include_str!("../../shaders/focus.wgsl"))
}

pub(super) fn reach() -> Shader {
    shader("reach.wgsl", &[FRAME, LENS], include_str!("../../shaders/reach.wgsl"))
}

pub(super) fn lens_blur() -> Shader {
    shader("lens_blur.wgsl", &[FRAME, LENS], include_str!("../../shaders/lens_blur.wgsl"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> [Shader; 14] {
        [
            background(),
            ground(),
            mesh(),
            line(),
            wire(),
            depth(),
            hollows(),
            blur(),
            draft(),
            draft_ground(),
            focus(true),
            focus(false),
            reach(),
            lens_blur(),
        ]
    }

    #[test]
    fn every_shader_is_valid() {
        for shader in all() {
            let module = naga::front::wgsl::parse_str(&shader.text)
                .unwrap_or_else(|e| panic!("{}:\n{}", shader.name, e.emit_to_string(&shader.text)));
            let mut validator = naga::valid::Validator::new(
                naga::valid::ValidationFlags::all(),
                naga::valid::Capabilities::empty(),
            );
            validator
                .validate(&module)
                .unwrap_or_else(|e| panic!("{}:\n{}", shader.name, e.emit_to_string(&shader.text)));
            assert!(!module.entry_points.is_empty(), "{}", shader.name);
        }
    }

    #[test]
    fn every_file_is_used() {
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/shaders");
        let headers = [
            "frame.wgsl",
            "light.wgsl",
            "material.wgsl",
            "textile.wgsl",
            "floor.wgsl",
            "lens.wgsl",
            "lens_depth.wgsl",
            "lens_depths.wgsl",
        ];
        let used = headers.into_iter().chain(all().map(|s| s.name));
        let used: std::collections::BTreeSet<String> = used.map(str::to_owned).collect();
        let found: std::collections::BTreeSet<String> = std::fs::read_dir(folder)
            .expect("shaders")
            .map(|f| f.expect("a file").file_name().to_string_lossy().into_owned())
            // The folder in it is another room's.
            .filter(|name| name.ends_with(".wgsl"))
            .collect();
        assert_eq!(used, found);
    }
}
