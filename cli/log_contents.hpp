#pragma once

#include "surefoot/logging/log_header.hpp"
#include "surefoot/logging/mcap_reader.hpp"
#include "surefoot/logging/tick_clock.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace surefoot::cli {

/// What a log holds on one topic.
struct TopicContents {
  std::string topic, schema;
  std::uint64_t messages = 0;
  std::uint64_t bytes = 0;                   ///< of the messages, before compression
  double first_time = 0.0, last_time = 0.0;  ///< [s]
};

struct AttachmentContents {
  std::string name;
  std::uint64_t bytes = 0;
};

/// What is in a log.
struct LogContents {
  logging::LogHeader header;  ///< without its attachments
  std::uint64_t file_bytes = 0;
  double first_time = 0.0, last_time = 0.0;  ///< of the ticks [s]; both 0 without any
  std::uint64_t ticks = 0;
  std::vector<TopicContents> topics;  ///< in the order of their first messages
  std::vector<AttachmentContents> attachments;
  std::string summary;  ///< JSON; empty without one
  std::string problem;  ///< why not all of it could be read; empty if it is whole
  std::vector<logging::McapLoss> losses;
  int changes = 0;               ///< by an operator while it ran
  std::uint64_t lost_ticks = 0;  ///< that are known to be missing
  logging::ClockSkips clock;
};

/// Reads all of a log. Throws FileError as LogReader does.
[[nodiscard]] LogContents read_contents(const std::string& path);

}  // namespace surefoot::cli
