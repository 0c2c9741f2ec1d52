//! The `carom` command.

fn main() -> std::process::ExitCode {
    carom_cli::main(std::env::args_os())
}
