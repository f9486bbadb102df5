#pragma once

#include "app/event_finder.hpp"

#include <cstddef>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace surefoot {

/// What happened in a live run, for pages that come late: changes from outside, the last of them,
/// and all other events back to where frames are kept. Of a force whose end is kept, or that still
/// acts, the begin is kept as well.
class PastEvents {
 public:
  /// `most_changes`: that are kept.
  explicit PastEvents(std::size_t most_changes) : most_changes_(most_changes) {}

  /// `text`: as /api/events has it; `force`: that begins or ends with it.
  void add(double time, std::string text, const std::optional<ForceMark>& force = {});
  void add_change(double time, std::string text, const std::optional<ForceMark>& force = {});
  void forget_before(double time);
  void clear();
  /// All of them in the order of time, as a JSON array.
  [[nodiscard]] std::string json() const;

 private:
  struct Entry {
    double time;
    std::string text;
    std::string force;    ///< kind and body of one that begins or ends; empty: none
    bool begins = false;  ///< that force
  };

  static Entry entry(double time, std::string text, const std::optional<ForceMark>& force);
  void forget_first(std::deque<Entry>& entries);

  std::size_t most_changes_;
  std::deque<Entry> events_, changes_;
  std::vector<Entry> begun_;  // of forces whose end is kept or still to come
};

}  // namespace surefoot
