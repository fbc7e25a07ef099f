//! USDZ: a zip of files that are not compressed and begin at multiples of 64 bytes, the scene first.

use std::io::{Cursor, Write as _};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, ZipWriter};

use super::UsdError;

/// What the content of each file begins at a multiple of, bytes.
const ALIGNMENT: u16 = 64;
/// Bytes that a file takes besides its own, at most: alignment, two headers, and its name in both.
const ROOM: usize = 1024;

/// Packs `files`, each a path with slashes and its content.
///
/// # Errors
/// They are more than 4 GiB.
pub(super) fn package<'a>(
    files: impl Iterator<Item = (&'a str, &'a [u8])> + Clone,
) -> Result<Vec<u8>, UsdError> {
    let size: usize = files.clone().map(|(_, bytes)| bytes.len() + ROOM).sum();
    if u32::try_from(size).is_err() {
        return Err(UsdError::TooLarge);
    }
    packed(files, size).map_err(|why| UsdError::Package(why.to_string()))
}

fn packed<'a>(
    files: impl Iterator<Item = (&'a str, &'a [u8])>,
    size: usize,
) -> Result<Vec<u8>, zip::result::ZipError> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::with_capacity(size)));
    // The same scene gives the same bytes: files carry no time.
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(DateTime::default())
        .with_alignment(ALIGNMENT);
    for (name, bytes) in files {
        zip.start_file(name, options)?;
        zip.write_all(bytes)?;
    }
    Ok(zip.finish()?.into_inner())
}

#[cfg(test)]
mod tests {
    use std::io::Read as _;

    use zip::ZipArchive;

    use super::*;

    #[test]
    fn every_file_is_stored_at_a_multiple_of_64() {
        let files: Vec<(String, Vec<u8>)> =
            (0..70).map(|i| (format!("textures/{}.png", "n".repeat(i + 1)), vec![i as u8; 3 * i])).collect();
        let bytes = package(files.iter().map(|(name, bytes)| (name.as_str(), bytes.as_slice())));
        let bytes = bytes.expect("a package");
        let mut zip = ZipArchive::new(Cursor::new(&bytes)).expect("a zip");
        assert_eq!(zip.len(), files.len());
        for (i, (name, content)) in files.iter().enumerate() {
            let mut file = zip.by_index(i).expect("a file");
            assert_eq!(file.name().expect("a name"), name.as_str());
            assert_eq!(file.compression(), CompressionMethod::Stored);
            assert_eq!(file.data_start().expect("a place") % 64, 0, "{name}");
            let mut found = Vec::new();
            file.read_to_end(&mut found).expect("its content");
            assert_eq!(&found, content);
        }
    }
}
