#pragma once

#include "surefoot/logging/mcap_cursor.hpp"

#include <cstdint>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace surefoot::logging::mcap {

/// A record in the file's index.
struct IndexedRecord {
  std::uint64_t offset = 0;
  Opcode opcode{};
  std::uint64_t first_time = 0, last_time = 0;  ///< of a chunk's messages [ns]
};

/// Walks over a file's records outside of chunks, by their heads. After an impossible head it
/// continues at the next record of the file's index, or without an index at the next chunk that it
/// finds. Consistent sizes and compression identify a chunk even if its opcode is damaged.
class RecordWalk {
 public:
  /// The file may be unreadable: see `is_open`.
  explicit RecordWalk(const std::string& path);

  [[nodiscard]] bool is_open() const { return is_open_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }  ///< of the file [bytes]

  /// To the next record; false at the file's end, or if nothing more is found.
  [[nodiscard]] bool next();

  [[nodiscard]] Opcode opcode() const { return opcode_; }
  /// Of the record's head; after the last one, of the first byte after all records.
  [[nodiscard]] std::uint64_t offset() const { return offset_; }
  [[nodiscard]] std::uint64_t length() const { return length_; }  ///< of its content
  /// Bytes skipped before the record.
  [[nodiscard]] std::uint64_t skipped() const { return skipped_; }
  /// The index's records in them; empty without an index.
  [[nodiscard]] std::span<const IndexedRecord> skipped_records() const;

  /// Bytes of the file. Throws Malformed if they can't be read.
  [[nodiscard]] std::string bytes(std::uint64_t offset, std::uint64_t count);
  [[nodiscard]] std::string content() { return bytes(offset_ + kRecordHead, length_); }

 private:
  [[nodiscard]] bool is_record(std::uint64_t offset);
  [[nodiscard]] bool find_record(std::uint64_t from);
  [[nodiscard]] bool find_chunk(std::uint64_t from);
  [[nodiscard]] std::vector<IndexedRecord> read_index();

  std::ifstream file_;
  bool is_open_ = false;
  std::uint64_t size_ = 0;
  std::optional<std::vector<IndexedRecord>> index_;  // sorted; read when needed
  Opcode opcode_{};
  std::uint64_t offset_ = 0, length_ = 0, skipped_ = 0, next_ = kMagic.size();
};

}  // namespace surefoot::logging::mcap
