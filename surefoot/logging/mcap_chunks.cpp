#include "surefoot/logging/mcap_chunks.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/logging/mcap_cursor.hpp"
#include "surefoot/logging/mcap_format.hpp"

namespace surefoot {
namespace {

using mcap::Cursor;
using mcap::kChunkTimes;
using mcap::kRecordHead;
using mcap::Malformed;
using mcap::Opcode;

constexpr std::uint64_t kLargestChannel = 1 << 20;

}  // namespace

McapChunks::McapChunks(const std::string& path) : path_(path), file_(path) {
  if (!file_.is_open()) throw FileError(path + ": can't be read");
  try {
    find_chunks();
  } catch (const Malformed&) {  // what was found so far
  }
}

void McapChunks::find_chunks() {
  while (file_.next()) {
    if (file_.skipped() > 0) ++num_lost_;
    if (file_.opcode() == Opcode::chunk) {
      const std::string times = file_.bytes(file_.offset() + kRecordHead, kChunkTimes);
      Cursor cursor(times);
      const auto first = cursor.number<std::uint64_t>();
      const auto last = cursor.number<std::uint64_t>();
      chunks_.push_back({file_.offset() + kRecordHead, file_.length(), first, last});
    }
    complete_ = complete_ || file_.opcode() == Opcode::data_end;
    if (file_.opcode() == Opcode::channel && file_.length() < kLargestChannel) learn_channel();
  }
}

// One that is described outside of chunks, as behind the data all are.
void McapChunks::learn_channel() {
  try {
    keep(mcap::channel_record(file_.content()));
  } catch (const Malformed&) {  // then its messages in the chunks tell it
  }
}

void McapChunks::keep(const mcap::ChannelRecord& channel) {
  channels_[channel.id] = {channel.topic, "", channel.encoding, channel.metadata};
}

void McapChunks::read(std::size_t chunk, const Take& take) {
  const McapChunk& place = chunks_.at(chunk);
  try {
    const std::string records = mcap::chunk_records(file_.bytes(place.offset, place.size));
    Cursor cursor(records);
    while (!cursor.rest().empty()) {
      const auto [opcode, length] = mcap::take_head(cursor);
      take_record(opcode, cursor.bytes(length), take);
    }
  } catch (const Malformed& malformed) {
    throw FileError(path_ + ": " + malformed.what + ", in the chunk at byte " +
                    std::to_string(place.offset));
  }
}

void McapChunks::take_record(mcap::Opcode opcode, std::string_view content, const Take& take) {
  if (opcode == Opcode::channel) keep(mcap::channel_record(content));
  if (opcode != Opcode::message) return;
  const mcap::MessageRecord record = mcap::message_record(content);
  const auto channel = channels_.find(record.channel);
  if (channel != channels_.end()) take({&channel->second, record.log_time, record.data});
}

}  // namespace surefoot
