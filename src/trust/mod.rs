//! Fuzz tests of file readers: valid files are damaged at random, in ways that know their format, and read. Each must be
//! accepted, or refused with a message, in time, and without a panic.
//!
//! `damage` changes bytes and text, `structure` the parts of each format, `good` holds the valid files, `readers` what reads
//! them, and `campaign` counts the results; `commands` are such files, too. `promises` is the table of all that the program
//! promises and of the tests for it.

mod campaign;
pub mod commands;
mod damage;
pub mod good;
pub mod promises;
mod readers;
mod structure;
mod ticks;

pub use campaign::{SLOW, Tally, damaged, run};
pub use readers::{Reader, readers};
pub use structure::Form;
pub use ticks::go_on;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn good_files_are_taken_and_numbers_tell_damaged_ones() {
        for reader in readers() {
            for good in &reader.good {
                (reader.read)(good).unwrap_or_else(|why| panic!("{}: {why}", reader.name));
            }
            assert_eq!(damaged(&reader, 7), damaged(&reader, 7));
            let others = (0..20).filter(|&number| damaged(&reader, number) != reader.good[0]).count();
            assert!(others > 10, "{}", reader.name);
        }
    }
}
