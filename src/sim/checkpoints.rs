//! States to return to, by the number of the request that followed them.

use std::collections::BTreeMap;

use crate::sim::world::World;

/// Memory for checkpoints, bytes, unless told otherwise.
pub const DEFAULT_CAPACITY: usize = 512 << 20;

/// Kept states, the oldest dropped first when they take too much memory. The newest always stays.
#[derive(Debug)]
pub struct Checkpoints {
    worlds: BTreeMap<u64, (World, usize)>,
    bytes: usize,
    capacity: usize,
}

impl Checkpoints {
    /// Keeps about `capacity` bytes of them.
    pub fn new(capacity: usize) -> Self {
        Self { worlds: BTreeMap::new(), bytes: 0, capacity }
    }

    /// Keeps `world` as the state before request `seq`. When that drops others: the oldest request still kept.
    pub fn store(&mut self, seq: u64, world: World) -> Option<u64> {
        let bytes = world.bytes_beside(self.newest());
        self.bytes += bytes;
        self.worlds.insert(seq, (world, bytes));
        let mut dropped = false;
        while self.bytes > self.capacity && self.worlds.len() > 1 {
            if let Some((_, (_, bytes))) = self.worlds.pop_first() {
                self.bytes -= bytes;
                dropped = true;
            }
        }
        if dropped { self.worlds.keys().next().copied() } else { None }
    }

    /// The state before request `seq`, if it is kept.
    pub fn before(&self, seq: u64) -> Option<&World> {
        self.worlds.get(&seq).map(|(world, _)| world)
    }

    /// The newest state kept.
    pub fn newest(&self) -> Option<&World> {
        self.worlds.last_key_value().map(|(_, (world, _))| world)
    }
}
