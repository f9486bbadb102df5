#include "surefoot/closed_loop/own_part_times.hpp"

#include "surefoot/base/formatted.hpp"

#include <algorithm>

namespace surefoot::closed_loop {
namespace {

double TickTiming::* stage_of(const std::string& part) {
  if (part == "estimator") return &TickTiming::estimate;
  return part.starts_with("task ") ? &TickTiming::stack : &TickTiming::plan;
}

double median(std::vector<double> times) {
  const auto middle = times.begin() + std::ssize(times) / 2;
  std::ranges::nth_element(times, middle);
  return *middle;
}

}  // namespace

OwnPartTimes::OwnPartTimes(const std::vector<std::string>& own_parts, double period)
    : period_(period) {
  for (const std::string& part : own_parts) {
    const auto same = std::ranges::find(stages_, stage_of(part), &Stage::time);
    if (same == stages_.end()) {
      stages_.push_back({stage_of(part), part, {}});
    } else {
      same->parts += " and " + part;
    }
  }
}

void OwnPartTimes::add(const TickTiming& timing) {
  for (Stage& stage : stages_)
    if (timing.*stage.time > 0.0) stage.times.push_back(timing.*stage.time);
}

std::vector<std::string> OwnPartTimes::notes() const {
  std::vector<std::string> notes;
  for (const Stage& stage : stages_) {
    const double time = stage.times.empty() ? 0.0 : 1e-6 * median(stage.times);
    if (time > period_)
      notes.push_back("the stage of your own " + stage.parts +
                      formatted(" takes %.3g ms in the median, and a tick has %.3g ms", 1e3 * time,
                                1e3 * period_));
  }
  return notes;
}

}  // namespace surefoot::closed_loop
