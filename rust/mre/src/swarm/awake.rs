//! Threads that stay awake from generation to generation.

use std::hint::spin_loop;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use rayon::Yield;

/// Looks for work after which a thread lets others have the processor.
const PATIENCE: u32 = 64;
/// The job waits so long for the other threads to wake up.
const WAKING: Duration = Duration::from_millis(1);

/// Do a job on this thread of a pool, while the pool's other threads look for shares of it and never sleep.
///
/// A generation of a fast fitness is over before a sleeping thread has woken up. Outside a pool the job is just done.
pub fn awake<R: Send>(job: impl FnOnce() -> R + Send) -> R {
    let Some(home) = rayon::current_thread_index() else { return job() };
    let others = rayon::current_num_threads() - 1;
    let (over, begun, ready) = (AtomicBool::new(false), AtomicBool::new(false), AtomicUsize::new(0));
    rayon::in_place_scope(|scope| {
        let (_over, over, begun, ready) = (Over(&over), &over, &begun, &ready);
        scope.spawn_broadcast(move |_, context| {
            // Later, this thread may be at a share of the job, which would then wait for the end of the job.
            if context.index() != home && !begun.load(Ordering::SeqCst) {
                ready.fetch_add(1, Ordering::SeqCst);
                look_for_work(over);
            }
        });
        let asked = Instant::now();
        while ready.load(Ordering::SeqCst) < others && asked.elapsed() < WAKING {
            std::thread::yield_now();
        }
        begun.store(true, Ordering::SeqCst);
        job()
    })
}

fn look_for_work(over: &AtomicBool) {
    let mut idle = 0;
    while !over.load(Ordering::Relaxed) {
        if rayon::yield_now() == Some(Yield::Executed) {
            idle = 0;
        } else if idle < PATIENCE {
            idle += 1;
            spin_loop();
        } else {
            idle = 0;
            std::thread::yield_now();
        }
    }
}

/// Lets the others go also where the job panics: the scope waits for them.
struct Over<'a>(&'a AtomicBool);

impl Drop for Over<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

#[cfg(test)]
#[allow(clippy::expect_used)]
mod tests {
    use std::panic::{AssertUnwindSafe, catch_unwind};

    use super::*;

    fn on<R: Send>(threads: usize, job: impl FnOnce() -> R + Send) -> R {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.expect("a pool").install(job)
    }

    fn sum(from: u64, to: u64) -> u64 {
        if to - from < 4 {
            return (from..to).sum();
        }
        let middle = u64::midpoint(from, to);
        let (left, right) = rayon::join(|| sum(from, middle), || sum(middle, to));
        left + right
    }

    #[test]
    fn shared_work_is_done_on_any_number_of_threads() {
        for threads in [1, 2, 5] {
            assert!(on(threads, || awake(|| (0..200).all(|_| sum(0, 1000) == 499_500))), "{threads}");
        }
        assert_eq!(awake(|| 7), 7);
    }

    #[test]
    fn a_panic_lets_the_others_go() {
        let broken = on(3, || catch_unwind(AssertUnwindSafe(|| awake(|| assert_eq!(sum(0, 100), 1)))));
        assert!(broken.is_err());
        assert_eq!(on(3, || awake(|| sum(0, 100))), 4950);
    }
}
