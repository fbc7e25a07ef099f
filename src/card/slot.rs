//! A card ready for use, and where it is looked for.

use std::sync::{Arc, OnceLock};

use crate::card::device::{Device, NoCard};
use crate::card::pipelines::Pipelines;

/// A graphics card with its compiled shaders.
#[derive(Debug)]
pub struct Card {
    pub(super) device: Device,
    pub(super) pipelines: Pipelines,
}

impl Card {
    /// The best card of this machine. Software counts as one only with `software`.
    pub fn find(software: bool) -> Result<Self, NoCard> {
        let device = Device::find(software)?;
        let pipelines = Pipelines::new(&device);
        match device.is_broken() {
            true => Err(NoCard::None(format!("{} does not take the shaders", device.name))),
            false => Ok(Self { device, pipelines }),
        }
    }

    /// Name of the adapter, for people.
    pub fn name(&self) -> &str {
        &self.device.name
    }
}

/// A card that is looked for when it is first needed.
#[derive(Debug)]
pub struct CardSlot {
    software: bool,
    least: usize,
    found: OnceLock<Result<Arc<Card>, NoCard>>,
}

impl CardSlot {
    /// A card for cloth of at least `least` triangles. Software counts as one only with `software`.
    pub fn new(software: bool, least: usize) -> Self {
        Self { software, least, found: OnceLock::new() }
    }

    /// The card for cloth of so many triangles; None where there is none, or where the processor is to be used.
    pub fn for_cloth(&self, triangles: usize) -> Option<&Arc<Card>> {
        if triangles < self.least { None } else { self.look().ok() }
    }

    /// The card, whatever the cloth.
    pub fn look(&self) -> Result<&Arc<Card>, &NoCard> {
        let find = || {
            let found = Card::find(self.software).map(Arc::new);
            match &found {
                Ok(card) => tracing::info!("large garments are draped on {}", card.name()),
                Err(why) => tracing::info!("no card to drape on: {why}"),
            }
            found
        };
        self.found.get_or_init(find).as_ref()
    }
}
