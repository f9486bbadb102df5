#pragma once

#include "surefoot/logging/message_fields.hpp"

#include <string>
#include <string_view>

namespace surefoot {

/// How often a run was changed or pushed from outside. A pull counts once, however many messages
/// follow the operator's hand.
class ChangeCount {
 public:
  /// In the order of the log.
  void add(const logged::Change& change);
  /// Of a message on /changes; one that makes no sense is a change, too.
  void add(std::string_view message);

  [[nodiscard]] int count() const { return count_; }

 private:
  std::string pulled_;  // the body; empty: none
  int count_ = 0;
};

}  // namespace surefoot
