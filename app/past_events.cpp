#include "app/past_events.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace surefoot {

// A push of the operator ends by itself.
PastEvents::Entry PastEvents::entry(double time, std::string text,
                                    const std::optional<ForceMark>& force) {
  if (!force || !std::isnan(force->duration)) return {time, std::move(text), ""};
  return {time, std::move(text), std::string(force->kind) + " " + std::string(force->body),
          force->begins};
}

void PastEvents::add(double time, std::string text, const std::optional<ForceMark>& force) {
  events_.push_back(entry(time, std::move(text), force));
}

void PastEvents::add_change(double time, std::string text, const std::optional<ForceMark>& force) {
  changes_.push_back(entry(time, std::move(text), force));
  if (changes_.size() > most_changes_) forget_first(changes_);
}

void PastEvents::forget_before(double time) {
  while (!events_.empty() && events_.front().time < time) forget_first(events_);
}

void PastEvents::forget_first(std::deque<Entry>& entries) {
  const Entry first = std::move(entries.front());
  entries.pop_front();
  if (first.force.empty()) return;
  std::erase_if(begun_, [&](const Entry& one) { return one.force == first.force; });
  if (first.begins) begun_.push_back(first);
}

void PastEvents::clear() {
  events_.clear();
  changes_.clear();
  begun_.clear();
}

std::string PastEvents::json() const {
  std::vector<const Entry*> all;
  const auto add = [&](const auto& entries) {
    for (const Entry& entry : entries) all.push_back(&entry);
  };
  add(begun_);
  add(changes_);
  add(events_);
  std::ranges::stable_sort(all, {}, &Entry::time);
  std::string text = "[";
  for (const Entry* entry : all) text += (text.size() == 1 ? "" : ",") + entry->text;
  return text + "]";
}

}  // namespace surefoot
