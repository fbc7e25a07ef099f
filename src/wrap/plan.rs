//! Plans: alternative parameters for growing from the same marks.

use crate::relax::step::HEAVY_CONTACT;

/// Parameters of growth. How cloth falls round a limb depends on small things: where one plan fails another succeeds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    /// Number of local passes after each band of growth (ALGORITHMS.md 8.1).
    pub local_passes: usize,
    /// Over-relaxation factor of the local passes, 1 to below 2.
    pub local_factor: f64,
    /// Number of rings of vertices round new ones that the local passes move.
    pub rings: usize,
    /// Number of bands between groups of global steps.
    pub bands_per_global: usize,
    /// Number of global steps in a group.
    pub globals_per_group: usize,
    /// Number of global steps between two tiers of growth.
    pub tier_steps: usize,
    /// Weight of contact while the cloth grows and closes: heavy, so that closing seams do not pull it through a limb.
    pub growing_contact: f64,
    /// Number of steps by which a new vertex is pushed out of the body before it goes to the nearest skin.
    pub pushes: usize,
    /// Whether layers that intersect while growing are separated at once, and not only when all cloth is placed.
    pub part: bool,
    /// Whether later tiers are laid as tubes round the limbs that their seams go round.
    pub tubes: bool,
    /// Weight of contact once the cloth is roughly in place, on this mesh and finer ones. A light one lets cloth
    /// slide to where it is least strained; a heavy one keeps tight cloth from slipping through a limb.
    pub contact: f64,
}

/// The plans in the order in which they are tried, on the coarsest mesh. Of 48 garments (18 samples, and five patterns made by others, each
/// on six bodies) the first served 17 and the second 38; the third left fewer faults in some of the others. The last is for deep folds,
/// such as those of a flared skirt in a coarse mesh.
pub(super) const PLANS: [Plan; 4] = [
    PLAIN,
    // More relaxation of what has just grown.
    Plan { local_passes: 12, bands_per_global: 1, ..HEAVY },
    HEAVY,
    Plan { part: true, ..PLAIN },
];
/// The quickest plan, with a light contact.
pub(super) const PLAIN: Plan = Plan {
    local_passes: 6,
    local_factor: 1.6,
    rings: 2,
    bands_per_global: 3,
    globals_per_group: 3,
    tier_steps: 15,
    growing_contact: 0.3,
    pushes: 30,
    part: false,
    tubes: false,
    contact: 0.03,
};
/// With tubes, and a contact that keeps tight cloth from slipping through a limb.
const HEAVY: Plan = Plan { tubes: true, contact: HEAVY_CONTACT, ..PLAIN };
