//! Loops in the widest registers that the machine has.

/// Does `work` with what is inlined in it compiled for the machine at hand, as far as the compiler knows of it (AVX2), and
/// otherwise for any. Sums keep their order and products are not fused with them: the same bits either way.
#[inline(always)]
pub fn wide<R>(work: impl FnOnce() -> R) -> R {
    pulp::Arch::new().dispatch(work)
}
