//! Exact answers of wrapping, relaxing and walking (B11 to B13, B15, B20, B21), and what must not change with size or place.

mod geodesics;
mod relaxation;
mod root_edges;
mod shapes;
mod similar;
mod wraps;
