//! Runs loops with the widest vector instructions (SIMD) of the machine.

/// Runs `work`, and the code inlined into it, compiled for the vector instructions of this machine where the compiler
/// knows them (AVX2), else for any machine. The order of sums is kept and multiplications are not fused with
/// additions, so that the result has the same bits either way.
#[inline(always)]
pub fn wide<R>(work: impl FnOnce() -> R) -> R {
    pulp::Arch::new().dispatch(work)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[inline(always)]
    fn sum(a: &[f64], b: &[f64]) -> [f64; 4] {
        let mut sums = [0.0; 4];
        for (a, b) in a.chunks_exact(4).zip(b.chunks_exact(4)) {
            (0..4).for_each(|k| sums[k] += a[k] * b[k]);
        }
        sums
    }

    #[test]
    fn wide_registers_give_the_same_bits() {
        let of = |k: u32| (0..4000u32).map(|i| f64::from(i * k % 9973) / 997.0 - 4.0).collect::<Vec<f64>>();
        let (a, b) = (of(31), of(577));
        let plain = std::hint::black_box(sum)(&a, &b);
        let wide = wide(
            #[inline(always)]
            || sum(&a, &b),
        );
        assert_eq!(plain.map(f64::to_bits), wide.map(f64::to_bits));
    }
}
