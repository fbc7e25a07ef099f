//! State hashes: 64-bit FNV-1a (Fowler, Noll, Vo; offset basis and prime as published) over the bits of the state.

use glam::DVec3;

use crate::cloth::ClothState;
use crate::wrap::Phase;

const OFFSET_BASIS: u64 = 0xcbf2_9ce4_8422_2325;
const PRIME: u64 = 0x0000_0100_0000_01b3;

/// Hash in progress.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fnv(u64);

impl Default for Fnv {
    fn default() -> Self {
        Self(OFFSET_BASIS)
    }
}

impl Fnv {
    /// Adds `bytes`.
    pub fn bytes(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(PRIME);
        }
    }

    /// Adds an integer, least significant byte first.
    pub fn number(&mut self, number: u64) {
        self.bytes(&number.to_le_bytes());
    }

    /// Adds the bits of a point: -0 and 0 differ.
    pub fn point(&mut self, p: DVec3) {
        for x in p.to_array() {
            self.number(x.to_bits());
        }
    }

    /// The hash.
    pub fn finish(self) -> u64 {
        self.0
    }
}

/// Hash of the moving state: which vertices are mapped, their positions, the phase, and whether the simulation is running.
pub fn cloth_hash(cloth: &ClothState, phase: Option<Phase>, relaxing: bool) -> u64 {
    let mut hash = Fnv::default();
    hash.number(cloth.positions.len() as u64);
    for (&position, &mapped) in cloth.positions.iter().zip(&cloth.mapped) {
        hash.bytes(&[u8::from(mapped)]);
        if mapped {
            hash.point(position);
        }
    }
    let phase = match phase {
        None => 0,
        Some(Phase::Growing) => 1,
        Some(Phase::Settling) => 2,
        Some(Phase::AtRest) => 3,
    };
    hash.bytes(&[phase, u8::from(relaxing)]);
    hash.finish()
}

/// Hash of `bytes`.
pub fn hash_of(bytes: &[u8]) -> u64 {
    let mut hash = Fnv::default();
    hash.bytes(bytes);
    hash.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn published_test_vectors_are_met() {
        assert_eq!(hash_of(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(hash_of(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(hash_of(b"foobar"), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn one_bit_of_one_mapped_vertex_counts() {
        let mut cloth = ClothState { positions: vec![DVec3::ONE; 3], mapped: vec![true, true, false] };
        let hash = |c: &ClothState| cloth_hash(c, Some(Phase::Settling), true);
        let before = hash(&cloth);
        cloth.positions[2].x = 5.0;
        assert_eq!(hash(&cloth), before, "an unmapped vertex has no place");
        cloth.positions[1].x = f64::from_bits(1f64.to_bits() + 1);
        assert_ne!(hash(&cloth), before);
        assert_ne!(cloth_hash(&cloth, Some(Phase::AtRest), true), hash(&cloth));
    }
}
