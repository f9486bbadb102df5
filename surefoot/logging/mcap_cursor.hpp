#pragma once

#include "surefoot/logging/mcap_format.hpp"

#include <concepts>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>

/// Reading of MCAP records, from front to back or by chunks.
namespace surefoot::logging::mcap {

inline constexpr std::size_t kRecordHead = 9;  ///< opcode and length [bytes]
inline constexpr std::size_t kMessageHead =
    22;                                         ///< of a message's content, before its data [bytes]
inline constexpr std::size_t kChunkTimes = 16;  ///< at the start of a chunk's content [bytes]

/// A record's claims don't fit its bytes.
struct Malformed {
  std::string what;
};

/// A chunk is intact, but has an unsupported compression.
struct OtherCompression {
  std::string name;
  /// Error text with advice, without the file's name.
  [[nodiscard]] std::string what() const;
};

/// Takes values from the front of a byte string. Throws Malformed beyond its end.
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

/// Start of a record.
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
  bool is_whole = false;  ///< the checksum is correct or absent
};

[[nodiscard]] RecordHead take_head(Cursor& cursor);
[[nodiscard]] ChannelRecord channel_record(std::string_view content);
[[nodiscard]] MessageRecord message_record(std::string_view content);
[[nodiscard]] AttachmentRecord attachment_record(std::string_view content);

/// The records in a chunk record, decompressed, with a correct checksum. Throws Malformed or
/// OtherCompression.
[[nodiscard]] std::string chunk_records(std::string_view chunk);

}  // namespace surefoot::logging::mcap
