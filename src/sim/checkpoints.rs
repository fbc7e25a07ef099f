//! Checkpoints: states to return to, by the number of the request that followed each.

use std::collections::BTreeMap;

use crate::sim::world::World;

/// Default memory for checkpoints, bytes.
pub const DEFAULT_CAPACITY: usize = 512 << 20;

/// Stored states. When they take too much memory the oldest are dropped first; the newest always stays.
#[derive(Debug)]
pub struct Checkpoints {
    worlds: BTreeMap<u64, (World, usize)>,
    bytes: usize,
    capacity: usize,
}

impl Checkpoints {
    /// An empty store of about `capacity` bytes.
    pub fn new(capacity: usize) -> Self {
        Self { worlds: BTreeMap::new(), bytes: 0, capacity }
    }

    /// Stores `world` as the state before request `seq`. Returns the oldest request whose state is still stored, if others were
    /// dropped.
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

    /// The state before request `seq`, if it is stored.
    pub fn before(&self, seq: u64) -> Option<&World> {
        self.worlds.get(&seq).map(|(world, _)| world)
    }

    /// The newest state.
    pub fn newest(&self) -> Option<&World> {
        self.worlds.last_key_value().map(|(_, (world, _))| world)
    }
}
