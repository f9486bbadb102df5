#include "cli/log_contents.hpp"

#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/tick_clock.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>

namespace surefoot::cli {
namespace {

double seconds(std::uint64_t nanoseconds) { return 1e-9 * static_cast<double>(nanoseconds); }

TopicContents& topic_of(const logging::McapMessage& message, std::vector<TopicContents>& topics) {
  const auto found = std::ranges::find(topics, message.channel->topic, &TopicContents::topic);
  if (found != topics.end()) return *found;
  topics.push_back({.topic = message.channel->topic, .schema = message.channel->schema_name});
  topics.back().first_time = seconds(message.log_time);
  return topics.back();
}

/// Counts the whole ticks, and those that are lost.
class Ticks {
 public:
  explicit Ticks(double period) : clock_(period) {}

  /// A tick is whole from its readings to its command.
  void add(const logging::McapMessage& message, LogContents& contents) {
    const std::string& topic = message.channel->topic;
    if (topic == "/readings") begun_ = message.log_time;
    if (topic != "/command" || begun_ != message.log_time) return;
    const double time = seconds(message.log_time);
    clock_.add(time);
    if (contents.ticks++ == 0) contents.first_time = time;
    contents.last_time = time;
  }

  void add(const logging::McapLoss& loss) {
    if (loss.may_hold_messages) clock_.lose(logging::first_time(loss));
  }

  /// Counts ticks of lost chunks behind the last tick.
  void end(LogContents& contents) {
    for (const logging::McapLoss& loss : contents.losses) {
      if (!loss.has_times) continue;
      add(loss);
      clock_.end(seconds(loss.last_time));
    }
    contents.lost_ticks = clock_.lost();
    contents.clock = clock_.skips();
  }

 private:
  logging::TickClock clock_;
  std::uint64_t begun_ =
      std::numeric_limits<std::uint64_t>::max();  // time of the last readings [ns]
};

}  // namespace

LogContents read_contents(const std::string& path) {
  LogContents contents;
  contents.header = logging::LogReader(path).header();  // refuses what is not ours
  contents.header.attachments.clear();
  contents.file_bytes = std::filesystem::file_size(path);
  logging::McapReader file(path);
  Ticks ticks(contents.header.control_period);
  std::size_t known_losses = 0;
  for (logging::McapMessage message; file.next(message);) {
    while (known_losses < file.losses().size()) ticks.add(file.losses()[known_losses++]);
    TopicContents& topic = topic_of(message, contents.topics);
    ++topic.messages;
    topic.bytes += message.data.size();
    topic.last_time = seconds(message.log_time);
    ticks.add(message, contents);
    if (topic.topic == "/changes") ++contents.changes;
  }
  contents.losses = file.losses();
  ticks.end(contents);
  for (const auto& [name, data] : file.attachments())
    contents.attachments.push_back({name, data.size()});
  const auto summary = file.attachments().find("summary.json");
  if (summary != file.attachments().end()) contents.summary = summary->second;
  contents.problem = file.problem();
  return contents;
}

}  // namespace surefoot::cli
