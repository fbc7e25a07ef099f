//! Typed ids. The document that owns them counts them up, and none is used twice.

macro_rules! typed_id {
    ($(#[$doc:meta])* $name:ident, $word:literal) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize)]
        #[serde(transparent)]
        pub struct $name(pub u32);

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(f, concat!($word, " {}"), self.0)
            }
        }
    };
}

typed_id!(
    /// A flat piece of cloth.
    PieceId, "piece"
);
typed_id!(
    /// A seam between two edges.
    SeamId, "seam"
);
typed_id!(
    /// A button with its buttonhole.
    ButtonId, "button"
);
typed_id!(
    /// A stroke on cloth or body.
    MarkId, "mark"
);
typed_id!(
    /// An image of a document.
    ImageId, "image"
);
typed_id!(
    /// An image placed on a piece.
    GraphicId, "graphic"
);
typed_id!(
    /// A pushpin.
    PinId, "pin"
);
