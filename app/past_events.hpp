#pragma once

#include <cstddef>
#include <deque>
#include <string>

namespace surefoot {

/// What happened in a live run, for pages that come late: changes from outside, the last of them,
/// and all other events back to where frames are kept.
class PastEvents {
 public:
  /// `most_changes`: that are kept.
  explicit PastEvents(std::size_t most_changes) : most_changes_(most_changes) {}

  /// `text`: as /api/events has it.
  void add(double time, std::string text);
  void add_change(double time, std::string text);
  void forget_before(double time);
  void clear();
  /// All of them in the order of time, as a JSON array.
  [[nodiscard]] std::string json() const;

 private:
  struct Entry {
    double time;
    std::string text;
  };

  std::size_t most_changes_;
  std::deque<Entry> events_, changes_;
};

}  // namespace surefoot
