//! The pictures of the samples on the start page show them dressed. With `TOILE_UPDATE_ASSETS=1` they are drawn anew.

use std::path::PathBuf;

use image::RgbaImage;
use toile::session::samples::Sample;

use crate::program::{Place, adapter_required};

/// Width and height, pixels.
const SIZE: (u32, u32) = (320, 400);
/// Largest mean difference of a channel: drivers round differently.
const CLOSE: f64 = 4.0;

fn path(sample: Sample) -> PathBuf {
    let name = format!("assets/samples/{}.png", sample.file_stem());
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// The sample as it is dressed now, as PNG; None without a graphics adapter.
fn drawn(sample: Sample) -> Option<Vec<u8>> {
    let place = Place::new();
    let name = sample.file_stem();
    place.ends(0, &format!("dress sample:{name} --no-picture --out out --save worn.toile"));
    let ended = place.draws(
        "render worn.toile -o picture.png --size 320x400 --transparent --view three-quarter --supersample 2",
    );
    if ended.code == 5 && !adapter_required() {
        return None;
    }
    assert_eq!(ended.code, 0, "{}", ended.err);
    Some(std::fs::read(place.path("picture.png")).expect("a picture"))
}

fn difference(a: &RgbaImage, b: &RgbaImage) -> f64 {
    let sum: f64 = a.iter().zip(b.iter()).map(|(a, b)| f64::from(a.abs_diff(*b))).sum();
    sum / a.len() as f64
}

#[test]
fn every_sample_has_its_picture() {
    for sample in Sample::ALL {
        if std::env::var_os("TOILE_UPDATE_ASSETS").is_some() {
            let bytes = drawn(sample).expect("a graphics adapter");
            std::fs::write(path(sample), bytes).expect("written");
        }
        let kept = image::open(path(sample)).unwrap_or_else(|why| panic!("{sample:?}: {why}")).to_rgba8();
        assert_eq!(kept.dimensions(), SIZE, "{sample:?}");
        assert_eq!(kept.get_pixel(0, 0).0[3], 0, "{sample:?} has no background");
        if sample == Sample::Skirt
            && let Some(now) = drawn(sample)
        {
            let now = image::load_from_memory(&now).expect("a picture").to_rgba8();
            let apart = difference(&kept, &now);
            assert!(apart < CLOSE, "{sample:?} looks otherwise now: {apart}");
        }
    }
}
