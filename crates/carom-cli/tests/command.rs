//! The command's words: outputs, errors and exit codes as written in `cmd/` and in the README.

#[test]
fn outputs_and_errors_are_as_written() {
    trycmd::TestCases::new().case("tests/cmd/*.trycmd");
}

#[test]
fn the_readme_tells_the_truth() {
    trycmd::TestCases::new().case("../../README.md");
}
