//! A hash of everything that a result depends on: the bytes of its inputs, the options that can change it, and the version of the
//! program. Names and times of files are not included.

use std::path::{Path, PathBuf};

use crate::cli::arguments::{Dress, InputOptions};
use crate::cli::failure::Failure;
use crate::cli::files;
use crate::session::recording::Hex;
use crate::sim::hash::Fnv;

/// The hash of dressing `project` with `arguments`.
pub fn made_from(project: &Path, arguments: &Dress) -> Result<String, Failure> {
    let Dress {
        projects: _,
        list: _,
        shard: _,
        out: _,
        input:
            InputOptions {
                body,
                body_file,
                sized,
                grade,
                pose,
                over,
                raise,
                as_placed,
                scale,
                marks,
                suggest_marks,
                edge_length,
            },
        start,
        drape,
        card,
        cloth,
        save,
        record: _,
        max_ticks,
        picture,
        no_picture,
        work,
        resume: _,
        progress: _,
        json: _,
        threads: _,
    } = arguments;
    let placed = (raise, as_placed, grade);
    let of_input = (body_file, &sized.body_size, pose, over.len(), placed, scale, suggest_marks, edge_length);
    let mut cloth = cloth.clone();
    cloth.art.image_file_mut().into_iter().for_each(PathBuf::clear);
    cloth.art.graphic_files_mut().for_each(PathBuf::clear);
    let art = &arguments.cloth.art;
    let options =
        (of_input, start, (drape, card), cloth, save.is_some(), max_ticks, picture, no_picture, work);
    let mut hash = Fnv::default();
    let mut take = |bytes: &[u8]| {
        hash.number(bytes.len() as u64);
        hash.bytes(bytes);
    };
    take(env!("CARGO_PKG_VERSION").as_bytes());
    take(format!("{options:?}").as_bytes());
    take(&files::bytes_of(project)?);
    if let Some(rules) = files::rules_beside(project)? {
        take(&rules);
    }
    for file in [body.as_ref(), sized.sizes.as_ref(), marks.as_ref()].into_iter().chain(over.iter().map(Some))
    {
        match file {
            Some(path) => take(&files::bytes_of(path)?),
            None => take(&[]),
        }
    }
    for file in art.files() {
        take(&files::bytes_of(file)?);
    }
    Ok(Hex(hash.finish()).to_string())
}
