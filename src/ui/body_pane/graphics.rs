//! Renders the scene of the body pane to a texture that egui shows.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use egui::TextureId;
use glam::{DVec2, UVec2};

use crate::body::Surface;
use crate::cloth::ClothState;
use crate::contact::Bone;
use crate::geometry::ids::{MarkId, PieceId};
use crate::pattern::Pattern;
use crate::pattern::activity::Activity;
use crate::pattern::stitches::is_trimmed_alike;
use crate::render::{
    Camera, FinePicture, Fineness, Gpu, Look, Mesh, OffscreenTarget, Quality, RenderError, Renderer, Rgb,
    Scene, straightened,
};
use crate::ui::scenery::body_look::BodyLook;
use crate::ui::scenery::fabric_looks::PieceLooks;
use crate::ui::scenery::scene::PinLook;
use crate::wrap::Marks;

/// Everything that the picture depends on: with an equal key nothing is rendered again.
#[derive(Clone, Debug, Default)]
pub struct Key {
    /// The camera.
    pub camera: Camera,
    /// Colours, light and display options.
    pub look: Look,
    /// Size, pixels.
    pub size: UVec2,
    /// Rendering quality.
    pub quality: Quality,
    /// The body.
    pub body: Option<Arc<Surface>>,
    /// How it is shown.
    pub body_look: BodyLook,
    /// Whether seams are lines alone, without stitches.
    pub plain_seams: bool,
    /// The cloth.
    pub cloth: Option<Arc<ClothState>>,
    /// The marks of the document.
    pub marks: Option<Arc<Marks>>,
    /// Number of points of the stroke in progress.
    pub stroke: usize,
    /// The mark under the pointer.
    pub near: Option<MarkId>,
    /// Vertices under the pins.
    pub pinned: Option<Arc<Vec<Option<u32>>>>,
    /// Looks of the pins.
    pub pins: Vec<PinLook>,
    /// The bones that are drawn.
    pub bones: Vec<Bone>,
    /// The pattern, for its stitches, zips and buttons.
    pub pattern: Arc<Pattern>,
    /// Pieces that are not active.
    pub activities: BTreeMap<PieceId, Activity>,
    /// Appearance of each piece.
    pub looks: Arc<PieceLooks>,
    /// Fraction of the drag's motion that reaches each vertex.
    pub dragged: Option<Arc<Vec<f32>>>,
    /// Colours of the map.
    pub map: Option<Arc<Vec<Rgb>>>,
    /// Meshes of another garment beside.
    pub beside: Option<Arc<Vec<Arc<Mesh>>>>,
    /// The emphasised mark.
    pub selected: Option<MarkId>,
    /// Proposed marks.
    pub ghosts: Option<Arc<Marks>>,
    /// Emphasised lines of pieces and their points, each in its piece's own plane.
    pub outlines: Vec<(PieceId, Vec<DVec2>)>,
}

impl PartialEq for Key {
    fn eq(&self, other: &Self) -> bool {
        let Self {
            camera,
            look,
            size,
            quality,
            body,
            body_look,
            plain_seams,
            cloth,
            marks,
            stroke,
            near,
            selected,
            ghosts,
            pinned,
            pins,
            bones,
            pattern,
            activities,
            looks,
            dragged,
            map,
            beside,
            outlines,
        } = self;
        *camera == other.camera
            && *look == other.look
            && *size == other.size
            && *quality == other.quality
            && *body_look == other.body_look
            && *plain_seams == other.plain_seams
            && *stroke == other.stroke
            && *pins == other.pins
            && *bones == other.bones
            && *activities == other.activities
            && (Arc::ptr_eq(pattern, &other.pattern) || is_trimmed_alike(pattern, &other.pattern))
            && *looks == other.looks
            && *outlines == other.outlines
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

fn able(renderer: &mut Result<Renderer, String>) -> Result<&mut Renderer, RenderError> {
    renderer.as_mut().map_err(|why| RenderError::Device(why.clone()))
}

/// The renderer of the body pane, on egui's device.
pub struct Graphics {
    state: egui_wgpu::RenderState,
    gpu: Gpu,
    /// The renderer, or why the adapter has none.
    renderer: Result<Renderer, String>,
    target: Option<(OffscreenTarget, TextureId)>,
    drawn: Option<Key>,
    /// Number of pictures rendered.
    pub pictures: u64,
    /// Why the device is lost; None while it works.
    lost: Arc<Mutex<Option<String>>>,
}

impl std::fmt::Debug for Graphics {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Graphics({}, {} pictures)", self.gpu.adapter_name, self.pictures)
    }
}

impl Graphics {
    /// A renderer on the device that egui draws with.
    pub fn new(state: egui_wgpu::RenderState) -> Self {
        let gpu = Gpu::from_parts(&state.adapter, state.device.clone(), state.queue.clone());
        let renderer = Renderer::new(&gpu).map_err(|why| why.to_string());
        let lost = Arc::new(Mutex::new(None));
        let told = Arc::clone(&lost);
        state.device.on_uncaptured_error(Arc::new(|e| tracing::error!("graphics: {e}")));
        state.device.set_device_lost_callback(move |reason, words| {
            *told.lock().unwrap_or_else(PoisonError::into_inner) = Some(format!("{reason:?}: {words}"));
        });
        Self { state, gpu, renderer, target: None, drawn: None, pictures: 0, lost }
    }

    /// Why the device is lost; None while it works.
    pub fn lost(&self) -> Option<String> {
        self.lost.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Name of the adapter, for people.
    pub fn adapter_name(&self) -> &str {
        &self.gpu.adapter_name
    }

    /// Whether the adapter renders in software.
    pub fn is_slow(&self) -> bool {
        self.gpu.software
    }

    /// Whether the adapter can draw depth of field.
    pub fn blurs(&self) -> bool {
        self.gpu.loads_depth
    }

    /// The picture for `key`, rendered only when the key differs from the last one. `scene` builds the scene.
    pub fn picture(&mut self, key: Key, scene: impl FnOnce() -> Scene) -> Result<TextureId, RenderError> {
        // A lost device reports this only when it is polled.
        self.state.device.poll(wgpu::PollType::Poll).ok();
        if let Some(why) = self.lost() {
            return Err(RenderError::Device(why));
        }
        let texture = self.target_of(key.size, key.quality)?;
        if self.drawn.as_ref() != Some(&key)
            && let Some((target, _)) = &self.target
        {
            let scene = scene();
            // Drafts have no lens that would need a focus.
            let look = match key.quality {
                Quality::Finished => key.look.focused(&key.camera, &scene),
                Quality::Draft => key.look,
            };
            able(&mut self.renderer)?.draw(&self.gpu, &scene, &key.camera, &look, target)?;
            self.pictures += 1;
            self.drawn = Some(key);
        }
        Ok(texture)
    }

    /// Renders a separate picture of `size` pixels and waits for it; the picture in the pane is unchanged.
    pub fn photograph(
        &mut self,
        scene: &Scene,
        camera: &Camera,
        look: &Look,
        size: UVec2,
    ) -> Result<image::RgbaImage, RenderError> {
        let target = OffscreenTarget::new(&self.gpu, size, Quality::Finished)?;
        able(&mut self.renderer)?.draw(&self.gpu, scene, camera, look, &target)?;
        let picture = target.read(&self.gpu)?;
        Ok(if look.cut_out { straightened(picture) } else { picture })
    }

    /// Plans a separate picture of `size` pixels; [`Graphics::go_on`] draws it.
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

    /// Draws the next tile of `picture` and waits for it.
    pub fn go_on(&mut self, picture: &mut FinePicture) -> Result<(), RenderError> {
        picture.draw_next(&self.gpu, able(&mut self.renderer)?)
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
