#include "surefoot/logging/mcap_chunks.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/logging/mcap_cursor.hpp"
#include "surefoot/logging/mcap_format.hpp"

#include <filesystem>

namespace surefoot {
namespace {

using mcap::Cursor;
using mcap::Malformed;
using mcap::Opcode;

constexpr std::size_t kRecordHead = 9;   // opcode and length
constexpr std::size_t kChunkTimes = 16;  // at the begin of a chunk

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
    const auto opcode = static_cast<Opcode>(cursor.number<std::uint8_t>());
    const auto length = cursor.number<std::uint64_t>();
    if (length > size - offset - kRecordHead) break;
    if (opcode == Opcode::chunk && length >= kChunkTimes) {
      const auto first = cursor.number<std::uint64_t>();
      const auto last = cursor.number<std::uint64_t>();
      chunks_.push_back({offset + kRecordHead, length, first, last});
    }
    complete_ = opcode == Opcode::data_end;
    if (complete_) break;
    offset += kRecordHead + length;
  }
  file_.clear();
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
      const auto opcode = cursor.number<std::uint8_t>();
      take_record(opcode, cursor.bytes(cursor.number<std::uint64_t>()), take);
    }
  } catch (const Malformed& malformed) {
    throw FileError(path_ + ": " + malformed.what + ", in the chunk at byte " +
                    std::to_string(place.offset));
  }
}

void McapChunks::take_record(std::uint8_t opcode, std::string_view content, const Take& take) {
  Cursor fields(content);
  if (static_cast<Opcode>(opcode) == Opcode::channel) {
    const auto id = fields.number<std::uint16_t>();
    fields.bytes(2);  // schema
    const std::string topic = fields.text();
    channels_[id] = {topic, "", fields.text(), fields.map()};
  } else if (static_cast<Opcode>(opcode) == Opcode::message) {
    const auto channel = channels_.find(fields.number<std::uint16_t>());
    fields.bytes(4);  // sequence
    McapMessage message;
    message.log_time = fields.number<std::uint64_t>();
    fields.bytes(8);  // publish time
    message.data = fields.rest();
    if (channel == channels_.end()) return;
    message.channel = &channel->second;
    take(message);
  }
}

}  // namespace surefoot
