//! How much an input file may ask for.

/// Bytes that a file from elsewhere may have.
pub const FILE_BYTES: u64 = 512 << 20;

/// Bounds on untrusted input. What exceeds one is refused before memory is spent on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Bytes of one file.
    pub file_bytes: usize,
    /// Bytes of one line of text.
    pub line_bytes: usize,
    /// Vertices of one mesh.
    pub vertices: usize,
    /// Triangles of one mesh.
    pub faces: usize,
    /// Pieces of one pattern.
    pub pieces: usize,
    /// Shapes and texts of one DXF drawing.
    pub dxf_entities: usize,
    /// Numbers and texts of one shape of a DXF drawing.
    pub dxf_tags: usize,
    /// Blocks inside blocks.
    pub block_depth: usize,
    /// Elements of one SVG drawing.
    pub svg_nodes: usize,
    /// Elements of an SVG drawing inside each other.
    pub svg_depth: usize,
    /// Lines and curves of one drawing.
    pub path_segments: usize,
    /// Closed lines of one drawing.
    pub contours: usize,
    /// Corners of one face.
    pub face_corners: usize,
    /// Groups, objects and materials together.
    pub groups: usize,
    /// Bytes of one name.
    pub name_bytes: usize,
    /// Absolute value of a body's coordinate, metres.
    pub coordinate: f64,
    /// Absolute value of a pattern's coordinate, metres.
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
