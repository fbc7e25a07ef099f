//! Small steps on the card.

use std::sync::Arc;
use std::time::Duration;

use glam::{DVec3, Vec4};

use crate::card::buffers::{Buffers, FAULT_BYTES, Faults, Rooms, Sizes, slot};
use crate::card::lists;
use crate::card::pipelines::{Bound, Work};
use crate::card::scene::{Body, Cloth, FARTHEST, SceneData, Span, UNIT, in_units};
use crate::card::shares::{Shares, Spring};
use crate::card::slot::Card;

/// Most seconds between two detections of contact, and those between two look-ups of the body.
const DETECTION: f64 = 0.002;
const LOOK: f64 = 0.0004;
/// Most small steps between them.
const MOST_STEPS: (usize, usize) = (64, 8);
/// Factor on the way that is expected until the next detection.
const AHEAD: f64 = 1.2;
/// Share of the stability limit of explicit bending.
const SAFE: f64 = 0.6;
/// Factor on the number of small steps: shares differ from vertex to vertex, and the mean does not tell of the smallest.
const MARGIN: f64 = 1.15;
/// Bits of `Scene::flags`.
const BODY: u32 = 1;
const CONTACT: u32 = 2;
/// Rooms in lists at first, and most of them.
const ROOMS: Rooms = Rooms { near: 32, walls: 48, contacts: 24 };
const MOST_ROOMS: Rooms = Rooms { near: 1024, walls: 192, contacts: 96 };
/// Way of the fast part of the cloth between two detections, in mean lengths of the springs: between neighbours that fall side by
/// side lie planes that hold them up if that is more.
const WAY: f64 = 0.25;
/// Share of the vertices that are faster than that part.
const FAST: f64 = 0.05;
/// Smallest distance of two features, metres and in mean lengths of the springs, if they were not nearer: rounding turns the normal
/// of a gap g between features of length l by 6e-8 l/g, which at their ends must be less than the gap.
const FLOOR: (f64, f64) = (1e-5, 1e-3);
/// Largest reach of a vertex until the next detection, in mean lengths of the springs.
const FARTHEST_REACH: f64 = 1.5;
/// Share of the vertices whose walls or contacts found no room, above which the lists get longer.
const CROWDED: f64 = 0.001;
/// Speed beyond which something is wrong, m/s.
const FASTEST: f32 = 1000.0;
/// Time after which the card counts as lost.
const PATIENCE: Duration = Duration::from_secs(60);

/// Why the card could not make a step. Positions and velocities are those before it.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CardFault {
    /// More cloth lies in one place than the card's lists can hold.
    #[error("more cloth lies in one place than the graphics card can hold in its lists")]
    Full,
    /// Features of the cloth touch each other or the body.
    #[error("the cloth touches itself or the body")]
    Touching,
    /// The cloth is too far from where it was.
    #[error("the cloth is more than {FARTHEST} m away from where it was")]
    Far,
    /// A vertex went nowhere.
    #[error("vertex {0} (from 0) went nowhere")]
    Lost(usize),
    /// The driver failed.
    #[error("the graphics card failed: {0}")]
    Broken(String),
}

/// A cloth on a card, and perhaps a body.
#[derive(Debug)]
pub struct CardSteps {
    card: Arc<Card>,
    buffers: Buffers,
    bound: Bound,
    rooms: Rooms,
    springs: Vec<Spring>,
    shares: Shares,
    /// Springs at each vertex, in its list on the card.
    degree: Vec<i32>,
    /// Step size and inverse masses that the list of springs was made for.
    ready_for: (f64, Vec<f64>),
    limit: f64,
    thickness: Option<f64>,
    friction: Vec<f64>,
    area: Vec<f64>,
    has_body: bool,
    sizes: Sizes,
    /// Mean length of the springs, metres.
    mean_length: f64,
    /// Largest angular frequency of bending, 1/s.
    bending_rate: f64,
    origin: DVec3,
    /// Detections made.
    pub detections: u64,
}

/// Numbers of small steps: of one part of a run, between two evaluations of bending, between two look-ups of the body.
#[derive(Clone, Copy, Debug)]
struct Rhythm {
    detection: usize,
    bending: usize,
    look: usize,
}

/// What comes back from the card.
struct Moved {
    places: Vec<[i32; 4]>,
    speeds: Vec<Vec4>,
    faults: Faults,
}

impl CardSteps {
    /// Cloth at `x`, metres, and a body, on `card`.
    pub fn new(
        card: Arc<Card>,
        cloth: &Cloth<'_>,
        body: Option<&Body<'_>>,
        x: &[DVec3],
    ) -> Result<Self, CardFault> {
        let origin = body.map_or(x[0], |body| {
            let (lower, upper) = body.mesh.bounds();
            (lower + upper) / 2.0
        });
        let origin = (origin / UNIT).round() * UNIT;
        let inverse: Vec<f64> = cloth.mass.iter().map(|mass| 1.0 / mass).collect();
        let shares = Shares::new(cloth.springs, &inverse);
        let stiffest =
            |(i, row): (usize, &Vec<(u32, f64)>)| row.iter().map(|(_, q)| q.abs()).sum::<f64>() * inverse[i];
        let bending_rate = cloth.bending.iter().enumerate().map(stiffest).fold(0.0, f64::max).sqrt();
        let list = spring_list(cloth.springs, &shares, (1.0, &inverse));
        let mut buffers = Buffers::new(&card.device, (cloth, &lists::interleaved(&list)), body, x, origin);
        let rounds = cloth.triangles.len() * 3;
        let (rooms, sizes) = (ROOMS, Sizes { vertices: x.len(), triangles: cloth.triangles.len(), rounds });
        if !buffers.make_rooms(&card.device, sizes, rooms) {
            return Err(CardFault::Full);
        }
        let bound = card.pipelines.bind(&card.device, &buffers);
        if card.device.is_broken() {
            return Err(CardFault::Broken(card.name().to_owned()));
        }
        Ok(Self {
            bound,
            buffers,
            rooms,
            springs: cloth.springs.to_vec(),
            degree: list.iter().map(|springs| springs.len() as i32).collect(),
            shares,
            ready_for: (0.0, Vec::new()),
            limit: cloth.limit,
            thickness: cloth.thickness,
            friction: cloth.friction.to_vec(),
            area: cloth.area.to_vec(),
            has_body: body.is_some(),
            sizes,
            mean_length: mean(cloth.springs.iter().map(|spring| spring.length)),
            bending_rate,
            origin,
            detections: 0,
            card,
        })
    }

    /// How many times as many small steps the card needs for the same strain.
    pub fn slowness(&self) -> f64 {
        MARGIN / self.shares.mean.sqrt()
    }

    /// Makes `count` small steps of positions, metres, and velocities, m/s.
    pub fn run(
        &mut self,
        (positions, velocities): (&mut [DVec3], &mut [DVec3]),
        span: &Span<'_>,
        count: usize,
    ) -> Result<(), CardFault> {
        if positions.iter().any(|x| (*x - self.origin).abs().max_element() > FARTHEST) {
            return Err(CardFault::Far);
        }
        self.make_ready(span);
        let rhythm = self.rhythm(span, fast(velocities) + span.gravity.length() * span.small * count as f64);
        loop {
            self.write(positions, velocities, span, rhythm);
            self.submit(count, rhythm);
            let Moved { places, speeds, faults } = self.read(positions.len())?;
            if faults.near > 0 {
                let near = (faults.near as usize).next_power_of_two();
                if !self.enlarge(Rooms { near, ..self.rooms }) {
                    return Err(CardFault::Full);
                }
                continue;
            }
            if faults.touching + faults.in_body > 0 {
                return Err(CardFault::Touching);
            }
            let is_lost = |v: &Vec4| !v.is_finite() || v.truncate().length() > FASTEST;
            if let Some(lost) = speeds.iter().position(is_lost) {
                return Err(CardFault::Lost(lost));
            }
            for (x, place) in positions.iter_mut().zip(&places) {
                *x = self.origin + DVec3::new(place[0].into(), place[1].into(), place[2].into()) * UNIT;
            }
            for (v, speed) in velocities.iter_mut().zip(&speeds) {
                *v = speed.truncate().as_dvec3();
            }
            self.make_room(&faults);
            return Ok(());
        }
    }

    /// Lengthens the lists of walls and contacts for the next run if many found no room: without, nothing crosses, but what is in
    /// the way is kept farther away or not pushed away.
    fn make_room(&mut self, faults: &Faults) {
        let mut rooms = self.rooms;
        let crowded = CROWDED * self.degree.len() as f64;
        if f64::from(faults.walls) > crowded {
            rooms.walls = (2 * rooms.walls).min(MOST_ROOMS.walls);
        }
        if f64::from(faults.contacts) > crowded {
            rooms.contacts = (2 * rooms.contacts).min(MOST_ROOMS.contacts);
        }
        if rooms != self.rooms {
            self.enlarge(rooms);
        }
    }

    fn enlarge(&mut self, rooms: Rooms) -> bool {
        let sizes = self.sizes;
        let fits = rooms.near <= MOST_ROOMS.near && self.buffers.make_rooms(&self.card.device, sizes, rooms);
        if fits {
            self.rooms = rooms;
            self.bound = self.card.pipelines.bind(&self.card.device, &self.buffers);
        }
        fits
    }

    /// Lists the springs for this size of small steps and these masses.
    fn make_ready(&mut self, span: &Span<'_>) {
        if self.ready_for.0 == span.small && self.ready_for.1 == span.inverse_mass {
            return;
        }
        let list = spring_list(&self.springs, &self.shares, (span.small, span.inverse_mass));
        self.buffers.write(
            &self.card.device,
            slot::SPRINGS,
            bytemuck::cast_slice(&lists::interleaved(&list)),
        );
        self.ready_for = (span.small, span.inverse_mass.to_vec());
    }

    /// The rhythm for cloth that is about to reach this `speed`, m/s.
    fn rhythm(&self, span: &Span<'_>, speed: f64) -> Rhythm {
        let steps = |seconds: f64, most: usize| ((seconds / span.small) as usize).clamp(1, most);
        let rate = self.bending_rate * (1.0 + self.bending_rate * span.bending_damping);
        let bending = match rate > 0.0 {
            true => ((SAFE * 2.0 / (rate * span.small)) as usize).max(1),
            false => usize::MAX,
        };
        Rhythm {
            detection: match self.thickness {
                Some(_) => steps(DETECTION.min(WAY * self.mean_length / speed.max(1e-9)), MOST_STEPS.0),
                None => usize::MAX,
            },
            bending,
            look: steps(LOOK, MOST_STEPS.1),
        }
    }

    fn write(&self, positions: &[DVec3], velocities: &[DVec3], span: &Span<'_>, rhythm: Rhythm) {
        let places: Vec<[i32; 4]> = positions
            .iter()
            .zip(&self.degree)
            .map(|(x, degree)| in_units(*x, self.origin).extend(*degree).to_array())
            .collect();
        let speed = |(v, w): (&DVec3, &f64)| v.as_vec3().extend(*w as f32);
        let speeds: Vec<Vec4> = velocities.iter().zip(span.inverse_mass).map(speed).collect();
        let vertices: Vec<[f32; 4]> = (0..positions.len())
            .map(|v| {
                let w = span.inverse_mass[v];
                [w, self.friction[v], span.lift[v], self.area[v] * w].map(|x| x as f32)
            })
            .collect();
        let scene = self.scene(span, rhythm);
        for (at, contents) in [
            (slot::PLACES, bytemuck::cast_slice(&places)),
            (slot::VELOCITIES, bytemuck::cast_slice(&speeds)),
            (slot::VERTICES, bytemuck::cast_slice(&vertices)),
            (slot::SCENE, bytemuck::bytes_of(&scene)),
            (slot::FAULTS, &[0; FAULT_BYTES as usize]),
        ] {
            self.buffers.write(&self.card.device, at, contents);
        }
    }

    fn scene(&self, span: &Span<'_>, rhythm: Rhythm) -> SceneData {
        let small = span.small;
        // A force held constant lags by half of the time that it is held.
        let held =
            if rhythm.bending > 1 { rhythm.bending.min(rhythm.detection) as f64 * small / 2.0 } else { 0.0 };
        let mut scene = SceneData {
            gravity: span.gravity.as_vec3().to_array(),
            small: small as f32,
            keep: (-span.damping * small).exp() as f32,
            unit: UNIT as f32,
            limit: self.limit.min(1e9) as f32,
            vertices: self.degree.len() as u32,
            offset: span.offset as f32,
            grip: span.grip.min(1e30) as f32,
            body_ease: if span.eases_off_body { (span.ease * small) as f32 } else { 0.0 },
            ease: (span.ease * small) as f32,
            ahead: (span.bending_damping + held) as f32,
            thickness: self.thickness.unwrap_or(0.0) as f32,
            triangles: self.sizes.triangles as u32,
            flags: if self.has_body { BODY } else { 0 } | if self.thickness.is_some() { CONTACT } else { 0 },
            span: (rhythm.detection.min(MOST_STEPS.0) as f64 * small * AHEAD) as f32,
            look_span: (rhythm.look as f64 * small) as f32,
            walls: self.rooms.walls as u32,
            contacts: self.rooms.contacts as u32,
            near: self.rooms.near as u32,
            part_walls: self.rooms.at_triangle().0 as u32,
            part_contacts: self.rooms.at_triangle().1 as u32,
            rounds: self.sizes.rounds as u32,
            most_reach: (FARTHEST_REACH * self.mean_length) as f32,
            floor: FLOOR.0.max(FLOOR.1 * self.mean_length) as f32,
            hand: u32::MAX,
            ..SceneData::default()
        };
        if let Some(hand) = span.hand {
            let w = span.inverse_mass[hand.vertex as usize];
            scene.hand = hand.vertex;
            scene.hand_share = (w / (w + 1.0 / (hand.stiffness * small * small))) as f32;
            scene.hand_most = (hand.most * w * small * small) as f32;
            let target = hand.target.clamp(self.origin - FARTHEST, self.origin + FARTHEST);
            scene.hand_target = in_units(target, self.origin).to_array();
        }
        scene
    }

    /// Sends the work of `count` small steps to the card.
    fn submit(&mut self, count: usize, rhythm: Rhythm) {
        let vertices = self.degree.len();
        let mut encoder =
            self.card.device.gpu.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
        // Which of the two buffers holds the positions.
        let mut turn = 0;
        let mut done = 0;
        while done < count {
            let part = rhythm.detection.min(count - done);
            if self.thickness.is_some() {
                self.detect(&mut pass, turn);
                self.detections += 1;
            }
            let mut run = |work: Work, turn: usize| {
                self.card.pipelines.run(&mut pass, &self.bound, (work, turn), vertices)
            };
            for step in 0..=part {
                if step < part && step % rhythm.bending == 0 && self.bending_rate > 0.0 {
                    run(Work::Bend, turn);
                }
                if step > 0 && self.has_body && (step - 1) % rhythm.look == 0 {
                    run(Work::Look, turn);
                }
                run(
                    if step == 0 {
                        Work::Begin
                    } else if step == part {
                        Work::Finish
                    } else {
                        Work::Go
                    },
                    turn,
                );
                turn = 1 - turn;
            }
            done += part;
        }
        drop(pass);
        let [places, speeds] = match turn {
            0 => [slot::PLACES, slot::VELOCITIES],
            _ => [slot::NEXT_PLACES, slot::NEXT_VELOCITIES],
        };
        let (bytes, read) = (vertices as u64 * 16, &self.buffers.read);
        encoder.copy_buffer_to_buffer(self.buffers.of(places), 0, read, 0, bytes);
        encoder.copy_buffer_to_buffer(self.buffers.of(speeds), 0, read, bytes, bytes);
        encoder.copy_buffer_to_buffer(self.buffers.of(slot::FAULTS), 0, read, 2 * bytes, FAULT_BYTES);
        self.card.device.queue.submit([encoder.finish()]);
    }

    fn detect(&self, pass: &mut wgpu::ComputePass<'_>, turn: usize) {
        let run = |pass: &mut wgpu::ComputePass<'_>, work, count| {
            self.card.pipelines.run(pass, &self.bound, (work, turn), count);
        };
        run(pass, Work::Anchor, self.degree.len());
        run(pass, Work::Enclose, self.sizes.triangles);
        self.card.pipelines.refit(pass, &self.bound);
        run(pass, Work::Gather, self.sizes.triangles);
        run(pass, Work::Part, self.sizes.rounds);
        run(pass, Work::Collect, self.degree.len());
    }

    /// Positions, velocities and faults after the work that was submitted.
    fn read(&self, vertices: usize) -> Result<Moved, CardFault> {
        let broken = CardFault::Broken;
        let (sender, receiver) = std::sync::mpsc::channel();
        let slice = self.buffers.read.slice(..);
        slice.map_async(wgpu::MapMode::Read, move |result| {
            sender.send(result).ok();
        });
        self.card
            .device
            .gpu
            .poll(wgpu::PollType::Wait { submission_index: None, timeout: Some(PATIENCE) })
            .map_err(|e| broken(e.to_string()))?;
        receiver
            .recv_timeout(PATIENCE)
            .map_err(|e| broken(e.to_string()))?
            .map_err(|e| broken(e.to_string()))?;
        let bytes = slice.get_mapped_range().map_err(|e| broken(e.to_string()))?.to_vec();
        self.buffers.read.unmap();
        if self.card.device.is_broken() {
            return Err(broken(self.card.name().to_owned()));
        }
        let at = vertices * 16;
        Ok(Moved {
            places: bytemuck::pod_collect_to_vec(&bytes[..at]),
            speeds: bytemuck::pod_collect_to_vec(&bytes[at..2 * at]),
            faults: bytemuck::pod_read_unaligned(&bytes[2 * at..2 * at + size_of::<Faults>()]),
        })
    }
}

/// The speed that only a small share of the vertices exceeds, m/s.
fn fast(velocities: &[DVec3]) -> f64 {
    let mut speeds: Vec<f64> = velocities.iter().map(|v| v.length()).collect();
    let at = (speeds.len() as f64 * (1.0 - FAST)) as usize;
    if at < speeds.len() { *speeds.select_nth_unstable_by(at, f64::total_cmp).1 } else { 0.0 }
}

fn mean(of: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = of.len().max(1) as f64;
    of.sum::<f64>() / count
}

/// For each vertex its springs, as shaders/card/scene.wgsl has them, for small steps of this size and these inverse masses.
fn spring_list(
    springs: &[Spring],
    shares: &Shares,
    (small, inverse_mass): (f64, &[f64]),
) -> Vec<Vec<[u32; 4]>> {
    let mut list: Vec<Vec<[u32; 4]>> = vec![Vec::new(); inverse_mass.len()];
    for (spring, &most) in springs.iter().zip(&shares.most) {
        let [a, b] = spring.ends;
        let [wa, wb] = spring.ends.map(|v| inverse_mass[v as usize]);
        let whole = wa + wb;
        let soft = match whole > 0.0 {
            true => (whole / (whole + 1.0 / (spring.stiffness * small * small))).min(most),
            false => 0.0,
        };
        for (v, other, w) in [(a, b, wa), (b, a, wb)] {
            let share = if whole > 0.0 { w / whole } else { 0.0 };
            let figures = [spring.length * spring.length, share * soft, share * (most - soft)];
            let [rest, soft, more] = figures.map(|x| (x as f32).to_bits());
            list[v as usize].push([other, rest, soft, more]);
        }
    }
    list
}
