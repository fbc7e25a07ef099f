//! Ways to grow the same marks.

/// See [`Plan::contact`].
pub(super) const LIGHT_CONTACT: f64 = 0.03;
/// See [`Plan::contact`].
const HEAVY_CONTACT: f64 = 0.1;

/// A way to grow. How cloth falls round a limb depends on small things: what fails one way goes well another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    /// Local passes after each band of growth (ALGORITHMS.md 8.1).
    pub local_passes: usize,
    /// Bands between global steps.
    pub bands_per_global: usize,
    /// Steps by which a new vertex is pushed out of the body before it goes to the nearest skin.
    pub pushes: usize,
    /// Layers that grow into each other are parted at once, not only when all cloth lies: deep folds need it.
    pub part: bool,
    /// Later tiers grow along the limbs that their seams go round.
    pub along_limbs: bool,
    /// Weight of contact once the cloth roughly lies, on this mesh and the finer ones. Light, it slides to where it is least
    /// strained; heavy, what is too tight does not slip through a limb.
    pub contact: f64,
}

/// The quickest first; what needs the next is found out on the coarsest mesh.
pub(super) const PLANS: [Plan; 8] = [
    PLAIN,
    Plan { part: true, ..PLAIN },
    Plan { pushes: 10, ..PLAIN },
    Plan { contact: HEAVY_CONTACT, ..PLAIN },
    Plan { pushes: 10, ..THOROUGH },
    Plan { contact: HEAVY_CONTACT, ..THOROUGH },
    Plan { along_limbs: true, contact: HEAVY_CONTACT, ..PLAIN },
    Plan { along_limbs: true, contact: HEAVY_CONTACT, ..THOROUGH },
];
const PLAIN: Plan = Plan {
    local_passes: 6,
    bands_per_global: 3,
    pushes: 30,
    part: false,
    along_limbs: false,
    contact: LIGHT_CONTACT,
};
const THOROUGH: Plan = Plan { local_passes: 12, bands_per_global: 1, ..PLAIN };
