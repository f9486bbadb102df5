#include "app/log_contents.hpp"

#include "surefoot/logging/log_reader.hpp"
#include "surefoot/logging/mcap_reader.hpp"

#include <algorithm>
#include <filesystem>

namespace surefoot {
namespace {

TopicContents& topic_of(const McapMessage& message, std::vector<TopicContents>& topics) {
  const auto found = std::ranges::find(topics, message.channel->topic, &TopicContents::topic);
  if (found != topics.end()) return *found;
  topics.push_back({.topic = message.channel->topic, .schema = message.channel->schema_name});
  topics.back().first_time = 1e-9 * static_cast<double>(message.log_time);
  return topics.back();
}

}  // namespace

LogContents read_contents(const std::string& path) {
  LogContents contents;
  contents.header = LogReader(path).header();  // refuses what is not ours
  contents.header.attachments.clear();
  contents.file_bytes = std::filesystem::file_size(path);
  McapReader file(path);
  for (McapMessage message; file.next(message);) {
    TopicContents& topic = topic_of(message, contents.topics);
    ++topic.messages;
    topic.bytes += message.data.size();
    topic.last_time = 1e-9 * static_cast<double>(message.log_time);
  }
  const auto ticks = std::ranges::find(contents.topics, "/command", &TopicContents::topic);
  if (ticks != contents.topics.end()) {
    contents.ticks = ticks->messages;
    contents.first_time = ticks->first_time;
    contents.last_time = ticks->last_time;
  }
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
