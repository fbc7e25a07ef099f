//! Whether the program can be trusted with any file: good files are damaged at random, in ways that know their format, and
//! read. Whatever comes in, each is taken or refused in words, soon, and nothing panics.
//!
//! `damage` changes bytes and words, `structure` what the formats are made of, `good` holds what is damaged, `readers` what
//! reads it, `campaign` counts; `commands` are such files, too. `promises` is the table of all that is promised and how it is tested.

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
