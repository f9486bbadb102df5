#pragma once

#include <iosfwd>
#include <string>

namespace surefoot {

/// `surefoot solve FILE.jsonl`: solves the hierarchy on each line of the file ("-": standard input)
/// and writes one line for each,
///
///     {"x": […], "levels": [{"residual": …}, …]}        residual = √(‖A x − b‖² + ‖max(0, D x −
///     f)‖²)
///
/// Blank lines are skipped. A line that can't be understood gives one message on `err`, with file
/// and line, and nothing on `out`; the other lines are still solved. A line that ended at the cap
/// of iterations has "status": "iteration_cap" in its result. Returns the exit code: 0, or 2 if the
/// input is wrong. Throws FileError if the file can't be read.
int run_solve(const std::string& file, std::ostream& out, std::ostream& err);

}  // namespace surefoot
