#pragma once

#include "surefoot/logging/mcap_format.hpp"

#include <concepts>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

/// Reading of MCAP records, shared by those who read a file from front to back and by chunks.
namespace surefoot::mcap {

inline constexpr std::size_t kRecordHead = 9;  ///< opcode and length [bytes]
inline constexpr std::size_t kMessageHead =
    22;                                         ///< of a message's content, before its data [bytes]
inline constexpr std::size_t kChunkTimes = 16;  ///< at the begin of a chunk's content [bytes]

/// What a record claims does not fit into its bytes.
struct Malformed {
  std::string what;
};

/// A chunk is whole, but compressed as no reader here can undo.
struct OtherCompression {
  std::string name;
  /// In words, without the file's name, and what to do.
  [[nodiscard]] std::string what() const;
};

/// Takes values from the front of some bytes. Throws Malformed beyond their end.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : rest_(bytes) {}

  std::string_view bytes(std::uint64_t count);

  template <std::unsigned_integral Integer>
  Integer number() {
    Integer result = 0;
    unsigned shift = 0;
    for (const char byte : bytes(sizeof(Integer))) {
      result = static_cast<Integer>(result | static_cast<Integer>(static_cast<unsigned char>(byte))
                                                 << shift);
      shift += 8;
    }
    return result;
  }

  std::string text() { return std::string(bytes(number<std::uint32_t>())); }
  std::map<std::string, std::string> map();

  [[nodiscard]] std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

/// Begin of a record.
struct RecordHead {
  Opcode opcode;
  std::uint64_t length;  ///< of its content [bytes]
};

struct ChannelRecord {
  std::uint16_t id, schema;
  std::string topic, encoding;
  std::map<std::string, std::string> metadata;
};

struct MessageRecord {
  std::uint16_t channel;
  std::uint64_t log_time;  ///< [ns]
  std::string_view data;
};

struct AttachmentRecord {
  std::string name;
  std::string_view data;
  bool is_whole = false;  ///< its checksum is right, or it has none
};

[[nodiscard]] RecordHead take_head(Cursor& cursor);
[[nodiscard]] ChannelRecord channel_record(std::string_view content);
[[nodiscard]] MessageRecord message_record(std::string_view content);
[[nodiscard]] AttachmentRecord attachment_record(std::string_view content);

/// The records in a chunk record, decompressed and with the right checksum. Throws Malformed or
/// OtherCompression.
[[nodiscard]] std::string chunk_records(std::string_view chunk);

}  // namespace surefoot::mcap
