//! Geometry that knows nothing of cloth: meshes, adjacency, spatial trees, sparse factors, walks, winding numbers; seeded random
//! numbers; how parallel work is shared out; small solids that are only looked at; names as a person types them; and words for a
//! person that can be said in any language.

pub mod adjacency;
pub mod barycentric;
pub mod borders;
pub mod bvh;
pub mod bvh4;
pub mod conjugate_gradients;
pub mod crossings;
pub mod disjoint_sets;
pub mod factor;
pub mod ids;
pub mod mesh;
pub mod names;
pub mod orient;
pub mod parallel;
pub mod polygon;
pub mod problem;
pub mod random;
pub mod rebuild;
pub mod shapes;
pub mod solid;
pub mod walk;
pub mod wide;
pub mod winding;
pub mod words;
