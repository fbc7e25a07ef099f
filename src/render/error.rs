//! Errors of rendering, in words for people.

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// No graphics adapter was found.
    #[error(
        "no graphics adapter was found ({0}). Pictures need Vulkan, Metal, DirectX 12 or OpenGL; on Linux the package \
         mesa-vulkan-drivers brings a software one"
    )]
    NoAdapter(String),
    /// The adapter could not be opened.
    #[error("the graphics adapter {adapter} could not be opened: {reason}")]
    NoDevice {
        /// Name of the adapter.
        adapter: String,
        /// Message of the adapter.
        reason: String,
    },
    /// The picture or a mesh is larger than the adapter can hold.
    #[error("{what} is larger than this graphics adapter can hold ({limit})")]
    TooLarge {
        /// What was asked for.
        what: String,
        /// The limit, with its unit.
        limit: String,
    },
    /// The adapter did not answer within this time.
    #[error("the graphics adapter did not finish the picture within {} seconds", .0.as_secs())]
    Timeout(std::time::Duration),
    /// The adapter reported an error.
    #[error("the graphics adapter reported an error: {0}")]
    Device(String),
    /// The adapter cannot draw depth of field.
    #[error("the graphics adapter {0} draws by OpenGL, which cannot draw depth of field: leave it out")]
    NoDepthOfField(String),
    /// The picture could not be encoded.
    #[error("the picture could not be encoded: {0}")]
    Encode(#[from] image::ImageError),
    /// The text is not the name of a view.
    #[error(
        "unknown view {0:?}: use front, back, left, right, top, below, three-quarter or YAW,PITCH in degrees"
    )]
    UnknownView(String),
}
