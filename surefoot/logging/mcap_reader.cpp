#include "surefoot/logging/mcap_reader.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/logging/crc32.hpp"
#include "surefoot/logging/mcap_cursor.hpp"
#include "surefoot/logging/mcap_format.hpp"

#include <filesystem>

namespace surefoot {
namespace {

using mcap::Cursor;
using mcap::kRecordHead;
using mcap::Malformed;
using mcap::Opcode;

}  // namespace

McapReader::McapReader(const std::string& path) : path_(path), file_(path, std::ios::binary) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error) || !file_) {
    throw FileError(path + ": no such file, or it can't be read; a log (.mcap) would be valid");
  }
  size_ = std::filesystem::file_size(path);
  if (size_ == 0) throw FileError(path + ": the file is empty; a log (.mcap) would be valid");
  std::string magic(mcap::kMagic.size(), '\0');
  file_.read(magic.data(), static_cast<std::streamsize>(magic.size()));
  const auto got = static_cast<std::size_t>(file_.gcount());
  offset_ = got;
  if (magic.substr(0, got) != mcap::kMagic.substr(0, got)) {
    throw FileError(path + ": not an MCAP file; a log made by surefoot (.mcap) would be valid");
  }
  if (got < magic.size()) stop("cut off");
  while (rest_.empty() && read_record()) {
  }
}

bool McapReader::next(McapMessage& message) {
  try {
    do {
      while (!rest_.empty()) {
        if (take_from_chunk(message)) return true;
      }
    } while (read_record());
  } catch (const Malformed& malformed) {
    stop(malformed.what);
  }
  return false;
}

// Reads one record outside of chunks; false at the end.
bool McapReader::read_record() {
  if (ended_) return false;
  std::string head(kRecordHead, '\0');
  if (size_ - offset_ < kRecordHead || !file_.read(head.data(), kRecordHead)) {
    stop("cut off");
    return false;
  }
  Cursor cursor(head);
  const auto [opcode, length] = mcap::take_head(cursor);
  if (length > size_ - offset_ - kRecordHead) {
    stop("cut off");
    return false;
  }
  record_.resize(length);
  if (!file_.read(record_.data(), static_cast<std::streamsize>(length))) {
    stop("can't be read further");
    return false;
  }
  try {
    chunk_offset_ = offset_;
    take(opcode, record_);
  } catch (const Malformed& malformed) {
    stop(malformed.what);
    return false;
  }
  offset_ += kRecordHead + length;
  return !ended_;
}

void McapReader::take(mcap::Opcode opcode, std::string_view content) {
  Cursor cursor(content);
  switch (opcode) {
    case Opcode::schema: {
      const auto id = cursor.number<std::uint16_t>();
      schemas_[id] = cursor.text();
      break;
    }
    case Opcode::channel: {
      const mcap::ChannelRecord channel = mcap::channel_record(content);
      channels_[channel.id] = {channel.topic, schemas_[channel.schema], channel.encoding,
                               channel.metadata};
      break;
    }
    case Opcode::message: {  // outside of a chunk: a chunk of its own
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
      cursor.bytes(16);  // dates
      const std::string name = cursor.text();
      cursor.text();
      const std::string_view data = cursor.bytes(cursor.number<std::uint64_t>());
      const auto crc = cursor.number<std::uint32_t>();
      if (crc != 0 && crc != crc32(content.substr(0, content.size() - sizeof(crc)))) {
        throw Malformed{"the checksum of an attachment is wrong"};
      }
      attachments_[name] = data;
      break;
    }
    case Opcode::metadata: {
      const std::string name = cursor.text();
      metadata_[name] = cursor.map();
      break;
    }
    case Opcode::footer: {
      std::string magic(mcap::kMagic.size(), '\0');
      file_.read(magic.data(), static_cast<std::streamsize>(magic.size()));
      if (!file_ || magic != mcap::kMagic) throw Malformed{"cut off"};
      complete_ = ended_ = true;
      break;
    }
    default:  // indices, which are not needed here, and records of later versions
      break;
  }
}

void McapReader::open_chunk(std::string_view content) {
  chunk_ = mcap::chunk_records(content);
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

void McapReader::stop(const std::string& why) {
  ended_ = true;
  rest_ = {};
  damage_ = why + " at byte " + std::to_string(offset_) + " of " + std::to_string(size_);
  problem_ = path_ + ": " + damage_ + "; everything before it was read";
}

}  // namespace surefoot
