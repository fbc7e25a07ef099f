//! Physics of cloth against exact answers.

mod bends;
mod capstan;
mod card;
mod crossings;
mod cusick;
mod elastic;
mod floor;
mod folds;
mod inflates;
mod meshes;
mod moves;
mod orders;
mod panels;
mod patches;
mod piping;
mod reference;
mod rests;
mod slips;
mod springs;
mod stability;
mod wrinkles;
