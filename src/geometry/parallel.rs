//! How much work a parallel task gets at least. It decides only how items are shared out, never what is computed of each nor in
//! which order results are put together, so that it cannot change them.

/// Items (vertices, triangles, nodes of a tree) for a task: less is not worth being handed to another thread.
pub const LEAST_SHARE: usize = 256;
/// Items for each of which only a few numbers are added up.
pub const LEAST_SUMS: usize = 1024;
/// Items for each of which a tree is searched.
pub const LEAST_SEARCHES: usize = 64;
