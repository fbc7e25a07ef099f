//! Thumbnails of samples and projects, made by a separate thread so that the window never waits for them.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};

use egui::{ColorImage, TextureHandle, TextureOptions};
use glam::UVec2;

use crate::render::{Look, Studio, View, straightened};
use crate::session::samples::Sample;
use crate::session::{Project, Session, project_file};
use crate::sim::{Runner, Simulation};
use crate::ui::scenery::portrait::{Extras, portrait};
use crate::ui::scenery::scene::Scenery;

/// Size of a thumbnail, pixels.
pub const SIZE: UVec2 = UVec2::new(320, 400);

/// Pictures of the samples as they are dressed, in the order of [`Sample::ALL`].
const SAMPLES: [&[u8]; Sample::ALL.len()] = [
    include_bytes!("../../../assets/samples/tshirt.png"),
    include_bytes!("../../../assets/samples/skirt.png"),
    include_bytes!("../../../assets/samples/dress.png"),
    include_bytes!("../../../assets/samples/trousers.png"),
    include_bytes!("../../../assets/samples/scarf.png"),
    include_bytes!("../../../assets/samples/blouse.png"),
    include_bytes!("../../../assets/samples/hoodie.png"),
    include_bytes!("../../../assets/samples/raglan.png"),
    include_bytes!("../../../assets/samples/kimono.png"),
    include_bytes!("../../../assets/samples/tunic.png"),
    include_bytes!("../../../assets/samples/gown.png"),
    include_bytes!("../../../assets/samples/jumpsuit.png"),
    include_bytes!("../../../assets/samples/leggings.png"),
    include_bytes!("../../../assets/samples/shorts.png"),
    include_bytes!("../../../assets/samples/circle-skirt.png"),
    include_bytes!("../../../assets/samples/gathered-skirt.png"),
    include_bytes!("../../../assets/samples/tiered-skirt.png"),
    include_bytes!("../../../assets/samples/child-dress.png"),
    include_bytes!("../../../assets/samples/dungarees.png"),
    include_bytes!("../../../assets/samples/coat.png"),
    include_bytes!("../../../assets/samples/shirt.png"),
    include_bytes!("../../../assets/samples/camp-shirt.png"),
    include_bytes!("../../../assets/samples/turn-ups.png"),
    include_bytes!("../../../assets/samples/pleated-skirt.png"),
    include_bytes!("../../../assets/samples/bow-skirt.png"),
    include_bytes!("../../../assets/samples/cape.png"),
    include_bytes!("../../../assets/samples/creature-cloak.png"),
];

/// The subject of a thumbnail.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Subject {
    /// A dressed sample.
    Sample(Sample),
    /// A project file, as it is.
    Project(PathBuf),
}

/// Thumbnails, and the thread that makes them.
#[derive(Default)]
pub struct Thumbnails {
    /// Whether any are made.
    on: bool,
    /// None: requested, or it could not be made.
    pictures: BTreeMap<Subject, Option<TextureHandle>>,
    worker: Option<Worker>,
}

struct Worker {
    wanted: Sender<Subject>,
    made: Receiver<(Subject, ColorImage)>,
    stop: Arc<AtomicBool>,
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
    }
}

impl std::fmt::Debug for Thumbnails {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Thumbnails({} asked for)", self.pictures.len())
    }
}

impl Thumbnails {
    /// Begins to make thumbnails. Before this none are made.
    pub fn on() -> Self {
        Self { on: true, ..Self::default() }
    }

    /// The thumbnail of `subject`, if it is ready; it is requested the first time.
    pub fn get(&mut self, ctx: &egui::Context, subject: &Subject) -> Option<&TextureHandle> {
        if self.on && !self.pictures.contains_key(subject) {
            let worker = self.worker.get_or_insert_with(|| Worker::start(ctx.clone()));
            worker.wanted.send(subject.clone()).ok();
            self.pictures.insert(subject.clone(), None);
        }
        self.pictures.get(subject)?.as_ref()
    }

    /// Takes the thumbnails made since the last frame.
    pub fn take(&mut self, ctx: &egui::Context) {
        let Some(worker) = &self.worker else { return };
        for (subject, image) in worker.made.try_iter() {
            let texture = ctx.load_texture("thumbnail", image, TextureOptions::LINEAR);
            self.pictures.insert(subject, Some(texture));
        }
    }

    /// Forgets all thumbnails, since their textures belong to a window that was closed.
    pub fn begin_anew(&mut self) {
        (self.worker, self.pictures) = (None, BTreeMap::new());
    }

    /// Stops making thumbnails, since the processor is needed for other work. Missing ones are requested again later.
    pub fn rest(&mut self) {
        if self.worker.take().is_some() {
            self.pictures.retain(|_, picture| picture.is_some());
        }
    }
}

impl Worker {
    /// Starts the thread. If no thread can be started there are no thumbnails.
    fn start(ctx: egui::Context) -> Self {
        let (wanted, subjects) = channel::<Subject>();
        let (send, made) = channel();
        let stop = Arc::new(AtomicBool::new(false));
        let stopped = Arc::clone(&stop);
        let work = move || {
            let mut artist = None;
            for subject in subjects {
                if stopped.load(Ordering::Relaxed) {
                    return;
                }
                if let Some(image) = image(&subject, &mut artist) {
                    let size = [image.width() as usize, image.height() as usize];
                    let image = ColorImage::from_rgba_unmultiplied(size, image.as_raw());
                    if send.send((subject, image)).is_err() {
                        return;
                    }
                    ctx.request_repaint();
                }
            }
        };
        std::thread::Builder::new().name("thumbnails".to_owned()).spawn(work).ok();
        Self { wanted, made, stop }
    }
}

/// The thumbnail of `subject`; None where it cannot be read or drawn.
fn image(subject: &Subject, artist: &mut Option<Studio>) -> Option<image::RgbaImage> {
    match subject {
        Subject::Project(path) => {
            let project = project_file::open(path).ok()?;
            draw(&mut session(project), artist)
        }
        Subject::Sample(sample) => {
            let number = Sample::ALL.iter().position(|other| other == sample)?;
            image::load_from_memory(SAMPLES[number]).ok().map(|picture| picture.to_rgba8())
        }
    }
}

fn session(project: Project) -> Session {
    let mut session = Session::new(project, Runner::inline(Simulation::default()));
    session.update();
    session
}

fn draw(session: &mut Session, artist: &mut Option<Studio>) -> Option<image::RgbaImage> {
    let studio = match artist {
        Some(studio) => studio,
        None => artist.insert(Studio::new().ok()?),
    };
    let scene = portrait(&mut Scenery::default(), session, Extras::default());
    let look = Look { cut_out: true, ..Look::light() };
    Some(straightened(studio.picture(&scene, View::ThreeQuarter, &look, SIZE).ok()?))
}
