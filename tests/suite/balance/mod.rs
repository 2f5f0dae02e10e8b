//! Chapter 4: the balance controller.

mod vectors;
