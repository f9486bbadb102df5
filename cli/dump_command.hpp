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
  int every = 1;                                        ///< writes every n-th tick
  std::string out;                                      ///< file; empty: standard output
  std::optional<std::uint64_t> seed;                    ///< of a scenario
  std::vector<std::string> assignments;                 ///< to a scenario
};

/// `surefoot dump SCENARIO|RUN.mcap`: writes the hierarchy of each tick on a line, as
/// `format_hierarchy` defines it and `surefoot solve` reads it, with the rows' names. Runs a
/// scenario, or a log's controller again on its readings. Ticks without a believed state have no
/// hierarchy and are left out.
///
/// Warns on `err` if the computed torques differ from the log's. Returns an ExitCode; throws Error
/// on wrong input, and if no tick is in the range.
int run_dump(const DumpArguments& arguments, std::ostream& out, std::ostream& err);

}  // namespace surefoot::cli
