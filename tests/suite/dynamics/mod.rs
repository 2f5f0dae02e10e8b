//! Chapter 3: kinematics and dynamics of trees.

mod vectors;
