#include "surefoot/explain/unused_text.hpp"

#include "surefoot/logging/hierarchy_status.hpp"
#include "surefoot/logging/stop_text.hpp"

namespace surefoot::explain {
namespace {

constexpr const char* kLifted = "its feet bear too little";
constexpr const char* kRises = "it stands up";
constexpr const char* kNoState = "there was no state to believe";

/// Of a controller that has not stopped.
const char* without_state(CommandMode mode) {
  if (mode == CommandMode::lifted) return kLifted;
  return mode == CommandMode::rise ? kRises : kNoState;
}

}  // namespace

UnusedText unused_text(const TickRecord& tick, const std::vector<std::string>& joints) {
  if (logging::was_used(tick)) return {};
  const std::string stop = logging::text_of_stop(tick, joints);
  return {unused_texts()[logging::was_solved(tick.hierarchy) ? 2 : 1],
          stop.empty() ? without_state(tick.command.mode) : stop};
}

const std::vector<std::string>& unused_texts() {
  static const std::vector<std::string> texts{
      "", "No hierarchy was solved", "The controller stopped, and what was solved was not used"};
  return texts;
}

std::vector<std::string> unused_reasons(const std::vector<std::string>& joints) {
  std::vector<std::string> all = logging::stop_texts(joints);
  all.insert(all.end(), {kLifted, kRises, kNoState});
  return all;
}

}  // namespace surefoot::explain
