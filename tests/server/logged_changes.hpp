#pragma once

#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/message_decoder.hpp"

#include <string>
#include <vector>

namespace surefoot::test {

/// What was changed from outside in a run, as its log has it.
inline std::vector<logged::Change> changes_of(const std::string& path) {
  std::vector<logged::Change> changes;
  logging::LogReader log(path, [&](const logging::McapMessage& message) {
    if (message.channel->topic != "/changes") return;
    logged::Decoder::decode(message.data, changes.emplace_back());
  });
  TickRecord tick;
  while (log.next(tick)) {
  }
  return changes;
}

}  // namespace surefoot::test
