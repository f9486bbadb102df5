#pragma once

#include <cstdint>
#include <iosfwd>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace surefoot::cli {

/// `surefoot dump`, as typed.
struct DumpArguments {
  std::string source;                                   ///< scenario (name or file), or a log
  double from = 0.0;                                    ///< first tick at or after this time [s]
  double to = std::numeric_limits<double>::infinity();  ///< last tick before this time [s]
  int every = 1;                                        ///< of so many ticks, one is written
  std::string out;                                      ///< file; empty: standard output
  std::optional<std::uint64_t> seed;                    ///< of a scenario
  std::vector<std::string> assignments;                 ///< to a scenario
};

/// `surefoot dump SCENARIO|RUN.mcap`: writes the hierarchy of each tick, one line each, as
/// `format_hierarchy` defines it and `surefoot solve` reads it, with the rows' names. A scenario is
/// run for it; of a log the controller is run again on what was logged. Ticks at which the
/// controller believed no state have no hierarchy and are left out.
///
/// A log whose torques this program does not give again bit for bit is dumped all the same, with a
/// warning on `err`. Returns an ExitCode; throws Error on wrong input and where no tick lies in
/// the range.
int run_dump(const DumpArguments& arguments, std::ostream& out, std::ostream& err);

}  // namespace surefoot::cli
