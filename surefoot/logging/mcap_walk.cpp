#include "surefoot/logging/mcap_walk.hpp"

#include "surefoot/logging/crc32.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>

namespace surefoot::logging::mcap {
namespace {

constexpr std::string_view kZstd{"\x04\0\0\0zstd", 8};
constexpr std::uint64_t kBeforeCompression = 28;  // of a chunk's content [bytes]
constexpr std::uint64_t kFixedChunkSize = 40;     // of a chunk's content, without records and name
constexpr std::uint64_t kMaxName = 16;            // of a compression [bytes]
constexpr std::uint64_t kFixedIndexSize = 6;      // of a message index's content, without entries
constexpr std::uint64_t kMinSearch = 1 << 12;     // first block of a search [bytes]
constexpr std::uint64_t kMaxSearch = 1 << 20;     // largest block of a search [bytes]
constexpr std::uint64_t kFooterSize = 20;         // content of a footer [bytes]
constexpr std::uint64_t kDataEndSize = kRecordHead + 4;  // the record before the index [bytes]
constexpr std::uint64_t kMaxIndex = 1 << 28;             // [bytes]

// Are the sizes in a record's content consistent? `start` has its first bytes.
bool fits(Opcode opcode, std::string_view start, std::uint64_t length) {
  try {
    Cursor cursor(start);
    if (opcode == Opcode::message_index) {
      cursor.bytes(2);  // channel
      return length == kFixedIndexSize + cursor.number<std::uint32_t>();
    }
    if (opcode != Opcode::chunk) return true;
    cursor.bytes(kBeforeCompression);
    const auto name = cursor.number<std::uint32_t>();
    if (name > kMaxName) return false;
    cursor.bytes(name);
    return length == kFixedChunkSize + name + cursor.number<std::uint64_t>();
  } catch (const Malformed&) {
    return false;
  }
}

bool is_compressed(std::string_view start) {
  return start.size() > kBeforeCompression && start.substr(kBeforeCompression).starts_with(kZstd);
}

/// The record of an index entry.
std::optional<IndexedRecord> record_of(Opcode opcode, std::string_view content) {
  Cursor cursor(content);
  if (opcode == Opcode::chunk_index) {
    const auto first = cursor.number<std::uint64_t>();
    const auto last = cursor.number<std::uint64_t>();
    return IndexedRecord{cursor.number<std::uint64_t>(), Opcode::chunk, first, last};
  }
  if (opcode == Opcode::attachment_index)
    return IndexedRecord{cursor.number<std::uint64_t>(), Opcode::attachment};
  if (opcode == Opcode::metadata_index)
    return IndexedRecord{cursor.number<std::uint64_t>(), Opcode::metadata};
  return std::nullopt;
}

}  // namespace

RecordWalk::RecordWalk(const std::string& path) : file_(path, std::ios::binary) {
  std::error_code error;
  is_open_ = file_.is_open() && std::filesystem::is_regular_file(path, error);
  if (is_open_) size_ = std::filesystem::file_size(path);
}

std::string RecordWalk::bytes(std::uint64_t offset, std::uint64_t count) {
  if (offset > size_ || count > size_ - offset) throw Malformed{"cut off"};
  std::string result(count, '\0');
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(offset));
  if (!file_.read(result.data(), static_cast<std::streamsize>(count)))
    throw Malformed{"can't be read"};
  return result;
}

bool RecordWalk::next() {
  offset_ = next_;
  skipped_ = 0;
  if (is_record(offset_)) {
    next_ = offset_ + kRecordHead + length_;
    return true;
  }
  const std::uint64_t damaged = offset_;
  if (!find_record(damaged + 1)) return false;
  skipped_ = offset_ - damaged;
  next_ = offset_ + kRecordHead + length_;
  return true;
}

// Can a record begin here? If so, sets opcode and length.
bool RecordWalk::is_record(std::uint64_t offset) {
  if (offset > size_ || size_ - offset < kRecordHead) return false;
  constexpr std::uint64_t kStart = kRecordHead + kFixedChunkSize + kMaxName;
  const std::string start = bytes(offset, std::min(kStart, size_ - offset));
  Cursor cursor(start);
  const auto [opcode, length] = take_head(cursor);
  if (length > size_ - offset - kRecordHead) return false;
  const std::string_view content = cursor.rest();
  const bool is_chunk = is_compressed(content) && fits(Opcode::chunk, content, length);
  const bool is_known = static_cast<std::uint8_t>(opcode) != 0;  // 0: a file's empty tail
  if (!is_chunk && (!is_known || !fits(opcode, content, length))) return false;
  opcode_ = is_chunk ? Opcode::chunk : opcode;
  length_ = length;
  return true;
}

// Finds the next possible record and sets its place. An index alone decides, because another
// record's data may look like a chunk.
bool RecordWalk::find_record(std::uint64_t from) {
  if (!index_) index_ = read_index();
  if (index_->empty()) return find_chunk(from);
  for (auto place = std::ranges::lower_bound(*index_, from, {}, &IndexedRecord::offset);
       place != index_->end(); ++place) {
    if (!is_record(place->offset)) continue;
    offset_ = place->offset;
    return true;
  }
  return false;
}

std::span<const IndexedRecord> RecordWalk::skipped_records() const {
  if (!index_) return {};
  const auto at = [this](std::uint64_t offset) {
    return std::ranges::lower_bound(*index_, offset, {}, &IndexedRecord::offset);
  };
  return {at(offset_ - skipped_), at(offset_)};
}

// Places of the records in a closed file's index, and of the index itself; empty if it is damaged
// or missing.
std::vector<IndexedRecord> RecordWalk::read_index() {
  std::vector<IndexedRecord> records;
  try {
    const std::uint64_t behind = kRecordHead + kFooterSize + kMagic.size();
    if (size_ < behind) return {};
    const std::string end = bytes(size_ - behind, behind);
    Cursor footer(end);
    const auto [opcode, length] = take_head(footer);
    const auto begin = footer.number<std::uint64_t>();
    footer.bytes(sizeof(std::uint64_t));  // start of the summary offsets
    const auto crc = footer.number<std::uint32_t>();
    const bool is_footer =
        opcode == Opcode::footer && length == kFooterSize && footer.rest() == kMagic;
    const std::uint64_t summed = size_ - kMagic.size() - sizeof(crc);
    if (!is_footer || begin == 0 || begin > summed || summed - begin > kMaxIndex) return {};
    const std::string summary = bytes(begin, summed - begin);
    if (crc != 0 && crc != crc32(summary)) return {};
    records.push_back({.offset = begin});
    if (begin > kDataEndSize) records.push_back({begin - kDataEndSize, Opcode::data_end});
    for (Cursor rest(std::string_view(summary).substr(0, size_ - behind - begin));
         !rest.rest().empty();) {
      const auto [kind, size] = take_head(rest);
      if (const auto record = record_of(kind, rest.bytes(size))) records.push_back(*record);
    }
  } catch (const Malformed&) {
    return {};
  }
  std::ranges::sort(records, {}, &IndexedRecord::offset);
  return records;
}

// Finds the next compressed chunk and sets its place.
bool RecordWalk::find_chunk(std::uint64_t from) {
  constexpr std::uint64_t kToName = kRecordHead + kBeforeCompression;
  std::uint64_t sought = kMinSearch;
  for (std::uint64_t begin = from + kToName; begin < size_;
       begin += sought, sought = std::min(2 * sought, kMaxSearch)) {
    const std::string part = bytes(begin, std::min(sought + kZstd.size(), size_ - begin));
    for (std::size_t found = part.find(kZstd); found != std::string::npos;
         found = part.find(kZstd, found + 1)) {
      const std::uint64_t offset = begin + found - kToName;
      if (!is_record(offset) || opcode_ != Opcode::chunk) continue;
      offset_ = offset;
      return true;
    }
  }
  return false;
}

}  // namespace surefoot::logging::mcap
