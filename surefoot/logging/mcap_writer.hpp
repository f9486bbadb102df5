#pragma once

#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace surefoot::logging {

struct McapWriterOptions {
  std::string profile;
  std::string library = "surefoot";
  std::size_t chunk_bytes = 1 << 20;                ///< size that closes a chunk
  std::uint64_t chunk_nanoseconds = 1'000'000'000;  ///< log time that closes a chunk
  int compression_level = 1;                        ///< of zstd
};

/// Writes an MCAP file (https://mcap.dev/spec): messages in chunks compressed with zstd, with
/// checksums, indices, attachments, metadata, statistics and a summary. The same calls give the
/// same bytes. Each chunk is in the file when the next begins. All calls throw FileError, with the
/// path, if the file can't be written.
class McapWriter {
 public:
  using Metadata = std::map<std::string, std::string>;

  explicit McapWriter(const std::string& path, McapWriterOptions options = {});
  /// Without `close`, closes the file as it is, without a summary.
  ~McapWriter() = default;

  [[nodiscard]] std::uint16_t add_schema(std::string name, std::string encoding, std::string data);
  [[nodiscard]] std::uint16_t add_channel(std::string topic, std::uint16_t schema,
                                          std::string message_encoding, Metadata metadata = {});
  /// Schema and channel records are in the chunk of a channel's first message.
  void write(std::uint16_t channel, std::uint64_t log_time, std::string_view data);
  /// Ends an open chunk and hands everything to the operating system.
  void flush();
  void attach(std::string_view name, std::string_view media_type, std::string_view data);
  void add_metadata(std::string_view name, const Metadata& metadata);
  /// Writes summary and footer and closes the file.
  void close();

 private:
  struct Schema {
    std::string name, encoding, data;
    bool written = false;
  };
  struct Channel {
    std::string topic, message_encoding;
    std::uint16_t schema = 0;
    Metadata metadata;
    bool written = false;
    std::uint32_t sequence = 0;  // number of messages so far
    // log time and offset in the open chunk, of its messages
    std::vector<std::pair<std::uint64_t, std::uint64_t>> index{};
  };
  struct Times {
    std::uint64_t first = UINT64_MAX, last = 0;
    void add(std::uint64_t time);
  };
  struct CloseFile {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  struct FreeContext {
    void operator()(void* context) const;
  };

  void define(std::uint16_t channel);
  void end_chunk();
  std::string chunk_record();
  void write_index(std::uint64_t chunk_start, std::uint64_t chunk_length,
                   std::uint64_t compressed_size);
  std::string statistics() const;
  std::string schema_record(std::uint16_t id) const;
  std::string channel_record(std::uint16_t id) const;
  void append(std::string_view bytes);
  [[noreturn]] void fail(const char* what) const;

  std::string path_;
  McapWriterOptions options_;
  std::unique_ptr<std::FILE, CloseFile> file_;
  std::unique_ptr<void, FreeContext> compressor_;
  std::uint64_t offset_ = 0;       // bytes in the file
  std::uint32_t data_crc_ = 0;     // of all of them
  std::vector<Schema> schemas_;    // id − 1
  std::vector<Channel> channels_;  // id − 1
  std::string chunk_;              // records of the open chunk
  std::string compressed_;
  Times chunk_times_, times_;
  std::uint64_t message_count_ = 0;
  std::uint32_t chunk_count_ = 0, attachment_count_ = 0, metadata_count_ = 0;
  std::string chunk_index_, attachment_index_, metadata_index_;  // records of the summary
};

}  // namespace surefoot::logging
