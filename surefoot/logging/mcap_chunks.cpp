#include "surefoot/logging/mcap_chunks.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/logging/mcap_cursor.hpp"
#include "surefoot/logging/mcap_format.hpp"

#include <algorithm>
#include <limits>

namespace surefoot::logging {
namespace {

using mcap::Cursor;
using mcap::kChunkTimes;
using mcap::kMessageHead;
using mcap::kRecordHead;
using mcap::Malformed;
using mcap::Opcode;

constexpr std::uint64_t kDatesSize = 16;               // of an attachment [bytes]
constexpr std::uint64_t kMaxHead = 1024;               // of an attachment, with its name [bytes]
constexpr std::uint64_t kMaxChannel = 1 << 20;         // of its record [bytes]
constexpr std::uint64_t kMaxBareSize = 1 << 22;        // of messages taken together [bytes]
constexpr std::uint64_t kMaxBareTime = 1'000'000'000;  // of messages taken together [ns]
constexpr std::uint64_t kBeforeTime = 6;               // of a message's content [bytes]

}  // namespace

McapChunks::McapChunks(const std::string& path) : path_(path), file_(path) {
  if (!file_.is_open()) throw FileError(path + ": can't be read");
  try {
    find_chunks();
  } catch (const Malformed&) {  // keep the chunks found so far
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
      chunks_.push_back({file_.offset(), kRecordHead + file_.length(), first, last});
      if (!mcap::can_be_times(first, last)) learn_times(chunks_.back());
    }
    if (file_.opcode() == Opcode::message) add_bare_message();
    if (file_.opcode() == Opcode::attachment)
      attachments_.push_back({file_.offset() + kRecordHead, file_.length()});
    complete_ = complete_ || file_.opcode() == Opcode::data_end;
    if (file_.opcode() == Opcode::channel && file_.length() < kMaxChannel) learn_channel();
  }
}

std::string McapChunks::attachment(const std::string& name) {
  for (auto place = attachments_.rbegin(); place != attachments_.rend(); ++place) {
    try {
      const std::string start = file_.bytes(place->offset, std::min(place->length, kMaxHead));
      Cursor cursor(start);
      cursor.bytes(kDatesSize);
      if (cursor.text() != name) continue;
      const std::string content = file_.bytes(place->offset, place->length);
      const mcap::AttachmentRecord record = mcap::attachment_record(content);
      if (record.is_whole) return std::string(record.data);
    } catch (const Malformed&) {  // damaged; an earlier one may be intact
    }
  }
  return "";
}

void McapChunks::add_bare_message() {
  if (file_.length() < kMessageHead) {
    ++num_lost_;
    return;
  }
  const std::string start =
      file_.bytes(file_.offset() + kRecordHead + kBeforeTime, sizeof(std::uint64_t));
  const auto time = Cursor(start).number<std::uint64_t>();
  const std::uint64_t size = kRecordHead + file_.length();
  const bool goes_on = !chunks_.empty() && chunks_.back().is_bare &&
                       chunks_.back().offset + chunks_.back().size == file_.offset() &&
                       chunks_.back().size < kMaxBareSize && time >= chunks_.back().last_time &&
                       time - chunks_.back().first_time < kMaxBareTime;
  if (!goes_on) {
    chunks_.push_back({file_.offset(), size, time, time, true});
    return;
  }
  chunks_.back().size += size;
  chunks_.back().last_time = time;
}

// A channel described outside of chunks, as all are after the data.
void McapChunks::learn_channel() {
  try {
    keep(mcap::channel_record(file_.content()));
  } catch (const Malformed&) {  // its messages' chunks describe it, too
  }
}

void McapChunks::learn_times(McapChunk& chunk) {
  std::uint64_t first = std::numeric_limits<std::uint64_t>::max(), last = 0;
  try {
    const std::string bytes = records(chunk);
    for (Cursor cursor(bytes); !cursor.rest().empty();) {
      const auto [opcode, length] = mcap::take_head(cursor);
      const std::string_view content = cursor.bytes(length);
      if (opcode != Opcode::message) continue;
      const std::uint64_t time = mcap::message_record(content).log_time;
      first = std::min(first, time);
      last = std::max(last, time);
    }
  } catch (const Malformed&) {  // unreadable
    return;
  } catch (const mcap::OtherCompression&) {
    return;
  }
  if (first > last) return;
  chunk.first_time = first;
  chunk.last_time = last;
  chunk.has_sure_times = true;
}

void McapChunks::keep(const mcap::ChannelRecord& channel) {
  channels_[channel.id] = {channel.topic, "", channel.encoding, channel.metadata};
}

std::string McapChunks::records(const McapChunk& chunk) {
  if (chunk.is_bare) return file_.bytes(chunk.offset, chunk.size);
  return mcap::chunk_records(file_.bytes(chunk.offset + kRecordHead, chunk.size - kRecordHead));
}

void McapChunks::read(std::size_t chunk, const Take& take) {
  const McapChunk& place = chunks_.at(chunk);
  std::vector<std::uint64_t> lost;  // their offsets
  try {
    const std::string bytes = records(place);
    Cursor cursor(bytes);
    while (!cursor.rest().empty()) {
      const std::uint64_t offset = place.offset + bytes.size() - cursor.rest().size();
      const auto [opcode, length] = mcap::take_head(cursor);
      const bool is_taken = take_record(opcode, cursor.bytes(length), take);
      if (!is_taken && place.is_bare) lost.push_back(offset);
    }
  } catch (const mcap::OtherCompression& other) {
    throw FileError(path_ + ": " + other.what());
  } catch (const Malformed& malformed) {
    throw FileError(path_ + ": " + malformed.what + ", in the chunk at byte " +
                    std::to_string(place.offset));
  }
  if (lost.empty()) return;
  const std::string more =
      lost.size() == 1 ? "" : ", and of " + std::to_string(lost.size() - 1) + " more behind it";
  throw FileError(path_ + ": the channel of the message at byte " + std::to_string(lost.front()) +
                  " is unknown" + more);
}

// False for a message of an unknown channel.
bool McapChunks::take_record(mcap::Opcode opcode, std::string_view content, const Take& take) {
  if (opcode == Opcode::channel) keep(mcap::channel_record(content));
  if (opcode != Opcode::message) return true;
  const mcap::MessageRecord record = mcap::message_record(content);
  const auto channel = channels_.find(record.channel);
  if (channel == channels_.end()) return false;
  take({&channel->second, record.log_time, record.data});
  return true;
}

}  // namespace surefoot::logging
