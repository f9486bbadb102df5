#pragma once

#include <iosfwd>
#include <string>

namespace surefoot::cli {

/// Notes on stderr that next to a log lies the unfinished one of a later run.
void note_later_run(const std::string& log);

/// `surefoot explain`, as typed.
struct ExplainArguments {
  std::string log;
  double at = 0.0;  ///< [s]
  bool json = false;
};

/// `surefoot explain RUN.mcap --at T`: what the controller knew, wanted and did at that tick, and
/// in a sentence what gave way to what. Returns an ExitCode; throws Error on wrong input.
int run_explain(const ExplainArguments& arguments, std::ostream& out);

/// `surefoot info`, as typed.
struct InfoArguments {
  std::string log;
  bool events = false, json = false;
};

/// `surefoot info RUN.mcap`: what is in a log, of which run, and whether it is whole. Returns an
/// ExitCode; throws Error on wrong input.
int run_info(const InfoArguments& arguments, std::ostream& out);

/// `surefoot mend`, as typed.
struct MendArguments {
  std::string log, out;
};

/// `surefoot mend RUN.mcap --out NEW.mcap`: what can be read of a log, as a whole one. Prints what
/// is lost. Returns an ExitCode; throws Error on wrong input.
int run_mend(const MendArguments& arguments, std::ostream& out);

}  // namespace surefoot::cli
