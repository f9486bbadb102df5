#pragma once

#include "surefoot/logging/mcap_cursor.hpp"

#include <cstdint>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace surefoot::mcap {

/// What a file's index says of a record.
struct IndexedRecord {
  std::uint64_t offset = 0;
  Opcode opcode{};
  std::uint64_t first_time = 0, last_time = 0;  ///< of a chunk's messages [ns]
};

/// Walks over the records of a file that stand outside of chunks, by their heads alone. Where a
/// head can't be one, it goes on at the next record that the file's index has; of a file without
/// one at the next chunk that it finds. A chunk is known by its sizes and its compression, which
/// fit together, also where its opcode is damaged.
class RecordWalk {
 public:
  /// The file may be unreadable; see `is_open`.
  explicit RecordWalk(const std::string& path);

  [[nodiscard]] bool is_open() const { return is_open_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }  ///< of the file [bytes]

  /// To the next record; false at the file's end, and where nothing more can be found.
  [[nodiscard]] bool next();

  [[nodiscard]] Opcode opcode() const { return opcode_; }
  /// Of the record's head; after the last one, of the first byte that belongs to none.
  [[nodiscard]] std::uint64_t offset() const { return offset_; }
  [[nodiscard]] std::uint64_t length() const { return length_; }  ///< of its content
  /// Bytes before the record that belong to none.
  [[nodiscard]] std::uint64_t skipped() const { return skipped_; }
  /// The records that the file's index has there; empty without one.
  [[nodiscard]] std::span<const IndexedRecord> skipped_records() const;

  /// Bytes of the file. Throws Malformed where they can't be read.
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
  std::optional<std::vector<IndexedRecord>> index_;  // in order; once it was needed
  Opcode opcode_{};
  std::uint64_t offset_ = 0, length_ = 0, skipped_ = 0, next_ = kMagic.size();
};

}  // namespace surefoot::mcap
