//! Power cuts: a disk that forgets what was not put on it.
//!
//! What a file system may leave of a folder after a cut: of each file at least what was synced of it, and of what was appended
//! since any part, garbled or not; the folder's names as they were when it was last synced, or as they were at any time since.

use super::*;
use crate::random::{Purpose, Stream};
use std::collections::BTreeMap;
use std::fs::File;
use std::io;
use std::sync::Mutex;

type Names = BTreeMap<String, usize>;

/// The machine's disk until some number of operations; then all fail.
pub(in crate::run) struct Unplugged {
    folder: PathBuf,
    after: u64,
    state: Mutex<Known>,
}

#[derive(Default)]
struct Known {
    operations: u64,
    /// What is on disk of each file, and what was last seen of those that lost their names.
    on_disk: Vec<Vec<u8>>,
    nameless: BTreeMap<usize, Vec<u8>>,
    names: Names,
    /// The folder as synced, and every state since.
    folders: Vec<Names>,
}

impl Known {
    fn file(&mut self, name: &str) -> usize {
        if let Some(file) = self.names.get(name) {
            return *file;
        }
        self.on_disk.push(Vec::new());
        self.names.insert(name.to_owned(), self.on_disk.len() - 1);
        self.folders.push(self.names.clone());
        self.on_disk.len() - 1
    }
}

fn name(path: &Path) -> String {
    path.file_name().unwrap().to_str().unwrap().to_owned()
}

impl Unplugged {
    /// Of a folder in which all that is there is on disk.
    pub fn after(operations: u64, folder: &Path) -> Self {
        let mut known = Known::default();
        for entry in fs::read_dir(folder).into_iter().flatten().map(Result::unwrap) {
            let file = known.file(entry.file_name().to_str().unwrap());
            known.on_disk[file] = fs::read(entry.path()).unwrap();
        }
        known.folders = vec![known.names.clone()];
        Self { folder: folder.to_owned(), after: operations, state: Mutex::new(known) }
    }

    fn operation(&self) -> io::Result<std::sync::MutexGuard<'_, Known>> {
        let mut known = self.state.lock().unwrap();
        known.operations += 1;
        if known.operations > self.after { Err(io::Error::other("the power is off")) } else { Ok(known) }
    }

    /// Leaves of the folder what a cut leaves.
    fn cut(self, draws: &mut Stream) {
        let known = self.state.into_inner().unwrap();
        let pick = |draws: &mut Stream, n: usize| ((draws.uniform() * n as f64) as usize).min(n - 1);
        let now = |file: usize| {
            let named = known.names.iter().find(|(_, f)| **f == file);
            named.and_then(|(name, _)| fs::read(self.folder.join(name)).ok()).or(known.nameless.get(&file).cloned())
        };
        let names = &known.folders[pick(draws, known.folders.len())];
        let mut left = Vec::new();
        for (name, file) in names {
            let on_disk = &known.on_disk[*file];
            let mut bytes = now(*file).unwrap_or_default();
            if bytes.starts_with(on_disk) {
                bytes.truncate(on_disk.len() + pick(draws, bytes.len() - on_disk.len() + 1));
                if draws.uniform() < 0.5 {
                    bytes[on_disk.len()..].fill(0);
                }
            } else if draws.uniform() < 0.5 {
                bytes.clone_from(on_disk);
            }
            left.push((name.clone(), bytes));
        }
        fs::remove_dir_all(&self.folder).unwrap();
        fs::create_dir_all(&self.folder).unwrap();
        left.iter().for_each(|(name, bytes)| fs::write(self.folder.join(name), bytes).unwrap());
    }
}

impl Disk for Unplugged {
    fn append(&self, file: &mut File, path: &Path, bytes: &[u8]) -> io::Result<()> {
        match self.operation() {
            Ok(mut known) => {
                known.file(&name(path));
                io::Write::write_all(file, bytes)
            }
            Err(off) => {
                // half of what was on its way when the power went
                io::Write::write_all(file, &bytes[..bytes.len() / 2])?;
                Err(off)
            }
        }
    }

    fn sync(&self, _: &File, path: &Path) -> io::Result<()> {
        let mut known = self.operation()?;
        let id = known.file(&name(path));
        known.on_disk[id] = fs::read(path)?;
        Ok(())
    }

    fn sync_folder(&self, _: &Path) -> io::Result<()> {
        let mut known = self.operation()?;
        known.folders = vec![known.names.clone()];
        Ok(())
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        let mut known = self.operation()?;
        if let Some(old) = known.names.get(&name(to)).copied() {
            known.nameless.insert(old, fs::read(to)?);
        }
        let file = known.file(&name(from));
        fs::rename(from, to)?;
        known.names.remove(&name(from));
        known.names.insert(name(to), file);
        let names = known.names.clone();
        known.folders.push(names);
        Ok(())
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        let mut known = self.operation()?;
        if let Some(file) = known.names.remove(&name(path)) {
            known.nameless.insert(file, fs::read(path)?);
            let names = known.names.clone();
            known.folders.push(names);
        }
        fs::remove_file(path)
    }
}

/// A case that is soon done, with every kind of table.
fn small() -> Case {
    let text = CASE
        .replace("count = 3000", "count = 300")
        .replace("parcels = 2000", "parcels = 200")
        .replace("[output]", "[output]\nimpacts = \"parquet\"\ntrajectories = 30");
    Case::from_toml(&text, Path::new("case.toml"), Library::builtin()).unwrap()
}

#[test]
fn a_power_cut_loses_at_most_what_came_after_the_last_checkpoint() {
    let folder = tempfile::tempdir().unwrap();
    let case = small();
    let whole = folder.path().join("whole");
    run(&case, &options(&whole, 1), &Silent).unwrap();
    let wanted = files(&whole);
    let often = |out: &Path, resume| RunOptions { checkpoint_every: Duration::ZERO, resume, ..options(out, 1) };
    let all = Unplugged::after(u64::MAX, &folder.path().join("count"));
    run_on(&case, &often(&folder.path().join("count"), false), &Silent, &all, HELD).unwrap();
    let operations = all.state.lock().unwrap().operations;
    assert!(operations > 150, "{operations}");
    let mut cuts = 0;
    for seed in 0..12 {
        let out = folder.path().join(format!("cut-{seed}"));
        let mut draws = Stream::new(seed, 0, Purpose::Injection, 0);
        let mut known = 0;
        // three cuts at most in the life of one run
        for life in 0..3 {
            let after = (draws.uniform() * operations as f64) as u64;
            let disk = Unplugged::after(after, &out);
            let ended = run_on(&case, &often(&out, life > 0), &Silent, &disk, HELD);
            if ended.is_ok() {
                break;
            }
            cuts += 1;
            let promised = State::read(&out).ok().flatten().map_or(0, |s| s.next);
            disk.cut(&mut draws);
            let left = State::read(&out).unwrap_or_else(|e| panic!("seed {seed}: {e}")).map_or(0, |s| s.next);
            // what one checkpoint holds, which comes after each block
            assert!(
                left >= known && left + block::SIZE >= promised,
                "seed {seed}: {left} of {promised}, {known} before"
            );
            known = left;
        }
        run(&case, &RunOptions { resume: true, ..options(&out, 2) }, &Silent)
            .unwrap_or_else(|e| panic!("seed {seed}: {e}"));
        assert!(files(&out) == wanted, "seed {seed}");
    }
    assert!(cuts > 15, "{cuts}");
}
