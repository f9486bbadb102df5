#include "server/tick_explainer.hpp"

#include "server/log_frames.hpp"
#include "surefoot/explain/explanation_json.hpp"
#include "surefoot/runtime/interrupt.hpp"

#include <exception>
#include <utility>

namespace surefoot::server {
namespace {

constexpr std::size_t kMostKept = 256;

}  // namespace

TickExplainer::TickExplainer(std::string path, double period)
    : path_(std::move(path)), period_(period) {
  thread_ = std::thread([this] { run(); });
}

TickExplainer::~TickExplainer() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wakes_.notify_one();
  thread_.join();
}

std::optional<std::string> TickExplainer::ask(std::uint32_t tick) {
  const std::lock_guard lock(mutex_);
  if (const auto found = known_.find(tick); found != known_.end()) return found->second;
  wanted_ = tick;
  wakes_.notify_one();
  return std::nullopt;
}

void TickExplainer::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    wakes_.wait(lock, [this] { return stopping_ || wanted_; });
    if (stopping_) return;
    const std::uint32_t tick = *std::exchange(wanted_, std::nullopt);
    lock.unlock();
    std::string answer = explained(tick);
    lock.lock();
    if (known_.size() >= kMostKept) known_.clear();
    known_[tick] = std::move(answer);
    if (wanted_ == tick) wanted_.reset();
  }
}

std::string TickExplainer::explained(std::uint32_t tick) const {
  using Json = nlohmann::ordered_json;
  try {
    explain::TickExplanation explanation =
        explain::explain_tick(path_, period_ * tick, explain::Costs::exact,
                              [this] { return stopping_ || runtime::interrupted(); });
    explanation.why_estimates = without_path(explanation.why_estimates, path_);
    return explain::text_of(explain::gave_way_json(explanation));
  } catch (const std::exception& error) {
    return explain::text_of(Json{{"problem", without_path(error.what(), path_)}});
  }
}

}  // namespace surefoot::server
