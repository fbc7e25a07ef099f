//! Alpha of pictures: premultiplied on the device, straight in files.

/// A picture drawn with [`Look::cut_out`](super::Look::cut_out), converted from premultiplied to straight alpha as image files have it.
pub fn straightened(mut picture: image::RgbaImage) -> image::RgbaImage {
    for pixel in picture.pixels_mut() {
        let [r, g, b, a] = pixel.0;
        if a > 0 {
            let straight = |c: u8| ((u32::from(c) * 255 + u32::from(a) / 2) / u32::from(a)).min(255) as u8;
            pixel.0 = [straight(r), straight(g), straight(b), a];
        }
    }
    picture
}
