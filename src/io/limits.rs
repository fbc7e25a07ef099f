//! Upper bounds on the size of input files and their contents.

/// Largest size of an input file, bytes.
pub const FILE_BYTES: u64 = 512 << 20;

/// Upper bounds on the contents of untrusted input. What exceeds one is refused before memory is spent on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Size of one file, bytes.
    pub file_bytes: usize,
    /// Length of one line of text, bytes.
    pub line_bytes: usize,
    /// Number of vertices of one mesh.
    pub vertices: usize,
    /// Number of triangles of one mesh.
    pub faces: usize,
    /// Number of pieces of one pattern.
    pub pieces: usize,
    /// Number of shapes and texts of one DXF drawing.
    pub dxf_entities: usize,
    /// Number of group codes (numbers and texts) of one shape of a DXF drawing.
    pub dxf_tags: usize,
    /// Nesting depth of DXF blocks.
    pub block_depth: usize,
    /// Number of elements of one SVG drawing, with `<use>` references expanded.
    pub svg_nodes: usize,
    /// Nesting depth of the elements of an SVG drawing.
    pub svg_depth: usize,
    /// Number of lines and curves of one drawing.
    pub path_segments: usize,
    /// Number of closed lines of one drawing.
    pub contours: usize,
    /// Number of corners of one face.
    pub face_corners: usize,
    /// Number of objects and groups of one OBJ file.
    pub groups: usize,
    /// Length of one name, bytes.
    pub name_bytes: usize,
    /// Largest absolute coordinate of a body, in the file's unit.
    pub coordinate: f64,
    /// Largest absolute coordinate of a pattern, metres.
    pub pattern_coordinate: f64,
}

impl Default for Limits {
    fn default() -> Self {
        Self {
            file_bytes: FILE_BYTES as usize,
            line_bytes: 1 << 20,
            vertices: 5_000_000,
            faces: 10_000_000,
            pieces: 1000,
            dxf_entities: 1_000_000,
            dxf_tags: 2_000_000,
            block_depth: 16,
            svg_nodes: 200_000,
            svg_depth: 200,
            path_segments: 1_000_000,
            contours: 5000,
            face_corners: 4096,
            groups: 10_000,
            name_bytes: 1024,
            coordinate: 1e6,
            pattern_coordinate: 100.0,
        }
    }
}
