//! Thumbnails of samples and projects, made by a separate thread so that the window never waits for them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};

use egui::{ColorImage, TextureHandle, TextureOptions};
use glam::UVec2;

use crate::body::mannequin;
use crate::render::{Look, Studio, View, png, straightened};
use crate::session::samples::Sample;
use crate::session::{Command, Project, Session, project_file};
use crate::sim::{Runner, Simulation, StartChoice};
use crate::ui::files;
use crate::ui::scenery::portrait::{Extras, portrait};
use crate::ui::scenery::scene::Scenery;

/// Size of a thumbnail, pixels.
pub const SIZE: UVec2 = UVec2::new(320, 400);
/// Edge length of samples that are dressed by the best start, metres: several starts may be tried.
const COARSE: f64 = 0.03;
/// Largest number of ticks for a sample; then it is drawn even if it is not at rest.
const MOST_TICKS: usize = 4000;

/// The subject of a thumbnail.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Subject {
    /// A dressed sample, by the name of its file.
    Sample(&'static str),
    /// A project file, as it is.
    Project(PathBuf),
}

/// Thumbnails, and the thread that makes them.
#[derive(Default)]
pub struct Thumbnails {
    folder: Option<PathBuf>,
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
    /// Begins to make thumbnails; those of samples are kept in `folder`. Before this none are made.
    pub fn kept_in(folder: PathBuf) -> Self {
        Self { folder: Some(folder), ..Self::default() }
    }

    /// The thumbnail of `subject`, if it is ready; it is requested the first time.
    pub fn get(&mut self, ctx: &egui::Context, subject: &Subject) -> Option<&TextureHandle> {
        if !self.pictures.contains_key(subject)
            && let Some(folder) = &self.folder
        {
            let worker = self.worker.get_or_insert_with(|| Worker::start(folder.clone(), ctx.clone()));
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
    fn start(folder: PathBuf, ctx: egui::Context) -> Self {
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
                if let Some(image) = image(&subject, &folder, &mut artist, &stopped) {
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

/// Renders the thumbnail of `subject`; None where it cannot be read or drawn.
fn image(
    subject: &Subject,
    folder: &Path,
    artist: &mut Option<Studio>,
    stop: &AtomicBool,
) -> Option<image::RgbaImage> {
    match subject {
        Subject::Project(path) => {
            let project = project_file::open(path).ok()?;
            draw(&mut session(project), artist)
        }
        Subject::Sample(stem) => {
            let sample = Sample::ALL.into_iter().find(|s| s.file_stem() == *stem)?;
            let mut project = sample.project(&mannequin::default());
            if !Sample::MARKED.contains(&sample) {
                project.document.settings.edge_length = COARSE;
            }
            let mut session = session(project);
            // The name contains a hash, so that a changed sample gets a new thumbnail.
            let kept = folder.join(format!("{stem}-{:016x}.png", session.document_hash()));
            if let Ok(picture) = image::open(&kept) {
                return Some(picture.to_rgba8());
            }
            session.apply_alone(put_on(sample)).ok()?;
            let simulation = session.runner().simulation()?;
            for _ in 0..MOST_TICKS {
                if stop.load(Ordering::Relaxed) {
                    return None;
                }
                if !simulation.tick() {
                    break;
                }
            }
            session.update();
            let picture = draw(&mut session, artist)?;
            // If the folder cannot be made, the thumbnail is rendered again the next time.
            std::fs::create_dir_all(folder).ok();
            png(&picture).ok().and_then(|bytes| files::write(&kept, &bytes).ok());
            Some(picture)
        }
    }
}

/// The command that puts a sample on.
fn put_on(sample: Sample) -> Command {
    match Sample::MARKED.contains(&sample) {
        true => Command::Wrap,
        false => Command::Dress { choice: StartChoice::default() },
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

/// The system's cache folder for thumbnails; None where there is no home folder.
pub fn usual_folder() -> Option<PathBuf> {
    let folder = |name: &str| std::env::var_os(name).map(PathBuf::from).filter(|p| p.is_absolute());
    let base = if cfg!(windows) {
        folder("LOCALAPPDATA")
    } else if cfg!(target_os = "macos") {
        folder("HOME").map(|home| home.join("Library/Caches"))
    } else {
        folder("XDG_CACHE_HOME").or_else(|| folder("HOME").map(|home| home.join(".cache")))
    };
    base.map(|base| base.join("toile/thumbnails"))
}
