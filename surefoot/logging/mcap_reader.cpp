#include "surefoot/logging/mcap_reader.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/logging/crc32.hpp"
#include "surefoot/logging/mcap_cursor.hpp"
#include "surefoot/logging/mcap_format.hpp"
#include "surefoot/logging/partial_log.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>

namespace surefoot::logging {
namespace {

using mcap::Cursor;
using mcap::kRecordHead;
using mcap::Malformed;
using mcap::Opcode;

constexpr std::size_t kMaxReportedLosses = 4;

std::string seconds(std::uint64_t nanoseconds) {
  return formatted("%.4f", 1e-9 * static_cast<double>(nanoseconds));
}

/// An attachment's name for a message, unless it is damaged.
std::string shown(const std::string& name) {
  const bool is_name = !name.empty() && name.size() < 80 &&
                       std::ranges::all_of(name, [](char c) { return c > ' ' && c <= '~'; });
  return is_name ? "the attachment " + name : "an attachment";
}

std::string valid_instead(const std::string& path) {
  const std::string partial = existing_partial(path);
  return partial.empty() ? "a log (.mcap) would be valid"
                         : partial + ", of a run that goes on or was cut off, would be valid";
}

/// The skipped part before a record, with data from the file's index.
McapLoss skipped_loss(const mcap::RecordWalk& file) {
  McapLoss loss{.offset = file.offset() - file.skipped(),
                .size = file.skipped(),
                .why = "a record's head is damaged",
                .may_hold_messages = true};
  const auto records = file.skipped_records();
  if (records.empty() || records.front().offset != loss.offset) return loss;
  loss.may_hold_messages = false;
  for (const mcap::IndexedRecord& record : records) {
    if (record.opcode != Opcode::chunk) continue;
    if (!loss.may_hold_messages) loss.first_time = record.first_time;
    loss.first_time = std::min(loss.first_time, record.first_time);
    loss.last_time = std::max(loss.last_time, record.last_time);
    loss.may_hold_messages = loss.has_times = true;
  }
  return loss;
}

}  // namespace

McapReader::McapReader(const std::string& path) : path_(path), file_(path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    throw FileError(path + ": is a folder; a log in it (.mcap) would be valid");
  }
  if (!file_.is_open()) {
    throw FileError(path + ": no such file, or it can't be read; " + valid_instead(path));
  }
  check_magic();
  while (rest_.empty() && read_record()) {
  }
}

void McapReader::check_magic() {
  const std::string_view whole = mcap::kMagic;
  const std::uint64_t there = std::min<std::uint64_t>(whole.size(), file_.size());
  if (there == 0) throw FileError(path_ + ": the file is empty; a log (.mcap) would be valid");
  try {
    if (file_.bytes(0, there) != whole.substr(0, there)) {
      throw FileError(path_ + ": not an MCAP file; a log made by surefoot (.mcap) would be valid");
    }
  } catch (const Malformed& malformed) {
    throw FileError(path_ + ": " + malformed.what + "; a log (.mcap) would be valid");
  }
  if (there < whole.size()) stop("cut off");
}

bool McapReader::next(McapMessage& message) {
  do {
    try {
      while (!rest_.empty()) {
        if (take_from_chunk(message)) return true;
      }
    } catch (const Malformed& malformed) {
      lose(malformed.what);
    }
  } while (read_record());
  return false;
}

// Reads a record outside of chunks; false at the end.
bool McapReader::read_record() {
  if (ended_) return false;
  try {
    if (!file_.next()) throw Malformed{"cut off"};
    if (file_.skipped() > 0) {
      losses_.push_back(skipped_loss(file_));
      learn_descriptions();
    }
    record_ = file_.content();
  } catch (const Malformed& malformed) {
    stop(malformed.what);
    return false;
  }
  try {
    chunk_offset_ = file_.offset();
    take(file_.opcode(), record_);
  } catch (const Malformed& malformed) {
    lose(malformed.what);
  }
  return !ended_;
}

void McapReader::take(mcap::Opcode opcode, std::string_view content) {
  Cursor cursor(content);
  switch (opcode) {
    case Opcode::schema:
    case Opcode::channel:
      take_descriptions(opcode, content);
      break;
    case Opcode::message: {  // outside of a chunk: treated as a chunk of its own
      const auto length = static_cast<std::uint64_t>(content.size());
      chunk_.assign(1, static_cast<char>(opcode));
      for (unsigned shift = 0; shift < 64; shift += 8)
        chunk_ += static_cast<char>((length >> shift) & 0xFF);
      chunk_ += content;
      rest_ = chunk_;
      break;
    }
    case Opcode::chunk:
      open_chunk(content);
      break;
    case Opcode::attachment: {
      const mcap::AttachmentRecord record = mcap::attachment_record(content);
      if (!record.is_whole) throw Malformed{"the checksum of " + shown(record.name) + " is wrong"};
      attachments_[record.name] = record.data;
      break;
    }
    case Opcode::metadata:
      take_metadata(content);
      break;
    case Opcode::data_end:
      has_all_data_ = true;
      break;
    case Opcode::footer:
      close();
      break;
    default:  // indices, not needed here, and records of later versions
      break;
  }
}

void McapReader::take_descriptions(mcap::Opcode opcode, std::string_view content) {
  if (opcode == Opcode::schema) {
    Cursor cursor(content);
    const auto id = cursor.number<std::uint16_t>();
    McapSchema& schema = schemas_[id];
    schema.name = cursor.text();
    schema.encoding = cursor.text();
    schema.data = cursor.text();
  } else if (opcode == Opcode::channel) {
    const mcap::ChannelRecord channel = mcap::channel_record(content);
    const McapSchema& schema = schemas_[channel.schema];
    channels_[channel.id] = {channel.topic, schema.name, channel.encoding, channel.metadata,
                             schema};
  }
}

void McapReader::take_metadata(std::string_view content) {
  try {
    Cursor cursor(content);
    const std::string name = cursor.text();
    metadata_[name] = cursor.map();
  } catch (const Malformed&) {
    throw Malformed{"the metadata record is damaged"};
  }
}

void McapReader::close() {
  const std::uint64_t end = file_.offset() + kRecordHead + file_.length();
  if (file_.size() - end < mcap::kMagic.size() ||
      file_.bytes(end, mcap::kMagic.size()) != mcap::kMagic) {
    return stop("cut off");
  }
  is_closed_ = ended_ = true;
}

// The chunk of a channel's first message, which describes it, is lost; the file's end repeats it.
void McapReader::learn_descriptions() {
  if (std::exchange(has_learned_, true)) return;
  mcap::RecordWalk behind(path_);
  const auto goes_on = [&] {
    try {
      return behind.next();
    } catch (const Malformed&) {  // continue with the known ones
      return false;
    }
  };
  while (goes_on()) {
    try {
      if (behind.opcode() == Opcode::schema || behind.opcode() == Opcode::channel)
        take_descriptions(behind.opcode(), behind.content());
    } catch (const Malformed&) {  // the others may be intact
    }
  }
}

void McapReader::open_chunk(std::string_view content) {
  try {
    chunk_ = mcap::chunk_records(content);
  } catch (const mcap::OtherCompression& other) {
    throw FileError(path_ + ": " + other.what());
  }
  rest_ = chunk_;
}

// Takes one record from the open chunk; true if it is a message.
bool McapReader::take_from_chunk(McapMessage& message) {
  Cursor cursor(rest_);
  const auto [opcode, length] = mcap::take_head(cursor);
  const std::string_view content = cursor.bytes(length);
  rest_ = cursor.rest();
  if (opcode != Opcode::message) {
    take(opcode, content);
    return false;
  }
  const mcap::MessageRecord record = mcap::message_record(content);
  const auto channel = channels_.find(record.channel);
  if (channel == channels_.end()) throw Malformed{"a message's channel is unknown"};
  message = {&channel->second, record.log_time, record.data};
  return true;
}

// Loses the open record; the file continues after it.
void McapReader::lose(const std::string& why) {
  rest_ = {};
  McapLoss loss{
      .offset = file_.offset(),
      .size = kRecordHead + file_.length(),
      .why = why,
      .may_hold_messages = file_.opcode() == Opcode::chunk || file_.opcode() == Opcode::message};
  if (file_.opcode() == Opcode::chunk) {
    Cursor times(record_);
    loss.first_time = times.number<std::uint64_t>();
    loss.last_time = times.number<std::uint64_t>();
    loss.has_times = mcap::can_be_times(loss.first_time, loss.last_time);
  }
  losses_.push_back(std::move(loss));
  learn_descriptions();
}

void McapReader::stop(const std::string& why) {
  ended_ = true;
  rest_ = {};
  end_ = why + " at byte " + std::to_string(file_.offset());
}

std::string McapReader::place(const std::string& why, std::uint64_t offset) const {
  return why + " at byte " + std::to_string(offset) + " of " + std::to_string(file_.size());
}

std::string McapReader::damage() const {
  return losses_.empty() ? end_ : place(losses_.front().why, losses_.front().offset);
}

std::string McapReader::problem() const {
  std::string text;
  for (std::size_t i = 0; i < std::min(losses_.size(), kMaxReportedLosses); ++i) {
    const McapLoss& loss = losses_[i];
    text += (i == 0 ? "" : ", ") + place(loss.why, loss.offset);
    if (loss.has_times)
      text += " (" + seconds(loss.first_time) + " s to " + seconds(loss.last_time) + " s)";
  }
  if (losses_.size() > kMaxReportedLosses)
    text += " and " + std::to_string(losses_.size() - kMaxReportedLosses) + " more places";
  if (!losses_.empty()) text += "; what stood there is lost, the rest was read";
  if (!end_.empty())
    text += (text.empty() ? "" : "; ") + end_ +
            (has_all_data_ ? ", behind all of the run: only the index of the file is lost"
                           : ": what came behind it is lost, everything before it was read");
  return text;
}

}  // namespace surefoot::logging
