#include "surefoot/logging/mcap_cursor.hpp"

#include "surefoot/logging/crc32.hpp"

#include <zstd.h>

namespace surefoot::logging::mcap {
namespace {

constexpr std::uint64_t kMaxChunk = 1ull << 30;  // [bytes]
constexpr std::uint64_t kMaxRatio = 1 << 15;     // of zstd, some 20 000 for zeros

std::string decompress(std::string_view compressed, const std::string& compression,
                       std::uint64_t size) {
  if (size > kMaxChunk) throw Malformed{"a chunk claims to be larger than 1 GiB"};
  if (compression.empty()) return std::string(compressed);
  if (compression == "lz4") throw OtherCompression{compression};
  if (compression != "zstd") throw Malformed{"a chunk is not compressed with zstd"};
  const unsigned long long stored = ZSTD_getFrameContentSize(compressed.data(), compressed.size());
  if (stored != ZSTD_CONTENTSIZE_UNKNOWN && stored != size)  // check before allocating
    throw Malformed{"a chunk can't be decompressed"};
  if (size / kMaxRatio > compressed.size()) throw Malformed{"a chunk claims to be too large"};
  std::string out(size, '\0');
  const std::size_t written =
      ZSTD_decompress(out.data(), out.size(), compressed.data(), compressed.size());
  if (ZSTD_isError(written) != 0u || written != size)
    throw Malformed{"a chunk can't be decompressed"};
  return out;
}

}  // namespace

std::string OtherCompression::what() const {
  return "its chunks are compressed with " + name +
         "; chunks with zstd or without compression would be valid: `mcap compress LOG -o NEW.mcap "
         "--compression zstd` rewrites it";
}

std::string_view Cursor::bytes(std::uint64_t count) {
  if (count > rest_.size()) throw Malformed{"a record is shorter than it says"};
  const std::string_view taken = rest_.substr(0, count);
  rest_.remove_prefix(count);
  return taken;
}

std::map<std::string, std::string> Cursor::map() {
  Cursor entries(bytes(number<std::uint32_t>()));
  std::map<std::string, std::string> result;
  while (!entries.rest_.empty()) {
    const std::string key = entries.text();
    result[key] = entries.text();
  }
  return result;
}

RecordHead take_head(Cursor& cursor) {
  const auto opcode = static_cast<Opcode>(cursor.number<std::uint8_t>());
  return {opcode, cursor.number<std::uint64_t>()};
}

ChannelRecord channel_record(std::string_view content) {
  Cursor cursor(content);
  ChannelRecord record;
  record.id = cursor.number<std::uint16_t>();
  record.schema = cursor.number<std::uint16_t>();
  record.topic = cursor.text();
  record.encoding = cursor.text();
  record.metadata = cursor.map();
  return record;
}

MessageRecord message_record(std::string_view content) {
  Cursor cursor(content);
  MessageRecord record;
  record.channel = cursor.number<std::uint16_t>();
  cursor.bytes(4);  // sequence
  record.log_time = cursor.number<std::uint64_t>();
  cursor.bytes(8);  // publish time
  record.data = cursor.rest();
  return record;
}

AttachmentRecord attachment_record(std::string_view content) {
  Cursor cursor(content);
  AttachmentRecord record;
  cursor.bytes(16);  // dates
  record.name = cursor.text();
  cursor.text();  // media type
  record.data = cursor.bytes(cursor.number<std::uint64_t>());
  const auto crc = cursor.number<std::uint32_t>();
  record.is_whole = crc == 0 || crc == crc32(content.substr(0, content.size() - sizeof(crc)));
  return record;
}

std::string chunk_records(std::string_view chunk) {
  Cursor cursor(chunk);
  cursor.bytes(kChunkTimes);
  const auto size = cursor.number<std::uint64_t>();
  const auto crc = cursor.number<std::uint32_t>();
  const std::string compression = cursor.text();
  const std::string records =
      decompress(cursor.bytes(cursor.number<std::uint64_t>()), compression, size);
  if (crc != 0 && crc != crc32(records)) throw Malformed{"the checksum of a chunk is wrong"};
  return records;
}

}  // namespace surefoot::logging::mcap
