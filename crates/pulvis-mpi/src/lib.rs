//! Beside level 2 of the house: ranks that are processes of MPI.
//!
//! Everything that ranks do is in `pulvis-core` and `pulvis-lab`, and is tested there with threads. Here messages go from
//! process to process. Without the feature `mpi` there is nothing but [`launched_ranks`], which tells whether somebody
//! has started several processes.

#[cfg(feature = "mpi")]
mod rank;

#[cfg(feature = "mpi")]
pub use rank::{exchange, finish};

/// What launchers of MPI tell the processes that they start: how many there are. Those of Open MPI, of MPICH and what is
/// made of it, and of Slurm with either.
const SIZES: [&str; 3] = ["OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"];

/// How many processes the launcher of MPI has started, this one among them; `None` if there is no launcher.
pub fn launched_ranks() -> Option<usize> {
    SIZES.iter().find_map(|name| std::env::var(name).ok()?.parse().ok())
}
