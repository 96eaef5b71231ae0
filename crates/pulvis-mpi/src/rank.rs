//! A rank that is a process of MPI.
//!
//! Messages are arrays of doubles: derived types take several times as long (`dependencies.md` of the design notes: 163 µs
//! against 48 µs for a thousand rows with Open MPI, 1296 against 34 with MPICH). Nothing waits within MPI: a rank asks
//! again and again whether a message is there, so that it can give up.

use std::mem::MaybeUninit;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use std::thread::ThreadId;
use std::time::{Duration, Instant};

use mpi::Threading;
use mpi::environment::Universe;
use mpi::ffi;
use mpi::traits::{AsRaw, Communicator};
use pulvis_parallel::exchange::{Exchange, ExchangeError, Message, PATIENCE, Waiting};

use crate::launched_ranks;

/// The tag of all messages: those between two ranks come in their order.
const TAG: i32 = 1;

/// How often a rank asks for a message before it lets others have the processor, and before it sleeps in between.
const SPINS: u32 = 2000;
const YIELDS: u32 = 20_000;
const NAP: Duration = Duration::from_micros(200);

static RANK: OnceLock<Arc<MpiRank>> = OnceLock::new();

/// The process as a rank.
struct MpiRank {
    universe: Universe,
    rank: usize,
    ranks: usize,
    /// MPI is told that only one thread calls it.
    thread: ThreadId,
    /// Whether another rank was lost: then there is no end in order.
    has_lost: AtomicBool,
}

impl std::fmt::Debug for MpiRank {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "rank {} of {} of MPI", self.rank, self.ranks)
    }
}

// SAFETY: the handles in it are used by one thread only, which `check_thread` sees to.
unsafe impl Send for MpiRank {}
// SAFETY: as above.
unsafe impl Sync for MpiRank {}

/// This process as one of several ranks; `None` where it is the only one. To be called on the thread that will advance the
/// simulation.
///
/// # Errors
/// MPI cannot be used.
pub fn exchange() -> Result<Option<Arc<dyn Exchange>>, String> {
    if launched_ranks().is_none_or(|ranks| ranks < 2) {
        return Ok(None);
    }
    let (universe, threading) = mpi::initialize_with_threading(Threading::Funneled)
        .ok_or("MPI has been initialised before, or cannot be")?;
    if threading < Threading::Funneled {
        return Err("this MPI library cannot be used by programs with several threads".to_owned());
    }
    let world = universe.world();
    let (rank, ranks) = (world.rank() as usize, world.size() as usize);
    let launched = launched_ranks().unwrap_or(ranks);
    if ranks != launched {
        return Err(format!(
            "{launched} processes were started, but the MPI library of this program knows of {ranks}; start it with the launcher of the library that it was built with"
        ));
    }
    let thread = std::thread::current().id();
    let rank = Arc::new(MpiRank { universe, rank, ranks, thread, has_lost: AtomicBool::new(false) });
    Ok(Some(Arc::clone(RANK.get_or_init(|| rank)) as Arc<dyn Exchange>))
}

/// Leaves MPI, as the last thing that the process does. If another rank was lost, all that are left are ended with exit
/// code 1.
pub fn finish() {
    let Some(rank) = RANK.get() else { return };
    if rank.has_lost.load(Ordering::Relaxed) {
        rank.universe.world().abort(1);
    }
    // SAFETY: nobody uses MPI after this; the universe, which would do the same when it is dropped, is in a static and is
    // not.
    unsafe { ffi::MPI_Finalize() };
}

/// A message on its way: MPI uses the memory until the request is done.
struct Sending(ffi::MPI_Request);

impl MpiRank {
    fn check_thread(&self) -> Result<(), ExchangeError> {
        if std::thread::current().id() == self.thread {
            return Ok(());
        }
        Err(ExchangeError { reason: "another thread than the first one calls MPI".to_owned() })
    }

    fn communicator(&self) -> ffi::MPI_Comm {
        self.universe.world().as_raw()
    }

    /// Waits until `is_done`.
    fn wait(
        &self,
        rank: Option<usize>,
        waiting: Waiting,
        mut is_done: impl FnMut() -> bool,
    ) -> Result<(), ExchangeError> {
        let mut rounds = 0_u32;
        let mut began = None;
        while !is_done() {
            rounds = rounds.saturating_add(1);
            if rounds <= SPINS {
                std::hint::spin_loop();
                continue;
            }
            if rounds <= YIELDS {
                std::thread::yield_now();
            } else {
                std::thread::sleep(NAP);
            }
            let began = *began.get_or_insert_with(Instant::now);
            if waiting == Waiting::ForWork && began.elapsed() > PATIENCE {
                self.has_lost.store(true, Ordering::Relaxed);
                let who = rank.map_or("a rank".to_owned(), |rank| format!("rank {rank}"));
                return Err(ExchangeError { reason: format!("{who} is lost: it does not answer") });
            }
        }
        Ok(())
    }

    fn send(&self, to: usize, message: &[f64]) -> Result<Sending, ExchangeError> {
        let count = count_of(message.len())?;
        let mut request = MaybeUninit::uninit();
        // SAFETY: the message lives until the request is done; where a rank is lost and nobody waits for it any more, MPI is
        // not called again but to end the process.
        unsafe {
            let (start, double) = (message.as_ptr().cast(), ffi::RSMPI_DOUBLE);
            ffi::MPI_Isend(start, count, double, to as i32, TAG, self.communicator(), request.as_mut_ptr());
            Ok(Sending(request.assume_init()))
        }
    }

    fn receive(&self, from: usize, waiting: Waiting) -> Result<Message, ExchangeError> {
        let (mut found, mut message) = (0, MaybeUninit::uninit());
        let mut status = MaybeUninit::uninit();
        self.wait(Some(from), waiting, || {
            // SAFETY: all pointers are to live variables.
            unsafe {
                let (comm, place) = (self.communicator(), message.as_mut_ptr());
                ffi::MPI_Improbe(from as i32, TAG, comm, &mut found, place, status.as_mut_ptr());
            }
            found != 0
        })?;
        let mut count = 0;
        // SAFETY: a message was found, of so many doubles, and the numbers live until it is received.
        unsafe {
            let mut message = message.assume_init();
            let double = ffi::RSMPI_DOUBLE;
            ffi::MPI_Get_count(status.as_ptr(), double, &mut count);
            let mut numbers = vec![0.0; count as usize];
            let start = numbers.as_mut_ptr();
            ffi::MPI_Mrecv(start.cast(), count, double, &mut message, ffi::RSMPI_STATUS_IGNORE);
            Ok(numbers)
        }
    }

    /// Waits until a message has been sent.
    fn finish_sending(&self, sending: Sending, to: usize, waiting: Waiting) -> Result<(), ExchangeError> {
        let Sending(mut request) = sending;
        self.wait(Some(to), waiting, || is_done(&mut request))
    }
}

fn is_done(request: &mut ffi::MPI_Request) -> bool {
    let mut done = 0;
    // SAFETY: a request that was begun and is not freed before it is done.
    unsafe { ffi::MPI_Test(request, &mut done, ffi::RSMPI_STATUS_IGNORE) };
    done != 0
}

/// MPI counts with 32 bits.
fn count_of(numbers: usize) -> Result<i32, ExchangeError> {
    i32::try_from(numbers).map_err(|_| ExchangeError {
        reason: format!("a message of {numbers} numbers is longer than MPI can count; use more ranks"),
    })
}

impl Exchange for MpiRank {
    fn rank(&self) -> usize {
        self.rank
    }

    fn ranks(&self) -> usize {
        self.ranks
    }

    fn swap(
        &self,
        outgoing: &[(usize, Message)],
        from: &[usize],
        incoming: &mut Vec<Message>,
        waiting: Waiting,
    ) -> Result<(), ExchangeError> {
        self.check_thread()?;
        let sent: Result<Vec<Sending>, _> =
            outgoing.iter().map(|(rank, message)| self.send(*rank, message)).collect();
        incoming.clear();
        for &rank in from {
            incoming.push(self.receive(rank, waiting)?);
        }
        for (sending, (rank, _)) in sent?.into_iter().zip(outgoing) {
            self.finish_sending(sending, *rank, waiting)?;
        }
        Ok(())
    }

    fn gather(&self, own: &[f64], all: &mut Vec<Message>, waiting: Waiting) -> Result<(), ExchangeError> {
        self.check_thread()?;
        let own_count = count_of(own.len())?;
        let mut counts = vec![0_i32; self.ranks];
        let mut request = MaybeUninit::uninit();
        // SAFETY: the variables live until the request is done, or the process ends.
        let mut request = unsafe {
            let (int, place) = (ffi::RSMPI_INT32_T, counts.as_mut_ptr());
            let comm = self.communicator();
            ffi::MPI_Iallgather(
                (&raw const own_count).cast(),
                1,
                int,
                place.cast(),
                1,
                int,
                comm,
                request.as_mut_ptr(),
            );
            request.assume_init()
        };
        self.wait(None, waiting, || is_done(&mut request))?;
        let mut starts = Vec::with_capacity(self.ranks);
        let mut total = 0_usize;
        for &count in &counts {
            starts.push(count_of(total)?);
            total += count as usize;
        }
        count_of(total)?;
        let mut numbers = vec![0.0_f64; total];
        let mut request = MaybeUninit::uninit();
        // SAFETY: as above.
        let mut request = unsafe {
            let (double, place) = (ffi::RSMPI_DOUBLE, numbers.as_mut_ptr());
            let comm = self.communicator();
            ffi::MPI_Iallgatherv(
                own.as_ptr().cast(),
                own_count,
                double,
                place.cast(),
                counts.as_ptr(),
                starts.as_ptr(),
                double,
                comm,
                request.as_mut_ptr(),
            );
            request.assume_init()
        };
        self.wait(None, waiting, || is_done(&mut request))?;
        all.clear();
        let mut rest = &numbers[..];
        for count in counts {
            let (message, others) = rest.split_at(count as usize);
            all.push(message.to_vec());
            rest = others;
        }
        Ok(())
    }
}
