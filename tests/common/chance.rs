//! Random numbers that are the same on every machine.

/// A linear congruential generator (Knuth's MMIX constants); the upper bits count.
pub struct Chance(pub u64);

impl Chance {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        self.0 >> 33
    }

    /// 0..n.
    pub fn below(&mut self, n: u64) -> u64 {
        self.bits() % n
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.bits() as f64 / (1u64 << 31) as f64
    }

    /// Seldom no number at all.
    pub fn number(&mut self, low: f64, high: f64) -> f64 {
        match self.below(400) {
            0 => f64::NAN,
            1 => 1e300,
            2 => 0.0,
            _ => self.between(low, high),
        }
    }
}
