//! Exact answers of wrapping, relaxing and walking (B11 to B13, B15, B20, B21), and what must not change with size or place.

mod exact;
#[path = "answers/geodesics.rs"]
mod geodesics;
#[path = "answers/relaxation.rs"]
mod relaxation;
#[path = "answers/root_edges.rs"]
mod root_edges;
#[path = "answers/shapes.rs"]
mod shapes;
#[path = "answers/similar.rs"]
mod similar;
#[path = "answers/wraps.rs"]
mod wraps;
