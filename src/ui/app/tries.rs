//! Detects failed starts: after three in a row the next one does without what may be the cause.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use crate::ui::files;

/// Number of failed starts in a row after which the next is a plain one.
const MOST_FAILED: u32 = 3;
/// Time after which an open window counts as a successful start.
pub const STARTED: Duration = Duration::from_secs(3);
/// Message of a plain start.
pub const PLAIN: &str = "Toile did not get far the last times it was started. This time it draws with the processor where it can, \
                     and does without your preferences and recent files; they are still there, and back with the next start.";

/// Counts starts in a file until one is known to have succeeded.
#[derive(Debug)]
pub struct Starts {
    file: PathBuf,
    failed: u32,
}

impl Starts {
    /// Counts a start in `folder`. A count that cannot be read is 0; one that cannot be written is ignored.
    pub fn begin(folder: &Path) -> Self {
        let file = folder.join("starts");
        let failed = std::fs::read_to_string(&file).ok().and_then(|n| n.trim().parse().ok()).unwrap_or(0);
        let count = format!("{}\n", u32::saturating_add(failed, 1));
        let written = std::fs::create_dir_all(folder)
            .map_err(|why| format!("{}: {why}", folder.display()))
            .and_then(|()| files::write(&file, count.as_bytes()));
        if let Err(why) = written {
            tracing::warn!("{why}");
        }
        Self { file, failed }
    }

    /// Whether this is a plain start: without preferences, old thumbnails and the graphics card.
    pub fn is_plain(&self) -> bool {
        self.failed >= MOST_FAILED
    }

    /// Notes that this start has succeeded.
    pub fn well(&self) {
        if let Err(why) = std::fs::remove_file(&self.file) {
            tracing::debug!("{}: {why}", self.file.display());
        }
    }
}

/// Makes `options` prefer a software adapter, whose driver is the least likely to fail.
pub fn prefer_processor(options: &mut eframe::NativeOptions) {
    if let egui_wgpu::WgpuSetup::CreateNew(setup) = &mut options.wgpu_options.wgpu_setup {
        setup.native_adapter_selector = Some(Arc::new(|adapters, surface| {
            let shows = |a: &&wgpu::Adapter| surface.is_none_or(|surface| a.is_surface_supported(surface));
            let is_processor = |a: &&wgpu::Adapter| a.get_info().device_type == wgpu::DeviceType::Cpu;
            let able = || adapters.iter().filter(shows);
            able()
                .find(is_processor)
                .or_else(|| able().next())
                .cloned()
                .ok_or_else(|| "no adapter can show the window".to_owned())
        }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn after_three_starts_that_failed_the_next_is_plain_until_one_succeeds() {
        let folder = tempfile::tempdir().expect("a folder");
        let deep = folder.path().join("state/toile");
        let plain: Vec<bool> = (0..5).map(|_| Starts::begin(&deep).is_plain()).collect();
        assert_eq!(plain, [false, false, false, true, true]);
        Starts::begin(&deep).well();
        assert!(!Starts::begin(&deep).is_plain());
        std::fs::write(deep.join("starts"), "\u{0}three").expect("written");
        assert!(!Starts::begin(&deep).is_plain(), "what cannot be read counts for nothing");
        // Where nothing can be kept, a start is a start.
        std::fs::write(folder.path().join("file"), "").expect("written");
        let nowhere = Starts::begin(&folder.path().join("file"));
        assert!(!nowhere.is_plain());
        nowhere.well();
    }
}
