#pragma once

namespace surefoot::cli {

/// The whole program: reads its arguments, runs the command, prints errors in one line on stderr.
/// Returns an ExitCode.
int run_program(int argc, char** argv);

}  // namespace surefoot::cli
