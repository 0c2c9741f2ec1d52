//! One folder, one run.

use super::*;
use std::sync::mpsc;

/// Holds a run up once it has begun, until it is told to go on.
struct Held {
    begun: mpsc::SyncSender<()>,
    go_on: std::sync::Mutex<mpsc::Receiver<()>>,
}

impl Progress for Held {
    fn particles(&self, done: u64, _: u64) {
        if done == 0 {
            self.begun.send(()).unwrap();
            self.go_on.lock().unwrap().recv().unwrap();
        }
    }
}

/// Runs a case, and something else while it is at work in its folder.
fn meanwhile(case: &Case, out: &Path, what: impl FnOnce()) -> Result<Summary, RunError> {
    let (begun, has_begun) = mpsc::sync_channel(1);
    let (go, go_on) = mpsc::sync_channel(1);
    std::thread::scope(|scope| {
        let held = Held { begun, go_on: std::sync::Mutex::new(go_on) };
        let first = scope.spawn(move || run(case, &options(out, 2), &held));
        has_begun.recv().unwrap();
        what();
        go.send(()).unwrap();
        first.join().unwrap()
    })
}

#[test]
fn a_second_run_into_one_folder_is_refused_and_the_first_undisturbed() {
    let folder = tempfile::tempdir().unwrap();
    let (out, alone) = (folder.path().join("out"), folder.path().join("alone"));
    let (case, other) = (case(), case_with("impacts = false"));
    run(&case, &options(&alone, 2), &Silent).unwrap();
    let second = || {
        for (resume, force) in [(false, false), (true, false), (false, true)] {
            let error = run(&other, &RunOptions { resume, force, ..options(&out, 2) }, &Silent).unwrap_err();
            assert!(matches!(error, RunError::Busy { .. }), "{error}");
        }
        assert!(matches!(
            merge(std::slice::from_ref(&out), &folder.path().join("merged"), false),
            Err(RunError::Busy { .. })
        ));
    };
    meanwhile(&case, &out, second).unwrap();
    assert_eq!(files(&out), files(&alone));
}

#[test]
fn a_run_is_replaced_only_where_it_is_said_and_leaves_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    let (out, alone) = (folder.path().join("out"), folder.path().join("alone"));
    run(&case(), &options(&out, 2), &Silent).unwrap();
    let before = files(&out);
    let other = case_with("impacts = \"parquet\"\nfates = false\ntrajectories = 0\nvtk = false");
    let error = run(&other, &options(&out, 2), &Silent).unwrap_err().to_string();
    assert!(
        error.contains("holds a finished run") && error.contains("--force") && error.contains("--resume"),
        "{error}"
    );
    assert_eq!(files(&out), before);
    // what is not a run's stays
    fs::write(out.join("notes.txt"), "mine").unwrap();
    run(&other, &RunOptions { force: true, ..options(&out, 2) }, &Silent).unwrap();
    assert_eq!(fs::read_to_string(out.join("notes.txt")).unwrap(), "mine");
    fs::remove_file(out.join("notes.txt")).unwrap();
    run(&other, &options(&alone, 2), &Silent).unwrap();
    assert_eq!(files(&out), files(&alone));
    // a table of unknown origin is not overwritten either
    let strange = folder.path().join("strange");
    fs::create_dir(&strange).unwrap();
    fs::write(strange.join("fates.csv"), "a,b\n").unwrap();
    for resume in [false, true] {
        let error = run(&other, &RunOptions { resume, ..options(&strange, 2) }, &Silent).unwrap_err().to_string();
        assert!(error.contains("fates.csv"), "{error}");
    }
    assert_eq!(fs::read_dir(&strange).unwrap().count(), 1);
}

#[test]
fn resuming_where_nothing_was_written_starts_from_the_beginning() {
    let folder = tempfile::tempdir().unwrap();
    let (out, alone) = (folder.path().join("out"), folder.path().join("alone"));
    run(&case(), &RunOptions { resume: true, ..options(&out, 2) }, &Silent).unwrap();
    run(&case(), &options(&alone, 1), &Silent).unwrap();
    assert_eq!(files(&out), files(&alone));
}

#[test]
fn a_table_taken_away_under_a_run_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["impacts.csv", "fates.csv", "trajectories.cells"] {
        let out = folder.path().join(name);
        let error = meanwhile(&case(), &out, || fs::remove_file(out.join(name)).unwrap()).unwrap_err();
        assert!(matches!(&error, RunError::Gone { path } if path.ends_with(name)), "{error}");
        assert!(!out.join("summary.json").exists());
    }
}

#[test]
fn a_checkpoint_is_believed_only_where_it_is_whole() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    run(&case(), &options(&out, 2), &Silent).unwrap();
    let path = out.join(checkpoint::CHECKPOINT);
    let good = fs::read(&path).unwrap();
    let resume = RunOptions { resume: true, ..options(&out, 2) };
    let state = State::read(&out).unwrap().unwrap();
    let mut bits = crate::random::Stream::new(7, 0, crate::random::Purpose::Injection, 0);
    for _ in 0..500 {
        let mut bad = good.clone();
        let at = (bits.uniform() * bad.len() as f64) as usize;
        bad[at] ^= 1 << (bits.uniform() * 8.0) as u32;
        fs::write(&path, &bad).unwrap();
        assert!(State::read(&out).is_err(), "byte {at}");
    }
    // with a checksum that is right, but against the rest
    let changes: [fn(&mut State); 6] = [
        |s| s.next = s.particles.end + 1,
        |s| s.next -= 1,
        |s| s.summary.injected.count += 1,
        |s| s.summary.fates[0].count += 1,
        |s| s.summary.walls.clear(),
        |s| s.particles.start = 1,
    ];
    for (i, change) in changes.into_iter().enumerate() {
        let mut bad = state.clone();
        change(&mut bad);
        bad.write(&Machine, &out).unwrap();
        let error = run(&case(), &resume, &Silent).unwrap_err();
        assert!(matches!(error, RunError::Foreign { .. }), "{i}: {error}");
    }
    for name in ["impacts.csv", "deposit.vtp"] {
        let mut longer = state.clone();
        *longer.files.get_mut(name).unwrap() += 7;
        longer.write(&Machine, &out).unwrap();
        assert!(run(&case(), &resume, &Silent).unwrap_err().to_string().contains(name));
    }
    state.write(&Machine, &out).unwrap();
    assert_eq!(fs::read(&path).unwrap(), good);
    run(&case(), &resume, &Silent).unwrap();
}

#[test]
fn a_merging_that_fails_leaves_what_was_there() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    for index in [1, 2] {
        let shard = Some(Shard { index, of: 2 });
        run(&case(), &RunOptions { shard, ..options(&at(&index.to_string()), 2) }, &Silent).unwrap();
    }
    let parts = [at("1"), at("2")];
    merge(&parts, &at("whole"), false).unwrap();
    let before = files(&at("whole"));
    assert!(matches!(merge(&parts, &at("whole"), false), Err(RunError::Occupied { .. })));
    fs::remove_file(at("2").join("fates.csv")).unwrap();
    for force in [false, true] {
        merge(&parts, &at("whole"), force).unwrap_err();
        assert_eq!(files(&at("whole")), before);
    }
    fs::write(at("2").join("fates.csv"), "short").unwrap();
    assert!(merge(&parts, &at("whole"), true).unwrap_err().to_string().contains("5 bytes where the checkpoint says"));
    assert_eq!(files(&at("whole")), before);
    let names: Vec<_> = fs::read_dir(folder.path()).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(names.len(), 3, "{names:?}");
}

#[test]
fn rows_put_aside_are_the_rows_held() {
    let folder = tempfile::tempdir().unwrap();
    let case = case_with("trajectories = 20\nfates = \"parquet\"");
    let (held, aside) = (folder.path().join("held"), folder.path().join("aside"));
    run(&case, &options(&held, 2), &Silent).unwrap();
    run_on(&case, &options(&aside, 2), &Silent, &Machine, 0).unwrap();
    assert_eq!(files(&held), files(&aside));
}
