//! Screenshots.

use std::path::Path;

/// Red, green and blue of each pixel.
pub struct Picture {
    pub pixels: Vec<[u8; 3]>,
}

impl Picture {
    pub fn read(path: &Path) -> Self {
        let file = std::fs::File::open(path).expect("chromium has written a screenshot");
        let mut decoder = png::Decoder::new(std::io::BufReader::new(file));
        decoder.set_transformations(png::Transformations::normalize_to_color8());
        let mut reader = decoder.read_info().expect("PNG");
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size that fits memory")];
        let info = reader.next_frame(&mut bytes).expect("a picture");
        let channels = info.color_type.samples();
        let pixels = bytes[..info.buffer_size()]
            .chunks(channels)
            .map(|pixel| [pixel[0], pixel[1], pixel[2]])
            .collect();
        Self { pixels }
    }

    /// How many pixels are of a colour.
    pub fn count(&self, is: impl Fn([u8; 3]) -> bool) -> usize {
        self.pixels.iter().filter(|pixel| is(**pixel)).count()
    }

    /// How many pixels differ plainly from those of another picture of the same size.
    pub fn difference(&self, other: &Self) -> usize {
        assert_eq!(self.pixels.len(), other.pixels.len(), "pictures of one size");
        let plainly =
            |(a, b): &(&[u8; 3], &[u8; 3])| a.iter().zip(*b).any(|(x, y)| x.abs_diff(*y) > 40);
        self.pixels.iter().zip(&other.pixels).filter(plainly).count()
    }
}

/// The blue of the central body, in any light.
pub fn is_body(pixel: [u8; 3]) -> bool {
    is_shade(pixel, [0, 114, 178])
}

/// The purple of a block.
pub fn is_block(pixel: [u8; 3]) -> bool {
    is_shade(pixel, [204, 121, 167])
}

/// A colour times some brightness.
fn is_shade(pixel: [u8; 3], color: [u8; 3]) -> bool {
    let sum = |c: [u8; 3]| c.iter().map(|x| f64::from(*x)).sum::<f64>();
    let light = sum(pixel) / sum(color);
    let near = |(x, y): (&u8, &u8)| (f64::from(*x) - light * f64::from(*y)).abs() < 6.0;
    (0.4..1.2).contains(&light) && pixel.iter().zip(&color).all(near)
}
