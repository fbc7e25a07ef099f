//! The buffers of a card, each under the number that shaders/card/scene.wgsl binds it to.

use std::collections::BTreeMap;

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec4};

use crate::card::device::Device;
use crate::card::lists;
use crate::card::scene::{Body, Cloth, SceneData, in_units};
use crate::geometry::bvh::{Aabb, Bvh};

/// Bindings of shaders/card/scene.wgsl.
pub mod slot {
    pub const SCENE: u32 = 0;
    pub const SPRINGS: u32 = 1;
    pub const PLACES: u32 = 2;
    pub const NEXT_PLACES: u32 = 3;
    pub const VELOCITIES: u32 = 4;
    pub const NEXT_VELOCITIES: u32 = 5;
    pub const BENT: u32 = 6;
    pub const SKINS: u32 = 7;
    pub const ANCHORS: u32 = 8;
    pub const WALLS: u32 = 9;
    pub const COUNTS: u32 = 10;
    pub const CONTACTS: u32 = 11;
    pub const TRIANGLES: u32 = 12;
    pub const SLOTS: u32 = 13;
    pub const NODES: u32 = 14;
    pub const NODE_BOXES: u32 = 15;
    pub const BOXES: u32 = 16;
    pub const NEAR: u32 = 17;
    pub const NEAR_COUNTS: u32 = 18;
    pub const NEAR_BODY: u32 = 19;
    pub const BESIDE: [u32; 2] = [20, 21];
    pub const ROUNDS: [u32; 2] = [22, 23];
    pub const BENDING_COUNTS: u32 = 24;
    pub const BENDING: u32 = 25;
    pub const BODY_PLACES: u32 = 26;
    pub const BODY_TRIANGLES: u32 = 27;
    pub const BODY_NODES: u32 = 28;
    pub const BODY_BOXES: u32 = 29;
    pub const BODY_SLOTS: u32 = 30;
    pub const BODY_NORMALS: u32 = 31;
    pub const ORDER: u32 = 32;
    pub const VERTICES: u32 = 33;
    pub const LEVEL: u32 = 34;
    pub const FAULTS: u32 = 35;
    pub const PART_COUNTS: u32 = 36;
    pub const PART_WALLS: u32 = 37;
    pub const PART_CONTACTS: u32 = 38;
    /// Bindings that no shader writes.
    pub const READ_ONLY: [u32; 20] = [
        SPRINGS,
        PLACES,
        VELOCITIES,
        TRIANGLES,
        SLOTS,
        NODES,
        BESIDE[0],
        BESIDE[1],
        ROUNDS[0],
        ROUNDS[1],
        BENDING_COUNTS,
        BENDING,
        BODY_PLACES,
        BODY_TRIANGLES,
        BODY_NODES,
        BODY_BOXES,
        BODY_SLOTS,
        BODY_NORMALS,
        ORDER,
        VERTICES,
    ];
}

/// What shaders/card/contact.wgsl counts as `faults`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct Faults {
    /// The longest list of near triangles, if there was no room for one.
    pub near: u32,
    /// Walls, and contacts, for which a vertex had no room.
    pub walls: u32,
    pub contacts: u32,
    /// Features of the cloth that touch each other, and that touch the body.
    pub touching: u32,
    pub in_body: u32,
}

/// Bytes of `faults`.
pub const FAULT_BYTES: u64 = size_of::<Faults>() as u64;
/// Bytes of a `Skin`, a wall and a `Contact`.
const SKIN: usize = 64;
const WALL: usize = 16;
const CONTACT: usize = 32;

/// Rooms in lists: triangles near a triangle, walls and contacts of a vertex. At each of its triangles a vertex has room for a
/// quarter of these.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rooms {
    pub near: usize,
    pub walls: usize,
    pub contacts: usize,
}

impl Rooms {
    /// Walls and contacts of a vertex at one of its triangles.
    pub fn at_triangle(self) -> (usize, usize) {
        (self.walls / 4, self.contacts / 4)
    }
}

/// Numbers of vertices, of triangles, and of vertices with each of the triangles round them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sizes {
    pub vertices: usize,
    pub triangles: usize,
    pub rounds: usize,
}

/// All buffers.
#[derive(Debug)]
pub struct Buffers {
    of: BTreeMap<u32, wgpu::Buffer>,
    /// For each level of the cloth's tree its number of nodes and its uniform.
    pub levels: Vec<(u32, wgpu::Buffer)>,
    /// Positions, velocities and faults for reading.
    pub read: wgpu::Buffer,
}

impl Buffers {
    /// Buffers of `cloth`, at `x` now, with its list of `springs`, and `body`; positions are relative to `origin`.
    pub fn new(
        device: &Device,
        (cloth, springs): (&Cloth<'_>, &[[u32; 4]]),
        body: Option<&Body<'_>>,
        x: &[DVec3],
        origin: DVec3,
    ) -> Self {
        let (count, triangles) = (x.len(), cloth.triangles.len());
        let mut filled = Filled { device, of: BTreeMap::new() };
        let moving = [slot::PLACES, slot::NEXT_PLACES, slot::VELOCITIES, slot::NEXT_VELOCITIES];
        moving.into_iter().chain([slot::BENT, slot::ANCHORS, slot::VERTICES]).for_each(|at| {
            filled.empty(at, count * 16);
        });
        filled.put(slot::SPRINGS, bytemuck::cast_slice(springs));
        filled.empty(slot::COUNTS, count * 8);
        filled.empty(slot::FAULTS, FAULT_BYTES as usize);
        // Not looked up yet: valid within a negative distance.
        let unseen: Vec<[f32; 16]> = vec![std::array::from_fn(|k| if k == 3 { -1.0 } else { 0.0 }); count];
        debug_assert_eq!(size_of::<[f32; 16]>(), SKIN);
        filled.put(slot::SKINS, bytemuck::cast_slice(&unseen));
        let rows: Vec<Vec<[u32; 2]>> = bending_rows(cloth.bending);
        let counts: Vec<u32> = rows.iter().map(|row| row.len() as u32).collect();
        filled.put(slot::BENDING_COUNTS, bytemuck::cast_slice(&counts));
        filled.put(slot::BENDING, bytemuck::cast_slice(&lists::interleaved(&rows)));
        let owned = lists::owned(cloth.triangles, cloth.adjacency);
        filled.put(slot::TRIANGLES, bytemuck::cast_slice(&owned));
        let around = |vs: &[u32; 3]| Aabb::around(&vs.map(|v| x[v as usize]));
        let tree = Bvh::new(&cloth.triangles.iter().map(around).collect::<Vec<_>>());
        filled.put(slot::SLOTS, bytemuck::cast_slice(&tree.items));
        filled.put(slot::NODES, bytemuck::cast_slice(&lists::nodes(&tree)));
        filled.empty(slot::NODE_BOXES, tree.nodes.len() * 32);
        filled.empty(slot::BOXES, triangles * 32);
        filled.empty(slot::NEAR_COUNTS, triangles * 8);
        let (starts, beside) = lists::beside(cloth.triangles, cloth.adjacency);
        filled.put(slot::BESIDE[0], bytemuck::cast_slice(&starts));
        filled.put(slot::BESIDE[1], bytemuck::cast_slice(&beside));
        let (starts, rounds) = lists::rounds(count, cloth.adjacency);
        filled.put(slot::ROUNDS[0], bytemuck::cast_slice(&starts));
        filled.put(slot::ROUNDS[1], bytemuck::cast_slice(&rounds));
        filled.empty(slot::PART_COUNTS, rounds.len() * 16);
        let (order, ranges) = lists::levels(&tree);
        filled.put(slot::ORDER, bytemuck::cast_slice(&order));
        filled.body(body, origin);
        let uniform = wgpu::BufferUsages::UNIFORM;
        let scene = device.buffer(size_of::<SceneData>() as u64, uniform);
        filled.of.insert(slot::SCENE, scene);
        let level = |&[first, count]: &[u32; 2]| {
            let level = device.buffer(16, uniform);
            device.queue.write_buffer(&level, 0, bytemuck::cast_slice(&[first, count, 0, 0]));
            (count, level)
        };
        let levels = ranges.iter().map(level).collect();
        let read = device.buffer(count as u64 * 32 + FAULT_BYTES, wgpu::BufferUsages::MAP_READ);
        Self { of: filled.of, levels, read }
    }

    /// The buffer behind a binding.
    pub fn of(&self, slot: u32) -> &wgpu::Buffer {
        &self.of[&slot]
    }

    /// Makes the lists of contact for this many rooms. False where one of them would be too large for the card.
    pub fn make_rooms(&mut self, device: &Device, sizes: Sizes, rooms: Rooms) -> bool {
        let Sizes { vertices, triangles, rounds } = sizes;
        let (part_walls, part_contacts) = rooms.at_triangle();
        let wanted = [
            (slot::NEAR, rooms.near * triangles * 4),
            (slot::NEAR_BODY, rooms.near * triangles * 4),
            (slot::WALLS, rooms.walls * vertices * WALL),
            (slot::CONTACTS, rooms.contacts * vertices * CONTACT),
            (slot::PART_WALLS, part_walls * rounds * WALL),
            (slot::PART_CONTACTS, part_contacts * rounds * CONTACT),
        ];
        if wanted.iter().any(|(_, bytes)| *bytes as u64 > device.most_bytes()) {
            return false;
        }
        let mut filled = Filled { device, of: std::mem::take(&mut self.of) };
        wanted.into_iter().for_each(|(at, bytes)| filled.empty(at, bytes));
        self.of = filled.of;
        true
    }

    /// Writes `contents`, as long as what was there at first or shorter, into the buffer behind a binding.
    pub fn write(&self, device: &Device, slot: u32, contents: &[u8]) {
        device.queue.write_buffer(&self.of[&slot], 0, contents);
    }
}

/// Buffers being made.
struct Filled<'a> {
    device: &'a Device,
    of: BTreeMap<u32, wgpu::Buffer>,
}

impl Filled<'_> {
    fn empty(&mut self, slot: u32, bytes: usize) {
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        self.of.insert(slot, self.device.buffer(bytes as u64, usage));
    }

    fn put(&mut self, slot: u32, contents: &[u8]) {
        self.empty(slot, contents.len());
        self.device.queue.write_buffer(&self.of[&slot], 0, contents);
    }

    fn body(&mut self, body: Option<&Body<'_>>, origin: DVec3) {
        let slots = [
            slot::BODY_PLACES,
            slot::BODY_TRIANGLES,
            slot::BODY_NODES,
            slot::BODY_BOXES,
            slot::BODY_SLOTS,
            slot::BODY_NORMALS,
        ];
        let Some(body) = body else { return slots.into_iter().for_each(|at| self.empty(at, 0)) };
        let mesh = body.mesh;
        let places: Vec<[i32; 4]> =
            mesh.positions.iter().map(|p| in_units(*p, origin).extend(0).to_array()).collect();
        self.put(slot::BODY_PLACES, bytemuck::cast_slice(&places));
        let owned = lists::owned(&mesh.triangles, body.adjacency);
        self.put(slot::BODY_TRIANGLES, bytemuck::cast_slice(&owned));
        let tree = mesh.tree();
        self.put(slot::BODY_NODES, bytemuck::cast_slice(&lists::nodes(&tree)));
        let corners = |bounds: &Aabb| {
            [in_units(bounds.lower, origin) - 1, in_units(bounds.upper, origin) + 1]
                .map(|p| p.extend(0).to_array())
        };
        let boxes: Vec<[i32; 4]> = tree.nodes.iter().flat_map(|node| corners(&node.bounds)).collect();
        self.put(slot::BODY_BOXES, bytemuck::cast_slice(&boxes));
        self.put(slot::BODY_SLOTS, bytemuck::cast_slice(&tree.items));
        let unit = |normal: &DVec3| normal.normalize_or_zero().as_vec3().extend(0.0);
        let normals: Vec<Vec4> = body.normals.iter().flatten().map(unit).collect();
        self.put(slot::BODY_NORMALS, bytemuck::cast_slice(&normals));
    }
}

/// Rows of the bending matrix without their diagonal: rows sum to zero.
fn bending_rows(rows: &[Vec<(u32, f64)>]) -> Vec<Vec<[u32; 2]>> {
    let entry = |i: usize, &(j, q): &(u32, f64)| (j as usize != i).then(|| [j, (q as f32).to_bits()]);
    rows.iter().enumerate().map(|(i, row)| row.iter().filter_map(|e| entry(i, e)).collect()).collect()
}
