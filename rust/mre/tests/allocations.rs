//! Iterations of the swarms do not allocate once their buffers have grown, with the compressed kernel on
//! one thread.
#![allow(missing_docs, clippy::unwrap_used)]
#![allow(unsafe_code)] // an allocator that counts

mod common;

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::sync::atomic::AtomicBool;

use common::{Trial, problem, with_threads};
use mre::fitness::{Problem, Weights};
use mre::swarm::{
    Budget, FishSettings, FishSwarm, Neighbourhood, OfProblem, ParticleSwarm, PsoSettings, Schedule, Search,
    Swarm, run,
};

struct Counting;

thread_local! {
    /// Allocations of this thread.
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

fn count() {
    ALLOCATIONS.set(ALLOCATIONS.get() + 1);
}

// SAFETY: everything is handed on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        // SAFETY: as the caller promises.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as the caller promises.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        // SAFETY: as the caller promises.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn fish(iterations: usize, search: Search, neighbourhood: Neighbourhood) -> FishSettings {
    let plain = FishSettings::mafsa(iterations);
    let schedule = match neighbourhood {
        Neighbourhood::Swarm => plain.schedule,
        Neighbourhood::Visual => Schedule::Constant,
    };
    FishSettings { schedule, neighbourhood, search, ..plain }
}

/// Allocations from the making of a swarm to its end.
fn allocations(problem: &Problem, make: impl Fn() -> Box<dyn Swarm> + Send) -> usize {
    let d = problem.bounds().len();
    let never = AtomicBool::new(false);
    with_threads(1, move || {
        let before = ALLOCATIONS.get();
        let mut swarm = make();
        let mut fitness = OfProblem { problem, cancel: &never };
        run(swarm.as_mut(), &mut fitness, d, &Budget::default(), &mut |_| true);
        ALLOCATIONS.get() - before
    })
}

#[test]
fn allocations_do_not_grow_with_the_iterations() {
    let trial =
        Trial { samples: 1000, stroke: 4.0, truth: [1.1, 13.7, 14.6, 0.3, 1.0], noise: 1e-2, seed: 1 };
    let problem = problem("sinh", &[trial.recording()], &[], &Weights::Samples);
    let kinds = [
        (Search::Best, Neighbourhood::Swarm),
        (Search::Best, Neighbourhood::Visual),
        (Search::Step, Neighbourhood::Swarm),
        (Search::Step, Neighbourhood::Visual),
    ];
    for (search, neighbourhood) in kinds {
        let [short, long] = [300, 900].map(|iterations| {
            let settings = fish(iterations, search, neighbourhood);
            allocations(&problem, move || Box::new(FishSwarm::new(settings.clone(), 5, 1, None).unwrap()))
        });
        assert_eq!(short, long, "{search:?} {neighbourhood:?}");
    }
    let [short, long] = [300, 900].map(|iterations| {
        let settings = PsoSettings {
            particles: 50,
            iterations,
            inertia: [0.9, 0.4],
            cognitive: 2.0,
            social: 2.0,
            speed: 0.2,
        };
        allocations(&problem, move || Box::new(ParticleSwarm::new(settings.clone(), 5, 1, None).unwrap()))
    });
    assert_eq!(short, long, "particles");
}
