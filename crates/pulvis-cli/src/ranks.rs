//! This process as one of several ranks of MPI.

use std::sync::Arc;

use pulvis_parallel::exchange::Exchange;

use crate::failure::Failure;

/// The other ranks, where `mpirun` has started several processes.
///
/// # Errors
/// MPI cannot be used, or this program was built without.
pub fn exchange() -> Result<Option<Arc<dyn Exchange>>, Failure> {
    #[cfg(feature = "mpi")]
    return pulvis_mpi::exchange().map_err(|problem| Failure::while_running(format!("MPI: {problem}")));
    #[cfg(not(feature = "mpi"))]
    match pulvis_mpi::launched_ranks() {
        Some(ranks) if ranks > 1 => Err(Failure::bad_input(format!(
            "{ranks} processes were started, but this `pulvis` was built without MPI: each would do the same run; build it with `cargo build --release -p pulvis-cli --features mpi`, or start one process with `--threads N`"
        ))),
        _ => Ok(None),
    }
}

/// Leaves MPI, as the last thing that the process does.
pub fn finish() {
    #[cfg(feature = "mpi")]
    pulvis_mpi::finish();
}
