//! The command's words: outputs, errors and exit codes as written in `cmd/`.

#[test]
fn outputs_and_errors_are_as_written() {
    trycmd::TestCases::new().case("tests/cmd/*.trycmd");
}
