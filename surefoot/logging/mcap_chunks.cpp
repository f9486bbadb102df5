#include "surefoot/logging/mcap_chunks.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/logging/mcap_cursor.hpp"
#include "surefoot/logging/mcap_format.hpp"

#include <filesystem>

namespace surefoot {
namespace {

using mcap::Cursor;
using mcap::kChunkTimes;
using mcap::kRecordHead;
using mcap::Malformed;
using mcap::Opcode;

constexpr std::uint64_t kLargestChannel = 1 << 20;

}  // namespace

McapChunks::McapChunks(const std::string& path) : path_(path), file_(path, std::ios::binary) {
  if (!file_) throw FileError(path + ": can't be read");
  find_chunks();
}

void McapChunks::find_chunks() {
  const std::uint64_t size = std::filesystem::file_size(path_);
  std::uint64_t offset = mcap::kMagic.size();
  std::string head(kRecordHead + kChunkTimes, '\0');
  while (offset + head.size() <= size) {
    file_.seekg(static_cast<std::streamoff>(offset));
    if (!file_.read(head.data(), static_cast<std::streamsize>(head.size()))) break;
    Cursor cursor(head);
    const auto [opcode, length] = mcap::take_head(cursor);
    if (length > size - offset - kRecordHead) break;
    if (opcode == Opcode::chunk && length >= kChunkTimes) {
      const auto first = cursor.number<std::uint64_t>();
      const auto last = cursor.number<std::uint64_t>();
      chunks_.push_back({offset + kRecordHead, length, first, last});
    }
    complete_ = complete_ || opcode == Opcode::data_end;
    if (opcode == Opcode::channel && length < kLargestChannel) {
      learn_channel(offset + kRecordHead, length);
    }
    offset += kRecordHead + length;
  }
  file_.clear();
}

// One that is described outside of chunks, as behind the data all are.
void McapChunks::learn_channel(std::uint64_t offset, std::uint64_t length) {
  std::string content(length, '\0');
  file_.seekg(static_cast<std::streamoff>(offset));
  if (!file_.read(content.data(), static_cast<std::streamsize>(length))) return;
  try {
    keep(mcap::channel_record(content));
  } catch (const Malformed&) {  // then its messages in the chunks tell it
  }
}

void McapChunks::keep(const mcap::ChannelRecord& channel) {
  channels_[channel.id] = {channel.topic, "", channel.encoding, channel.metadata};
}

void McapChunks::read(std::size_t chunk, const Take& take) {
  const McapChunk& place = chunks_.at(chunk);
  try {
    std::string content(place.size, '\0');
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(place.offset));
    if (!file_.read(content.data(), static_cast<std::streamsize>(content.size()))) {
      throw Malformed{"can't be read"};
    }
    const std::string records = mcap::chunk_records(content);
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
