#include "app/log_contents.hpp"

#include "surefoot/logging/log_reader.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace surefoot {
namespace {

double seconds(std::uint64_t nanoseconds) { return 1e-9 * static_cast<double>(nanoseconds); }

TopicContents& topic_of(const McapMessage& message, std::vector<TopicContents>& topics) {
  const auto found = std::ranges::find(topics, message.channel->topic, &TopicContents::topic);
  if (found != topics.end()) return *found;
  topics.push_back({.topic = message.channel->topic, .schema = message.channel->schema_name});
  topics.back().first_time = seconds(message.log_time);
  return topics.back();
}

/// Counts the whole ticks, and by their times those that are missing.
class Ticks {
 public:
  explicit Ticks(double period) : period_(period) {}

  /// A tick is whole from its readings to its command.
  void add(const McapMessage& message, LogContents& contents) {
    const std::string& topic = message.channel->topic;
    if (topic == "/readings") begun_ = message.log_time;
    if (topic != "/command" || begun_ != message.log_time) return;
    const double time = seconds(message.log_time);
    if (contents.ticks++ == 0) contents.first_time = time;
    contents.last_time = time;
    contents.lost_ticks += missing_before(time);
    next_ = time + period_;
  }

  /// Those behind the last that were in a lost chunk.
  void add(const McapLoss& loss, LogContents& contents) {
    const double behind = seconds(loss.last_time) + period_;
    if (!loss.has_times || behind < next_) return;
    contents.lost_ticks += missing_before(behind);
    next_ = behind;
  }

 private:
  [[nodiscard]] std::uint64_t missing_before(double time) const {
    return static_cast<std::uint64_t>(std::max(0L, std::lround((time - next_) / period_)));
  }

  double period_, next_ = 0.0;  // time of the tick that comes next [s]
  std::uint64_t begun_ =
      std::numeric_limits<std::uint64_t>::max();  // time of the last readings [ns]
};

}  // namespace

LogContents read_contents(const std::string& path) {
  LogContents contents;
  contents.header = LogReader(path).header();  // refuses what is not ours
  contents.header.attachments.clear();
  contents.file_bytes = std::filesystem::file_size(path);
  McapReader file(path);
  Ticks ticks(contents.header.control_period);
  for (McapMessage message; file.next(message);) {
    TopicContents& topic = topic_of(message, contents.topics);
    ++topic.messages;
    topic.bytes += message.data.size();
    topic.last_time = seconds(message.log_time);
    ticks.add(message, contents);
  }
  contents.losses = file.losses();
  for (const McapLoss& loss : contents.losses) ticks.add(loss, contents);
  for (const auto& [name, data] : file.attachments())
    contents.attachments.push_back({name, data.size()});
  const auto summary = file.attachments().find("summary.json");
  if (summary != file.attachments().end()) contents.summary = summary->second;
  const auto metadata = file.metadata().find("surefoot");
  if (metadata != file.metadata().end() && metadata->second.contains("log_version"))
    contents.log_version = metadata->second.at("log_version");
  contents.problem = file.problem();
  return contents;
}

}  // namespace surefoot
