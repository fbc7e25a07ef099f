//! Rendering: plain buffers in, pixels out. It has cameras, meshes and lines, and no notion of cloth or bodies.
//!
//! A picture takes up to six passes: shadow map; depth and normals at half size; ambient occlusion ("hollows") and its blur; then
//! background, floor, meshes, wires and lines with light, at four samples per pixel. With a lens five more blur what is out of focus
//! (`lens_blur`). Finer pictures are drawn larger, tile by tile, and averaged (`fine`).

pub mod alpha;
pub mod bake;
mod buffers;
pub mod camera;
pub mod decal;
pub mod environment;
pub mod error;
pub mod fine;
mod frame;
pub mod gpu;
pub mod harmonics;
pub mod image_light;
pub mod legend;
pub mod lens;
mod lens_blur;
mod letters;
pub mod light;
pub mod look;
pub mod palette;
mod part;
mod pass;
pub mod picture;
mod picture_array;
mod pipelines;
mod pyramid;
pub mod renderer;
pub mod scene;
mod shaders;
mod srgb;
mod strokes;
pub mod target;
pub mod textile;
pub mod view;
mod wgsl;

pub use alpha::straightened;
pub use camera::{Camera, PixelRay, Projected, Projection};
pub use decal::Decal;
pub use environment::MEAN_LIGHT;
pub use error::RenderError;
pub use fine::{FinePicture, Fineness};
pub use gpu::Gpu;
pub use image_light::ImageLight;
pub use legend::Legend;
pub use lens::{Defocus, Lens};
pub use light::Light;
pub use look::{BODY, CLOTH_BACK, CLOTH_FRONT, Look, cloth_front, mark_colour};
pub use palette::Palette;
pub use picture::{Studio, framed, picture, png, save_png};
pub use renderer::Renderer;
pub use scene::{Ground, Label, Mesh, Polyline, Rgb, Scene};
pub use srgb::linear;
pub use target::{OffscreenTarget, Quality};
pub use textile::Textile;
pub use view::View;
