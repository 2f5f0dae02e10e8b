//! The colours of all pictures.

/// Okabe and Ito's colours, which people with any common colour vision can tell apart, darkest
/// first; curves beyond six repeat them dashed.
pub const OKABE_ITO: [(u8, u8, u8); 6] =
    [(0, 0, 0), (213, 94, 0), (0, 114, 178), (0, 158, 115), (204, 121, 167), (230, 159, 0)];
