//! Maps in two parameters: what works, how the rest fails, and where the edge was foretold to be.
//!
//! ```text
//! Map ─► for each x a Stack (a forecast, and an attempt at any y) ─► Column: outcomes of all cells, the edge
//!                                                                     bisected between two of them
//! Survey ─► columns on all processors ─► MapStore: finished columns, kept at once
//! ```
//! In each column the easy end of `y` is at the bottom. The edge is that before the first cell that fails
//! from there; what works again beyond is in the map, but not asked of a forecast.

mod axis;
mod column;
mod edge;
mod ground;
mod landing;
mod loops;
mod methods;
mod outcome;
mod survey;
mod tell;
mod yielding;

pub use axis::Axis;
pub use column::{Column, Foretold, Map, Stack};
pub(super) use edge::edge;
pub use ground::should_stand;
pub use landing::should_land;
pub use loops::loop_maps;
pub use methods::method_maps;
pub use outcome::{Failure, Outcome};
pub use survey::survey;
pub use tell::{glance, significant, tally, tell};
pub use yielding::floor_maps;

use super::TreeProblemError;

/// Every map, with so many cells a side.
///
/// # Errors
/// Never for the scenes as shipped: a test makes them all.
pub fn maps(cells: usize) -> Result<Vec<Map>, TreeProblemError> {
    let mut all = floor_maps(cells)?;
    all.extend(method_maps(cells)?);
    all.extend(loop_maps(cells)?);
    Ok(all)
}
