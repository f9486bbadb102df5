#include "surefoot/closed_loop/trouble_counter.hpp"

#include "surefoot/logging/message_fields.hpp"
#include "surefoot/logging/stop_text.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace surefoot::closed_loop {

void TroubleCounter::add(double time, const TickRecord& record) {
  std::vector<std::string> now;
  for (logging::FaultText& fault : logging::faults_of(record)) {
    if (std::isfinite(fault.age)) now.push_back(std::move(fault.text));
  }
  const CommandMode mode = record.command.mode;
  if (mode == CommandMode::sit || mode == CommandMode::damping) {
    now.push_back("command mode: " +
                  std::string(logged::kModeNames[static_cast<std::size_t>(mode)]));
  }
  for (const std::string& what : now) {
    if (std::ranges::find(before_, what) != before_.end()) continue;
    auto entry = std::ranges::find(counts_, what, &TroubleCount::what);
    if (entry == counts_.end()) {
      entry = counts_.insert(counts_.end(), {.what = what, .first = time});
    }
    ++entry->count;
  }
  before_ = std::move(now);
}

}  // namespace surefoot::closed_loop
