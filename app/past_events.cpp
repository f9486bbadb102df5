#include "app/past_events.hpp"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace surefoot {

void PastEvents::add(double time, std::string text) { events_.push_back({time, std::move(text)}); }

void PastEvents::add_change(double time, std::string text) {
  changes_.push_back({time, std::move(text)});
  if (changes_.size() > most_changes_) changes_.pop_front();
}

void PastEvents::forget_before(double time) {
  while (!events_.empty() && events_.front().time < time) events_.pop_front();
}

void PastEvents::clear() {
  events_.clear();
  changes_.clear();
}

std::string PastEvents::json() const {
  std::vector<const Entry*> events, changes, all;
  for (const Entry& entry : events_) events.push_back(&entry);
  for (const Entry& entry : changes_) changes.push_back(&entry);
  std::ranges::merge(changes, events, std::back_inserter(all), {}, &Entry::time, &Entry::time);
  std::string text = "[";
  for (const Entry* entry : all) text += (text.size() == 1 ? "" : ",") + entry->text;
  return text + "]";
}

}  // namespace surefoot
