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
    /// Whether later tiers grow along the limbs that their seams go round.
    pub along_limbs: bool,
    /// Weight of contact once the cloth is roughly in place, on this mesh and finer ones. A light one lets cloth
    /// slide to where it is least strained; a heavy one keeps tight cloth from slipping through a limb.
    pub contact: f64,
}

/// The plans in the order in which they are tried, on the coarsest mesh. Of 86 garments the first served 66, the second 9 more, which
/// slip through a limb with light contact, and the next two 4 more; the other 7 were served by none of eight plans. The last is for deep
/// folds, such as those of a flared skirt in a coarse mesh.
pub(super) const PLANS: [Plan; 5] = [
    PLAIN,
    Plan { contact: HEAVY_CONTACT, ..THOROUGH },
    Plan { along_limbs: true, contact: HEAVY_CONTACT, ..PLAIN },
    Plan { along_limbs: true, contact: HEAVY_CONTACT, ..THOROUGH },
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
    along_limbs: false,
    contact: 0.03,
};
/// More relaxation of what has just grown.
const THOROUGH: Plan = Plan { local_passes: 12, bands_per_global: 1, ..PLAIN };
