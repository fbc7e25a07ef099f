//! Our own picture of the scene, kept as a texture that egui shows.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use egui::TextureId;
use glam::UVec2;

use crate::body::Surface;
use crate::cloth::ClothState;
use crate::contact::Bone;
use crate::geometry::ids::{MarkId, PieceId};
use crate::pattern::activity::Activity;
use crate::render::{
    Camera, Gpu, Look, Mesh, OffscreenTarget, Quality, RenderError, Renderer, Rgb, Scene, straightened,
};
use crate::sim::ClothPlace;
use crate::ui::scenery::scene::PinLook;
use crate::ui::selection::Item;
use crate::wrap::Marks;

/// What a picture depends on: with the same key nothing is drawn again.
#[derive(Clone, Debug, Default)]
pub struct Key {
    /// From where.
    pub camera: Camera,
    /// How.
    pub look: Look,
    /// Pixels.
    pub size: UVec2,
    /// With how much work.
    pub quality: Quality,
    /// Of what.
    pub body: Option<Arc<Surface>>,
    /// With which cloth.
    pub cloth: Option<Arc<ClothState>>,
    /// With which marks.
    pub marks: Option<Arc<Marks>>,
    /// Points of the stroke under way.
    pub stroke: usize,
    /// The mark under the pointer.
    pub near: Option<MarkId>,
    /// With which pins.
    pub pinned: Option<Arc<Vec<Option<u32>>>>,
    /// How those are drawn.
    pub pins: Vec<PinLook>,
    /// With which bones.
    pub bones: Vec<Bone>,
    /// With which pieces not active.
    pub activities: BTreeMap<PieceId, Activity>,
    /// With which drag.
    pub dragged: Option<Arc<Vec<f32>>>,
    /// In the colours of which map.
    pub map: Option<Arc<Vec<Rgb>>>,
    /// With which other garment.
    pub beside: Option<Arc<Vec<Arc<Mesh>>>>,
    /// The mark that stands out.
    pub selected: Option<MarkId>,
    /// With which proposed marks.
    pub ghosts: Option<Arc<Marks>>,
    /// With which edges and seams standing out.
    pub stand_out: Vec<Item>,
    /// With a ring round which place.
    pub spot: Option<ClothPlace>,
}

impl PartialEq for Key {
    fn eq(&self, other: &Self) -> bool {
        let Self {
            camera,
            look,
            size,
            quality,
            body,
            cloth,
            marks,
            stroke,
            near,
            selected,
            ghosts,
            pinned,
            pins,
            bones,
            activities,
            dragged,
            map,
            beside,
            stand_out,
            spot,
        } = self;
        *camera == other.camera
            && *look == other.look
            && *size == other.size
            && *quality == other.quality
            && *stroke == other.stroke
            && *pins == other.pins
            && *bones == other.bones
            && *activities == other.activities
            && *stand_out == other.stand_out
            && *spot == other.spot
            && *near == other.near
            && *selected == other.selected
            && same(body, &other.body)
            && same(cloth, &other.cloth)
            && same(marks, &other.marks)
            && same(pinned, &other.pinned)
            && same(dragged, &other.dragged)
            && same(map, &other.map)
            && same(beside, &other.beside)
            && same(ghosts, &other.ghosts)
    }
}

fn same<T>(a: &Option<Arc<T>>, b: &Option<Arc<T>>) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => Arc::ptr_eq(a, b),
        (None, None) => true,
        _ => false,
    }
}

/// The renderer, on the window's device.
pub struct Graphics {
    state: egui_wgpu::RenderState,
    gpu: Gpu,
    renderer: Renderer,
    target: Option<(OffscreenTarget, TextureId)>,
    drawn: Option<Key>,
    /// Pictures drawn so far.
    pub pictures: u64,
    /// Why the device is gone.
    lost: Arc<Mutex<Option<String>>>,
}

impl std::fmt::Debug for Graphics {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Graphics({}, {} pictures)", self.gpu.adapter_name, self.pictures)
    }
}

impl Graphics {
    /// On the device that egui draws with.
    pub fn new(state: egui_wgpu::RenderState) -> Self {
        let gpu = Gpu::from_parts(&state.adapter, state.device.clone(), state.queue.clone());
        let renderer = Renderer::new(&gpu);
        let lost = Arc::new(Mutex::new(None));
        let told = Arc::clone(&lost);
        state.device.on_uncaptured_error(Arc::new(|e| tracing::error!("graphics: {e}")));
        state.device.set_device_lost_callback(move |reason, words| {
            *told.lock().unwrap_or_else(PoisonError::into_inner) = Some(format!("{reason:?}: {words}"));
        });
        Self { state, gpu, renderer, target: None, drawn: None, pictures: 0, lost }
    }

    /// Why nothing can be drawn any more; None while the device is there.
    pub fn lost(&self) -> Option<String> {
        self.lost.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// What draws, for people.
    pub fn adapter_name(&self) -> &str {
        &self.gpu.adapter_name
    }

    /// A processor does the drawing.
    pub fn is_slow(&self) -> bool {
        self.gpu.software
    }

    /// The picture for `key`, drawn only when it differs from the last one. `scene` makes what is to be drawn.
    pub fn picture(&mut self, key: Key, scene: impl FnOnce() -> Scene) -> Result<TextureId, RenderError> {
        // A device that is gone says so only when it is asked.
        self.state.device.poll(wgpu::PollType::Poll).ok();
        if let Some(why) = self.lost() {
            return Err(RenderError::Device(why));
        }
        let texture = self.target_of(key.size, key.quality)?;
        if self.drawn.as_ref() != Some(&key)
            && let Some((target, _)) = &self.target
        {
            self.renderer.draw(&self.gpu, &scene(), &key.camera, &key.look, target)?;
            self.pictures += 1;
            self.drawn = Some(key);
        }
        Ok(texture)
    }

    /// A picture of its own, of `size` pixels; what is shown stays as it is. Waits for the device.
    pub fn photograph(
        &mut self,
        scene: &Scene,
        camera: &Camera,
        look: &Look,
        size: UVec2,
    ) -> Result<image::RgbaImage, RenderError> {
        let target = OffscreenTarget::new(&self.gpu, size, Quality::Finished)?;
        self.renderer.draw(&self.gpu, scene, camera, look, &target)?;
        let picture = target.read(&self.gpu)?;
        Ok(if look.cut_out { straightened(picture) } else { picture })
    }

    fn target_of(&mut self, size: UVec2, quality: Quality) -> Result<TextureId, RenderError> {
        let size = size.min(UVec2::splat(self.gpu.max_side()));
        if let Some((target, texture)) = &self.target
            && (target.size, target.quality) == (size, quality)
        {
            return Ok(*texture);
        }
        self.drawn = None;
        let target = OffscreenTarget::new(&self.gpu, size, quality)?;
        let mut egui = self.state.renderer.write();
        let filter = wgpu::FilterMode::Linear;
        let texture = match self.target.take() {
            Some((_, texture)) => {
                egui.update_egui_texture_from_wgpu_texture(
                    &self.state.device,
                    &target.picture_view,
                    filter,
                    texture,
                );
                texture
            }
            None => egui.register_native_texture(&self.state.device, &target.picture_view, filter),
        };
        drop(egui);
        self.target = Some((target, texture));
        Ok(texture)
    }
}
