#include "app/log_commands.hpp"

#include "app/contents_text.hpp"
#include "app/exact_costs.hpp"
#include "app/exit_code.hpp"
#include "app/progress.hpp"
#include "app/tick_text.hpp"
#include "surefoot/base/error.hpp"
#include "surefoot/base/printable.hpp"

#include <cmath>
#include <ostream>

namespace surefoot {

int run_explain(const ExplainArguments& arguments, std::ostream& out) {
  if (!std::isfinite(arguments.at)) throw Error("--at is not a time; a number of seconds is valid");
  TickExplanation explanation = read_tick(arguments.log, arguments.at);
  {
    const Waiting waiting("computing " + arguments.log + " again up to the tick");
    find_exact_costs(arguments.log, explanation);
  }
  if (arguments.json) {
    out << printable(tick_json(arguments.log, explanation).dump()) << std::endl;
  } else {
    out << printable(tick_text(arguments.log, explanation), "\n") << std::flush;
  }
  return kPassed;
}

int run_info(const InfoArguments& arguments, std::ostream& out) {
  const LogContents contents = read_contents(arguments.log);
  if (arguments.json) {
    out << printable(contents_json(arguments.log, contents).dump()) << std::endl;
  } else {
    out << printable(contents_text(arguments.log, contents), "\n") << std::flush;
  }
  return kPassed;
}

}  // namespace surefoot
