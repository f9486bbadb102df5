#pragma once

#include "surefoot/logging/message_fields.hpp"

#include <string>
#include <string_view>

namespace surefoot {

/// Counts external changes and pushes of a run. A pull counts once, however many messages it has.
class ChangeCount {
 public:
  /// In the order of the log.
  void add(const logged::Change& change);
  /// A message on /changes; an invalid one counts, too.
  void add(std::string_view message);

  [[nodiscard]] int count() const { return count_; }

 private:
  std::string pulled_;  // the body; empty: none
  int count_ = 0;
};

}  // namespace surefoot
