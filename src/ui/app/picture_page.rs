//! The dialog with options of a picture of the body, and the rendering of the picture.

use std::path::Path;

use egui::{ComboBox, Id, Modal};
use glam::UVec2;

use crate::render::{Camera, FinePicture, Fineness, Legend, Look, Projection, View, png};
use crate::ui::actions::{Action, VIEWS};
use crate::ui::app::App;
use crate::ui::files::{self, Purpose};
use crate::ui::language::fields::drag_value;
use crate::ui::language::pictures::no_picture;
use crate::ui::language::{say, tr};
use crate::ui::list::list_ui;
use crate::ui::look::theme::{self, Palette};
use crate::ui::scenery::portrait::{Extras, portrait};

/// Accepted side of a picture, pixels.
const SIDES: std::ops::RangeInclusive<u32> = 16..=16384;

/// Options of a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PictureOptions {
    /// Size, pixels.
    pub size: UVec2,
    /// The view, which shows everything; None: the present view of the body pane.
    pub view: Option<View>,
    /// Leave out background and floor.
    pub cut_out: bool,
    /// Draw marks.
    pub marks: bool,
    /// Drawn pixels along each side of a pixel, 1..=8.
    pub times: u32,
    /// Number of pictures in a full turn; 1 is a single picture.
    pub count: u32,
}

impl Default for PictureOptions {
    fn default() -> Self {
        Self { size: UVec2::new(1920, 1200), view: None, cut_out: false, marks: false, times: 1, count: 1 }
    }
}

/// A picture that is being drawn.
#[derive(Debug)]
pub struct PlannedPicture {
    /// The drawing so far.
    pub drawing: FinePicture,
    /// The legend of the map that it shows.
    legend: Option<Legend>,
}

/// The open dialog.
#[derive(Debug)]
pub struct PicturePage {
    options: PictureOptions,
}

/// The user's answer to the dialog.
enum Answer {
    None,
    Cancel,
    Write,
}

impl PicturePage {
    /// The dialog with the size of the pane, in pixels.
    pub fn new(pane: egui::Vec2) -> Self {
        let size = UVec2::new(pane.x.round().max(16.0) as u32, pane.y.round().max(16.0) as u32);
        Self { options: PictureOptions { size, ..PictureOptions::default() } }
    }

    fn ui(&mut self, ctx: &egui::Context, palette: &Palette) -> Answer {
        let options = &mut self.options;
        let shown = Modal::new(Id::unique("picture")).show(ctx, |ui| {
            ui.set_width(360.0);
            ui.heading(tr("Save a picture"));
            ui.add_space(6.0);
            egui::Grid::new("picture").num_columns(2).spacing([18.0, 8.0]).show(ui, |ui| {
                let label = ui.label(tr("Size"));
                ui.horizontal(|ui| {
                    let sides = [(&mut options.size.x, tr("Width")), (&mut options.size.y, tr("Height"))];
                    for (side, name) in sides {
                        let value = drag_value(side).range(SIDES).suffix(" px");
                        let field = ui.add(value).labelled_by(label.id);
                        field.widget_info(|| {
                            egui::WidgetInfo::labeled(egui::accesskit::Role::SpinButton, true, name)
                        });
                    }
                    sizes_ui(ui, &mut options.size);
                });
                ui.end_row();
                let label = ui.label(tr("Seen"));
                let words = |view: Option<View>| match view {
                    None => tr("as now"),
                    Some(view) => tr(Action::Look(view).row().text),
                };
                let combo = ComboBox::from_id_salt("side").selected_text(words(options.view));
                let shown = list_ui(ui, combo, |entries| {
                    for view in std::iter::once(None).chain(VIEWS.into_iter().map(Some)) {
                        entries.add_value(&mut options.view, view, words(view));
                    }
                });
                shown.labelled_by(label.id);
                ui.end_row();
                ui.label(tr("Background"));
                ui.checkbox(&mut options.cut_out, tr("none: transparent, without floor"));
                ui.end_row();
                ui.label(tr("Marks"));
                ui.checkbox(&mut options.marks, tr("with marks and pins"));
                ui.end_row();
                smoothness_ui(ui, &mut options.times);
                ui.end_row();
                let label = ui.label(tr("A full turn"));
                ui.horizontal(|ui| {
                    let value = drag_value(&mut options.count).range(1..=360);
                    ui.add(value).labelled_by(label.id);
                    ui.label(if options.count == 1 { tr("picture") } else { tr("pictures, numbered") });
                });
                ui.end_row();
            });
            ui.add_space(10.0);
            ui.horizontal(|ui| {
                let text = egui::RichText::new(tr("Choose a file…")).color(palette.on_accent);
                if ui.add(egui::Button::new(text).fill(palette.accent)).clicked() {
                    Answer::Write
                } else if ui.button(tr("Cancel")).clicked() {
                    Answer::Cancel
                } else {
                    Answer::None
                }
            })
            .inner
        });
        if shown.should_close() { Answer::Cancel } else { shown.inner }
    }
}

/// The list of how often each pixel is drawn.
fn smoothness_ui(ui: &mut egui::Ui, times: &mut u32) {
    let words = |times: u32| match times {
        1 => tr("usual").to_owned(),
        _ => say!("{times} × {times} samples for each pixel", times),
    };
    let label = ui.label(tr("Smoothness"));
    let combo = ComboBox::from_id_salt("times").selected_text(words(*times));
    let shown = list_ui(ui, combo, |entries| {
        for choice in [1, 2, 4, Fineness::MOST_TIMES] {
            entries.add_value(times, choice, words(choice));
        }
    });
    shown.labelled_by(label.id).on_hover_text(tr("Smoother edges and threads, drawn more slowly"));
}

/// Buttons for common sizes.
fn sizes_ui(ui: &mut egui::Ui, size: &mut UVec2) {
    ui.menu_button("…", |ui| {
        for (width, height) in
            [(1280, 720), (1920, 1080), (3840, 2160), (2048, 2048), (1080, 1350), (2480, 3508)]
        {
            if ui.button(format!("{width} × {height}")).clicked() {
                *size = UVec2::new(width, height);
                ui.close();
            }
        }
    })
    .response
    .on_hover_text(tr("Sizes that are often wanted"));
}

impl App {
    pub(in crate::ui) fn picture_ui(&mut self, ctx: &egui::Context, palette: &Palette) {
        let Some(mut page) = self.shell.picture.take() else { return };
        match page.ui(ctx, palette) {
            Answer::None => self.shell.picture = Some(page),
            Answer::Cancel => {}
            Answer::Write => {
                self.picture_options = page.options;
                self.ask_file(if page.options.count > 1 { Purpose::Turn } else { Purpose::Picture });
            }
        }
    }

    /// Renders a picture by the options chosen last and writes it; a fine one is begun, and goes on in the next frames. The error
    /// is a message.
    pub(in crate::ui) fn write_picture(&mut self, path: &Path) -> Result<(), String> {
        let options = self.picture_options;
        if options.times > 1 {
            self.begin_pictures(path);
            return Ok(());
        }
        let camera = self.camera_of_picture(&options);
        let bytes = self.photograph(&options, &camera)?;
        files::write(path, &bytes)?;
        self.wrote(path);
        Ok(())
    }

    /// The camera for a picture with `options`.
    pub(in crate::ui) fn camera_of_picture(&mut self, options: &PictureOptions) -> Camera {
        let mut camera = self.scene_pane.camera;
        if let Some(view) = options.view {
            let session = self.demo.as_ref().map_or(&self.session, |(player, ..)| player.session());
            let extras = Extras {
                marks: options.marks,
                pins: options.marks,
                map: None,
                body_look: self.shell.sight.body_look,
                plain_seams: self.shell.sight.plain_seams,
            };
            let scene = portrait(&mut self.scenery, session, extras);
            camera = Camera { projection: camera.projection, ..Camera::default() };
            camera.look(view);
            camera.frame_points(&scene.points(), options.size.x as f32 / options.size.y as f32);
        } else if let Some(pane) = self.scene_pane.area {
            camera = widened(camera, pane.width() / pane.height().max(1.0), options.size);
        }
        camera
    }

    /// Renders a picture as PNG. The error is a message.
    pub(in crate::ui) fn photograph(
        &mut self,
        options: &PictureOptions,
        camera: &Camera,
    ) -> Result<Vec<u8>, String> {
        let mut picture = self.plan_picture(options, camera)?;
        while !picture.drawing.is_done() {
            self.draw_more(&mut picture)?;
        }
        picture.developed()
    }

    /// Plans a picture with `options`. The error is a message.
    pub(in crate::ui) fn plan_picture(
        &mut self,
        options: &PictureOptions,
        camera: &Camera,
    ) -> Result<PlannedPicture, String> {
        let session = self.demo.as_ref().map_or(&self.session, |(player, ..)| player.session());
        let map = self.shell.maps.shown();
        let extras = Extras {
            marks: options.marks,
            pins: options.marks,
            map: map.map(|map| &map.colours),
            body_look: self.shell.sight.body_look,
            plain_seams: self.shell.sight.plain_seams,
        };
        let scene = portrait(&mut self.scenery, session, extras);
        let graphics = self.scene_pane.graphics.as_ref().ok_or_else(no_adapter)?;
        // Lines keep their width relative to the picture, as in the pane.
        let points = self.scene_pane.area.map_or(options.size.y as f32, |pane| pane.height());
        let look = Look {
            pixels_per_point: options.size.y as f32 / points.max(1.0),
            cut_out: options.cut_out,
            ..self.shell.sight.on(theme::look(self.scheme)).focused(camera, &scene)
        };
        let fineness = Fineness::new(options.times);
        let drawing = graphics.fine(scene, *camera, &look, options.size, fineness);
        let drawing = drawing.map_err(|why| no_picture(&why))?;
        Ok(PlannedPicture { drawing, legend: map.map(|map| map.legend()) })
    }

    /// Draws the next tile of `picture`. The error is a message.
    pub(in crate::ui) fn draw_more(&mut self, picture: &mut PlannedPicture) -> Result<(), String> {
        let graphics = self.scene_pane.graphics.as_mut().ok_or_else(no_adapter)?;
        graphics.go_on(&mut picture.drawing).map_err(|why| no_picture(&why))
    }
}

impl PlannedPicture {
    /// The picture, drawn, as PNG with its legend. The error is a message.
    pub fn developed(self) -> Result<Vec<u8>, String> {
        let mut picture = self.drawing.finish();
        if let Some(legend) = self.legend {
            legend.burn(&mut picture);
        }
        png(&picture).map_err(|why| no_picture(&why))
    }
}

fn no_adapter() -> String {
    tr("There is no graphics adapter to draw with").to_owned()
}

/// The camera that shows in a picture of `size` all that `camera` shows at the width-to-height ratio `aspect`.
fn widened(camera: Camera, aspect: f32, size: UVec2) -> Camera {
    let other = size.x as f32 / size.y.max(1) as f32;
    let factor = (aspect / other).max(1.0);
    match camera.projection {
        // A larger field of view from the same eye keeps the perspective and what hides what.
        Projection::Perspective => {
            Camera { fov_y: 2.0 * ((camera.fov_y / 2.0).tan() * factor).atan(), ..camera }
        }
        Projection::Orthographic => Camera { distance: camera.distance * factor, ..camera },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec2, Vec3};

    #[test]
    fn what_is_seen_in_the_pane_is_in_the_picture() {
        let pane = Vec2::new(800.0, 400.0);
        for projection in [Projection::Perspective, Projection::Orthographic] {
            let camera = Camera { projection, ..Camera::default() };
            for size in [UVec2::new(400, 900), UVec2::new(1600, 200), UVec2::new(500, 500)] {
                let wide = widened(camera, 2.0, size);
                for pixel in [Vec2::ZERO, pane, Vec2::new(pane.x, 0.0), pane / 3.0] {
                    let place: Vec3 = camera.point_on_pivot_plane(pixel, pane);
                    let p = wide.project(place, size.as_vec2()).expect("in front").pixel;
                    assert!(p.cmpge(Vec2::splat(-0.1)).all() && p.cmple(size.as_vec2() + 0.1).all(), "{p}");
                }
            }
        }
    }
}
