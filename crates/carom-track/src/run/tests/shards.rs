//! How many threads work, and which shards are merged in which order, leaves no trace.

use super::*;

/// Runs a case into folders of `folder`: on one thread (`whole`), on three, and in shards that are merged, all with the same files.
pub(super) fn whole_threads_and_shards(case: &Case, folder: &Path, of: u64) -> Summary {
    let at = |name: &str| folder.join(name);
    let whole = run(case, &options(&at("whole"), 1), &Silent).unwrap();
    run(case, &options(&at("three"), 3), &Silent).unwrap();
    assert!(files(&at("whole")) == files(&at("three")), "three threads differ from one");
    let parts: Vec<PathBuf> = (1..=of).map(|index| at(&format!("{index}-{of}"))).collect();
    for (index, out) in (1..).zip(&parts) {
        run(case, &RunOptions { shard: Some(Shard { index, of }), ..options(out, 2) }, &Silent).unwrap();
    }
    assert_eq!(merge(&parts, &at("merged"), false).unwrap().0, whole);
    assert!(files(&at("whole")) == files(&at("merged")), "{of} shards differ from the whole");
    whole
}

#[test]
fn threads_shards_and_order_leave_no_trace() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let case = case();
    let whole = run(&case, &options(&at("one"), 1), &Silent).unwrap();
    run(&case, &options(&at("three"), 3), &Silent).unwrap();
    assert_eq!(files(&at("one")), files(&at("three")));
    for of in [2, 3, 7] {
        let folders: Vec<PathBuf> = (1..=of).map(|i| at(&format!("{i}-{of}"))).collect();
        for (i, out) in folders.iter().enumerate() {
            let shard = Some(Shard { index: i as u64 + 1, of });
            run(&case, &RunOptions { shard, ..options(out, 2) }, &Silent).unwrap();
        }
        let mut reversed = folders.clone();
        reversed.reverse();
        assert_eq!(merge(&reversed, &at(&format!("merged-{of}")), false).unwrap().0, whole);
        assert_eq!(files(&at("one")), files(&at(&format!("merged-{of}"))));
        assert!(
            merge(&folders[1..], &at("missing"), false)
                .unwrap_err()
                .to_string()
                .contains(&format!("shard 1/{of} is missing"))
        );
    }
}
