#include "surefoot/logging/mend_log.hpp"

#include "surefoot/logging/mcap_reader.hpp"
#include "surefoot/logging/mcap_writer.hpp"
#include "surefoot/logging/whole_file.hpp"

#include <map>
#include <set>
#include <string_view>

namespace surefoot::logging {
namespace {

std::string_view media_type(std::string_view name) {
  if (name.ends_with(".json")) return "application/json";
  if (name.ends_with(".yaml")) return "application/yaml";
  return name.ends_with(".xml") || name.ends_with(".urdf") ? "application/xml" : "text/plain";
}

/// Copies what a reader has, each part once.
class Copy {
 public:
  Copy(const McapReader& from, const std::string& to) : from_(from), to_(to) {}

  void attachments() {
    for (const auto& [name, data] : from_.attachments())
      if (copied_.insert(name).second) to_.attach(name, media_type(name), data);
  }

  void message(const McapMessage& message) {
    const auto [id, is_new] = channels_.try_emplace(message.channel->topic);
    if (is_new) id->second = described(*message.channel);
    to_.write(id->second, message.log_time, message.data);
  }

  void close() {
    attachments();  // those behind the messages
    for (const auto& [name, metadata] : from_.metadata()) to_.add_metadata(name, metadata);
    to_.close();
  }

 private:
  std::uint16_t described(const McapChannel& channel) {
    const McapSchema& schema = channel.schema;
    const std::uint16_t id =
        schema.name.empty() ? 0 : to_.add_schema(schema.name, schema.encoding, schema.data);
    return to_.add_channel(channel.topic, id, channel.message_encoding, channel.metadata);
  }

  const McapReader& from_;
  McapWriter to_;
  std::set<std::string> copied_;
  std::map<std::string, std::uint16_t> channels_;
};

}  // namespace

std::string mend_log(const std::string& from, const std::string& to) {
  McapReader source(from);
  WholeFile file(to);
  Copy copy(source, file.partial());
  copy.attachments();
  for (McapMessage message; source.next(message);) copy.message(message);
  copy.close();
  file.finish();
  return source.problem();
}

}  // namespace surefoot::logging
