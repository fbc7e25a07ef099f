//! Benchmark of draping: a dress until it is at rest, and a single step.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::Instant;

use crate::body::mannequin;
use crate::card::CardSlot;
use crate::cli::bench::row::{Check, Figure, Row, Unit};
use crate::cli::bench::scenes::Scene;
use crate::cli::bench::{median, one_hash};
use crate::cli::failure::Failure;
use crate::cli::{interrupt, output};
use crate::cloth::{Fabric, Skips};
use crate::drape::{DrapedGarment, DrapedSettings};
use crate::fit::{self, BodyIndex};
use crate::session::samples::Sample;
use crate::sim::hash::cloth_hash;
use crate::wrap::Phase;

/// Drapes the sample dress, of about `triangles` triangles, by the processor and then on the graphics card.
pub fn on_card(
    triangles: usize,
    runs: usize,
    skips: Skips,
    mut tell: impl FnMut(Row) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let slot = CardSlot::new(true, 0);
    let card = slot.look().map_err(|why| Failure::Limit(why.to_string()))?;
    output::complain(&format!("      on {}", card.name()));
    let scene = Scene::sample(Sample::Dress, &mannequin::default(), triangles)?.skipping(skips);
    tell(drape(&scene, runs, None)?)?;
    tell(drape(&scene, runs, Some(&slot))?)
}

/// Wraps the garment of `scene` once and drapes it `runs` times; on a graphics card if there is a `slot` with one.
pub fn drape(scene: &Scene, runs: usize, slot: Option<&CardSlot>) -> Result<Row, Failure> {
    let scene_name = match slot {
        Some(_) => "the same on the graphics card",
        None => "drape of the dress, to rest",
    };
    let wrapped = scene.wrap()?;
    let words = || Failure::Internal("a sample cannot be draped".to_owned());
    let cotton = Fabric::preset(Fabric::USUAL).ok_or_else(words)?;
    let settings = DrapedSettings { strain: 0.01, self_collision: true, skips: scene.relax.skips };
    let (mut all, mut each, mut hashes, mut ticks) = (Vec::new(), Vec::new(), Vec::new(), 0);
    let mut cloth = wrapped.state.clone();
    let mut last = None;
    for _ in 0..runs.max(1) {
        cloth = wrapped.state.clone();
        let start = Instant::now();
        let (garment, surface) = (Arc::clone(&wrapped.garment), Arc::clone(&scene.surface));
        let mut worn =
            DrapedGarment::new(garment, &cloth, surface, (&BTreeMap::new(), cotton), &[], settings)
                .map_err(|why| Failure::Internal(why.0.into()))?;
        if let Some(slot) = slot {
            worn = worn.with_card(slot);
        }
        while !worn.progress().at_rest {
            interrupt::check()?;
            let start = Instant::now();
            worn.tick(&mut cloth).map_err(|why| Failure::Internal(why.0.into()))?;
            each.push(start.elapsed().as_secs_f64());
        }
        all.push(start.elapsed().as_secs_f64());
        ticks = worn.progress().ticks;
        hashes.push(cloth_hash(&cloth, Some(Phase::AtRest), true));
        if slot.is_some() && !worn.was_on_card() {
            return Err(Failure::Internal("the graphics card was not used".to_owned()));
        }
        last = Some(worn);
    }
    let worn = last.ok_or_else(words)?;
    let report = fit::measure(&scene.pattern, &wrapped.garment, &cloth, &BodyIndex::new(&scene.surface));
    let seconds = median(all);
    let longest = each.iter().copied().fold(0.0, f64::max);
    let count = |what, value: usize| Figure { what, value: value as f64, unit: Unit::Count };
    Ok(Row {
        scene: scene_name,
        triangles: wrapped.garment.triangles.len(),
        runs,
        seconds,
        threads: rayon::current_num_threads(),
        checks: vec![
            Check::new("to rest, from where the wrap left it", seconds, Unit::Seconds, 2.0, 0.5),
            Check::new("a tick of 1/60 s", median(each), Unit::Seconds, 0.016, 0.008),
            Check::new("p99 strain", report.strain.p99, Unit::Share, 0.01, 0.005),
        ],
        figures: vec![
            Figure { what: "the longest tick", value: longest, unit: Unit::Seconds },
            Figure { what: "largest strain", value: report.strain.max, unit: Unit::Share },
            Figure { what: "what moves it at rest", value: worn.progress().residual, unit: Unit::Share },
            count("vertices in the body", report.penetration.vertices),
            count("edges through the body", report.edges_through_body),
            count("self crossings", report.self_crossings),
            count("ticks", ticks as usize),
            count("small steps a tick", worn.substeps()),
            count("detections", worn.separation().detections as usize),
        ],
        counters: Some(worn.counters),
        hash: one_hash(scene_name, &hashes)?,
    })
}
