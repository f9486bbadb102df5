#include "cli/log_commands.hpp"

#include "cli/contents_text.hpp"
#include "cli/exit_code.hpp"
#include "cli/progress.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/base/printable.hpp"
#include "surefoot/explain/explanation_json.hpp"
#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/mend_log.hpp"
#include "surefoot/logging/output_files.hpp"
#include "surefoot/logging/partial_log.hpp"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <ostream>
#include <vector>

namespace surefoot::cli {
namespace {

std::string events_text(const std::vector<explain::NearbyEvent>& events) {
  std::string out = events.empty() ? "" : "\n";
  for (const explain::NearbyEvent& event : events)
    out += formatted("%9.4f s  ", event.time) + (event.leg.empty() ? "" : event.leg + ": ") +
           event.text + "\n";
  return out;
}

}  // namespace

void note_later_run(const std::string& log) {
  const std::string partial = logging::existing_partial(log);
  if (partial.empty() || !std::filesystem::exists(log)) return;
  std::fprintf(stderr, "surefoot: note: %s is of a later run, which goes on or was cut off\n",
               printable(partial).c_str());
}

int run_explain(const ExplainArguments& arguments, std::ostream& out) {
  if (!std::isfinite(arguments.at)) throw Error("--at is not a time; a number of seconds is valid");
  note_later_run(arguments.log);
  std::optional<Waiting> waiting(std::in_place,
                                 "computing " + arguments.log + " again up to the tick");
  const explain::TickExplanation explanation = explain::explain_tick(arguments.log, arguments.at);
  waiting.reset();
  if (arguments.json) {
    out << printable(explain::explanation_json(explanation).dump()) << std::endl;
  } else {
    out << printable(explanation.text(), "\n") << std::flush;
  }
  return kPassed;
}

int run_info(const InfoArguments& arguments, std::ostream& out) {
  note_later_run(arguments.log);
  const LogContents contents = read_contents(arguments.log);
  const auto events =
      arguments.events ? explain::read_events(arguments.log) : std::vector<explain::NearbyEvent>();
  if (arguments.json) {
    auto json = contents_json(arguments.log, contents);
    if (arguments.events) json["events"] = explain::events_json(events);
    out << printable(json.dump()) << std::endl;
  } else {
    out << printable(contents_text(arguments.log, contents) + events_text(events), "\n")
        << std::flush;
  }
  return kPassed;
}

int run_mend(const MendArguments& arguments, std::ostream& out) {
  logging::check_not_the_input(arguments.out, arguments.log);
  logging::check_writable_file(arguments.out);
  {
    const logging::LogReader has_a_header(arguments.log);
  }
  const std::string problem = logging::mend_log(arguments.log, arguments.out);
  out << printable(problem.empty() ? "it was whole" : problem) << std::endl;
  return kPassed;
}

}  // namespace surefoot::cli
