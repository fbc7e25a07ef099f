//! Pictures without a window.

use std::path::Path;

use std::time::Duration;

use glam::UVec2;

use super::fine::{FinePicture, Fineness};
use super::{Camera, Gpu, Look, OffscreenTarget, Quality, RenderError, Renderer, Scene, View};

/// A device and renderer for pictures without a window; make one and use it for many pictures.
#[derive(Debug)]
pub struct Studio {
    gpu: Gpu,
    renderer: Renderer,
    target: Option<OffscreenTarget>,
}

impl Studio {
    /// Opens the best graphics adapter available.
    pub fn new() -> Result<Self, RenderError> {
        let gpu = Gpu::headless()?;
        let renderer = Renderer::new(&gpu)?;
        Ok(Self { gpu, renderer, target: None })
    }

    /// Sets the time after which a picture counts as failed.
    pub fn set_patience(&mut self, patience: Duration) {
        self.gpu.patience = patience;
    }

    /// Name and backend of the adapter, for people.
    pub fn adapter_name(&self) -> &str {
        &self.gpu.adapter_name
    }

    /// Draws `scene` from `camera`; RGBA, rows from the top. `size` in pixels.
    pub fn draw(
        &mut self,
        scene: &Scene,
        camera: &Camera,
        look: &Look,
        size: UVec2,
    ) -> Result<image::RgbaImage, RenderError> {
        let target = match self.target.take().filter(|t| t.size == size) {
            Some(target) => target,
            None => OffscreenTarget::new(&self.gpu, size, Quality::Finished)?,
        };
        self.renderer.draw(&self.gpu, scene, camera, look, &target)?;
        let picture = target.read(&self.gpu);
        self.target = Some(target);
        picture
    }

    /// Draws the whole of `scene` from `view`.
    pub fn picture(
        &mut self,
        scene: &Scene,
        view: View,
        look: &Look,
        size: UVec2,
    ) -> Result<image::RgbaImage, RenderError> {
        self.draw(scene, &framed(scene, view, size), look, size)
    }

    /// Plans a picture that is drawn finer than its pixels; [`Studio::go_on`] draws it.
    pub fn fine(
        &self,
        scene: Scene,
        camera: Camera,
        look: &Look,
        size: UVec2,
        fineness: Fineness,
    ) -> Result<FinePicture, RenderError> {
        FinePicture::new(&self.gpu, scene, camera, look, size, fineness)
    }

    /// Draws the next tile of `picture`.
    pub fn go_on(&mut self, picture: &mut FinePicture) -> Result<(), RenderError> {
        picture.draw_next(&self.gpu, &mut self.renderer)
    }
}

/// A camera that shows the whole of `scene` from `view` in a picture of `size` pixels.
pub fn framed(scene: &Scene, view: View, size: UVec2) -> Camera {
    let mut camera = Camera::default();
    camera.look(view);
    camera.frame_points(&scene.points(), size.x.max(1) as f32 / size.y.max(1) as f32);
    camera
}

/// Draws the whole of `scene` from `view`, on a device opened for this one picture. For several pictures use [`Studio`].
pub fn picture(scene: &Scene, view: View, look: &Look, size: UVec2) -> Result<image::RgbaImage, RenderError> {
    Studio::new()?.picture(scene, view, look, size)
}

/// Encodes `picture` as PNG bytes.
pub fn png(picture: &image::RgbaImage) -> Result<Vec<u8>, RenderError> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, image::ImageFormat::Png)?;
    Ok(bytes.into_inner())
}

/// Writes `picture` as a PNG file.
pub fn save_png(picture: &image::RgbaImage, path: &Path) -> Result<(), RenderError> {
    Ok(picture.save_with_format(path, image::ImageFormat::Png)?)
}
