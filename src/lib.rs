//! # Toile: map of the code
//!
//! A flat pattern and a body go in; numbered marks say where the cloth goes; a dressed garment comes out.
//!
//! ```text
//! cli, ui → session → sim → {wrap, drag, drape, repose} → relax → contact → {cloth, body} → pattern → geometry
//!             └───────┴ place → wrap
//! ```
//!
//! | folder | holds | may use |
//! | --- | --- | --- |
//! | `geometry` | ids, curves, meshes and adjacency, sparse factorisation and conjugate gradients, seeded random numbers, how much a parallel task gets, words that any language can say; nothing about cloth | nothing of ours |
//! | `pattern`  | the flat garment: piece, seam, trims (folds, elastic, stitches, wrinkles), buttons, tacks and zips, bows, edges cut for sewing, editing that keeps seam lengths and symmetry, grading to sizes, triangulation, problems a person can fix | geometry |
//! | `body`     | surface (nearest point, ray, walk), import checks, mannequin, skeleton, poses, bones, landmarks, measurements | geometry |
//! | `cloth`    | the sewn garment as solvers see it: topology and rest shape, moving state; fabrics; the shapes of trims on it | pattern, geometry |
//! | `contact`  | collision of cloth with the body, its bones and itself; edges split where they would cut the body | cloth, body, geometry |
//! | `relax`    | paper A's relaxation: shape matching, flattening, gravity, friction; no physics (see `drape`) | contact, cloth, body, geometry |
//! | `wrap`     | paper A: marks, root edges, growth, tubes round limbs | relax, contact, cloth, body, pattern, geometry |
//! | `drag`     | paper A: dependency graph, motion in local frames, pushpins | relax, contact, cloth, body, pattern, geometry |
//! | `card`     | small steps of cloth with contact on a graphics card: compute shaders, plain buffers in, positions out | geometry |
//! | `drape`    | physics: forces (membrane, bending, folds, elastic), contact, solvers (implicit steps, small steps, direct equilibrium); a garment on its body, on a graphics card where one may be used; sewing | card, contact, cloth, body, geometry |
//! | `repose`   | paper C: distance map, conforming to another pose of the body, recovery, strain limiting | relax, contact, cloth, body, pattern, geometry |
//! | `place`    | placement of pieces in space before they are sewn: points round the body, tubes round limbs, a file's placement adapted to another body, sleeves moved to their arms, what turns over folded | wrap, contact, cloth, body, pattern, geometry |
//! | `fit`      | measurements of a garment: strain, self-intersections, openings, the report, maps | contact, cloth, body, pattern, geometry |
//! | `sim`      | owner of the moving state: stages, protocol, checkpoints, thread, state hash | the above |
//! | `session`  | the user's work: document, commands, history, recording, replay, project file, recovery; samples | sim and below, place, io, draft |
//! | `draft`    | garments of our own, drawn from a seed and drafted to the mannequin's measurements: parts, designs, body sizes, the corpus | body, pattern, geometry |
//! | `io`       | obj, gltf, usd, bvh, pictures; patterns as garmentcode json, dxf with grade rules, svg, pdf: bytes in, checked data out, and back | cloth, body, pattern, geometry |
//! | `language` | the texts and numbers of window and pages in other languages | geometry |
//! | `marker`   | all pieces of garments laid out on a width of cloth: nesting, yield and consumption, the files to cut from | io, language, pattern, geometry |
//! | `pack`     | the tech pack: what a garment maker needs to know, measured, and its pages | session and below, marker, language |
//! | `render`   | plain buffers in, pixels out: camera, passes, offscreen target | nothing of ours |
//! | `trust`    | fuzz tests: files damaged at random, and the readers that must withstand them | session and below |
//! | `manual`   | what the program does, topic by topic, for the window and the command line | nothing of ours |
//! | `ui`       | egui: app, actions, panes, tools | session and below, place, marker, language, pack, render, manual |
//! | `cli`      | one file per subcommand: arguments, calls, printing | session and below, draft, place, marker, language, pack, render, trust, manual, ui |
//!
//! Invariants:
//! - Metres, radians, seconds; right-handed, y up, bodies face +z. Pattern planes have y up, with the front of the cloth towards
//!   the viewer.
//! - `geometry` and `render` use nothing of ours. `pattern` and `body` do not use each other.
//! - `sim` never uses `session`: a request carries a garment source, never the document.
//! - egui only in `ui`; wgpu only in `render`, `card` and `ui`; threads only in `sim::thread` (and rayon inside steps, and beside
//!   them in `cli::graphics`), and the one that waits for signals in `cli::interrupt`.
//! - No clock, no unseeded randomness, no hash-map iteration in `session`, `sim` or below, nor in `marker` and `pack`.
//! - Same input, same bits, on any number of threads.
//! - What is tuned in `contact`, `relax`, `wrap`, `place`, `drape` and `repose` is little, and says why it is what it is.
//!
//! `tests/tidy` checks these rules.

pub mod body;
pub mod card;
pub mod cli;
pub mod cloth;
pub mod contact;
pub mod draft;
pub mod drag;
pub mod drape;
pub mod fit;
pub mod geometry;
pub mod io;
pub mod language;
pub mod manual;
pub mod marker;
pub mod pack;
pub mod pattern;
pub mod place;
pub mod relax;
pub mod render;
pub mod repose;
pub mod session;
pub mod sim;
pub mod trust;
pub mod ui;
pub mod wrap;
