#include "surefoot/logging/mcap_writer.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/logging/crc32.hpp"
#include "surefoot/logging/mcap_format.hpp"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <concepts>
#include <cstring>

namespace surefoot::logging {
namespace {

using mcap::Opcode;

template <std::unsigned_integral Integer>
void put(std::string& out, Integer number) {
  for (std::size_t i = 0; i < sizeof(Integer); ++i) {
    out += static_cast<char>(number & 0xFF);
    if constexpr (sizeof(Integer) > 1) number = static_cast<Integer>(number >> 8);
  }
}

void put_text(std::string& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  out += text;
}

void put_map(std::string& out, const McapWriter::Metadata& map) {
  std::string entries;
  for (const auto& [key, value] : map) {
    put_text(entries, key);
    put_text(entries, value);
  }
  put_text(out, entries);
}

std::string record(Opcode opcode, std::string_view content) {
  std::string out;
  put(out, static_cast<std::uint8_t>(opcode));
  put(out, static_cast<std::uint64_t>(content.size()));
  out += content;
  return out;
}

}  // namespace

void McapWriter::Times::add(std::uint64_t time) {
  first = std::min(first, time);
  last = std::max(last, time);
}

void McapWriter::FreeContext::operator()(void* context) const {
  ZSTD_freeCCtx(static_cast<ZSTD_CCtx*>(context));
}

McapWriter::McapWriter(const std::string& path, McapWriterOptions options)
    : path_(path),
      options_(std::move(options)),
      file_(std::fopen(path.c_str(), "wb")),
      compressor_(ZSTD_createCCtx()) {
  if (!file_) fail("can't be opened for writing");
  append(mcap::kMagic);
  std::string header;
  put_text(header, options_.profile);
  put_text(header, options_.library);
  append(record(Opcode::header, header));
}

std::uint16_t McapWriter::add_schema(std::string name, std::string encoding, std::string data) {
  schemas_.push_back({std::move(name), std::move(encoding), std::move(data)});
  return static_cast<std::uint16_t>(schemas_.size());
}

std::uint16_t McapWriter::add_channel(std::string topic, std::uint16_t schema,
                                      std::string message_encoding, Metadata metadata) {
  channels_.push_back({std::move(topic), std::move(message_encoding), schema, std::move(metadata)});
  return static_cast<std::uint16_t>(channels_.size());
}

void McapWriter::write(std::uint16_t channel_id, std::uint64_t log_time, std::string_view data) {
  const bool spans_enough =
      !chunk_.empty() && log_time >= chunk_times_.first + options_.chunk_nanoseconds;
  if (chunk_.size() >= options_.chunk_bytes || spans_enough) end_chunk();
  define(channel_id);
  Channel& channel = channels_[channel_id - 1];
  channel.index.emplace_back(log_time, chunk_.size());
  put(chunk_, static_cast<std::uint8_t>(Opcode::message));
  put(chunk_, static_cast<std::uint64_t>(22 + data.size()));
  put(chunk_, channel_id);
  put(chunk_, channel.sequence++);
  put(chunk_, log_time);
  put(chunk_, log_time);  // published when logged
  chunk_ += data;
  chunk_times_.add(log_time);
  times_.add(log_time);
  ++message_count_;
}

void McapWriter::define(std::uint16_t channel_id) {
  Channel& channel = channels_[channel_id - 1];
  if (channel.written) return;
  if (channel.schema != 0 && !schemas_[channel.schema - 1u].written) {
    chunk_ += schema_record(channel.schema);
    schemas_[channel.schema - 1u].written = true;
  }
  chunk_ += channel_record(channel_id);
  channel.written = true;
}

void McapWriter::flush() {
  end_chunk();
  if (std::fflush(file_.get()) != 0) fail("can't be written");
}

void McapWriter::end_chunk() {
  if (chunk_.empty()) return;
  const std::string header = chunk_record();
  const std::uint64_t start = offset_;
  append(header);
  append(compressed_);
  write_index(start, offset_ - start, compressed_.size());
  ++chunk_count_;
  chunk_.clear();
  chunk_times_ = {};
  if (std::fflush(file_.get()) != 0) fail("can't be written");
}

// Compresses the open chunk and returns its record up to the compressed bytes.
std::string McapWriter::chunk_record() {
  compressed_.resize(ZSTD_compressBound(chunk_.size()));
  const std::size_t size = ZSTD_compressCCtx(static_cast<ZSTD_CCtx*>(compressor_.get()),
                                             compressed_.data(), compressed_.size(), chunk_.data(),
                                             chunk_.size(), options_.compression_level);
  if (ZSTD_isError(size) != 0u) fail(ZSTD_getErrorName(size));
  compressed_.resize(size);
  std::string content;
  put(content, chunk_times_.first);
  put(content, chunk_times_.last);
  put(content, static_cast<std::uint64_t>(chunk_.size()));
  put(content, crc32(chunk_));
  put_text(content, "zstd");
  put(content, static_cast<std::uint64_t>(compressed_.size()));
  std::string header;
  put(header, static_cast<std::uint8_t>(Opcode::chunk));
  put(header, static_cast<std::uint64_t>(content.size() + compressed_.size()));
  return header + content;
}

// Writes a chunk's message indices, and its entry of the summary.
void McapWriter::write_index(std::uint64_t chunk_start, std::uint64_t chunk_length,
                             std::uint64_t compressed_size) {
  const std::uint64_t index_start = offset_;
  std::string offsets;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    auto& index = channels_[i].index;
    if (index.empty()) continue;
    const auto id = static_cast<std::uint16_t>(i + 1);
    put(offsets, id);
    put(offsets, offset_);
    std::string content;
    put(content, id);
    put(content, static_cast<std::uint32_t>(16 * index.size()));
    for (const auto& [time, position] : index) {
      put(content, time);
      put(content, position);
    }
    append(record(Opcode::message_index, content));
    index.clear();
  }
  std::string content;
  put(content, chunk_times_.first);
  put(content, chunk_times_.last);
  put(content, chunk_start);
  put(content, chunk_length);
  put_text(content, offsets);
  put(content, offset_ - index_start);
  put_text(content, "zstd");
  put(content, compressed_size);
  put(content, static_cast<std::uint64_t>(chunk_.size()));
  chunk_index_ += record(Opcode::chunk_index, content);
}

void McapWriter::attach(std::string_view name, std::string_view media_type, std::string_view data) {
  end_chunk();
  constexpr std::uint64_t kNoTime = 0;  // a date would make each file different
  std::string content;
  put(content, kNoTime);
  put(content, kNoTime);
  put_text(content, name);
  put_text(content, media_type);
  put(content, static_cast<std::uint64_t>(data.size()));
  content += data;
  put(content, crc32(content));
  const std::string bytes = record(Opcode::attachment, content);
  std::string index;
  put(index, offset_);
  put(index, static_cast<std::uint64_t>(bytes.size()));
  put(index, kNoTime);
  put(index, kNoTime);
  put(index, static_cast<std::uint64_t>(data.size()));
  put_text(index, name);
  put_text(index, media_type);
  attachment_index_ += record(Opcode::attachment_index, index);
  ++attachment_count_;
  append(bytes);
}

void McapWriter::add_metadata(std::string_view name, const Metadata& metadata) {
  end_chunk();
  std::string content;
  put_text(content, name);
  put_map(content, metadata);
  const std::string bytes = record(Opcode::metadata, content);
  std::string index;
  put(index, offset_);
  put(index, static_cast<std::uint64_t>(bytes.size()));
  put_text(index, name);
  metadata_index_ += record(Opcode::metadata_index, index);
  ++metadata_count_;
  append(bytes);
}

void McapWriter::close() {
  end_chunk();
  std::string data_end;
  put(data_end, data_crc_);
  append(record(Opcode::data_end, data_end));

  std::string schemas, channels;
  for (std::uint16_t id = 1; id <= schemas_.size(); ++id) {
    if (schemas_[id - 1u].written) schemas += schema_record(id);
  }
  for (std::uint16_t id = 1; id <= channels_.size(); ++id) {
    if (channels_[id - 1u].written) channels += channel_record(id);
  }
  const std::array<std::pair<Opcode, std::string>, 6> groups{{
      {Opcode::schema, schemas},
      {Opcode::channel, channels},
      {Opcode::statistics, statistics()},
      {Opcode::chunk_index, chunk_index_},
      {Opcode::attachment_index, attachment_index_},
      {Opcode::metadata_index, metadata_index_},
  }};
  const std::uint64_t summary_start = offset_;
  std::string summary, offsets;
  for (const auto& [opcode, records] : groups) {
    if (records.empty()) continue;
    std::string content;
    put(content, static_cast<std::uint8_t>(opcode));
    put(content, summary_start + summary.size());
    put(content, static_cast<std::uint64_t>(records.size()));
    offsets += record(Opcode::summary_offset, content);
    summary += records;
  }
  const std::uint64_t offsets_start = summary_start + summary.size();
  summary += offsets;
  put(summary, static_cast<std::uint8_t>(Opcode::footer));
  put(summary, std::uint64_t{20});
  put(summary, summary_start);
  put(summary, offsets_start);
  put(summary, crc32(summary));
  append(summary);
  append(mcap::kMagic);
  if (std::fclose(file_.release()) != 0) fail("can't be written");
}

std::string McapWriter::statistics() const {
  std::string content;
  const auto count = [](const auto& all) {
    return std::count_if(all.begin(), all.end(), [](const auto& one) { return one.written; });
  };
  put(content, message_count_);
  put(content, static_cast<std::uint16_t>(count(schemas_)));
  put(content, static_cast<std::uint32_t>(count(channels_)));
  put(content, attachment_count_);
  put(content, metadata_count_);
  put(content, chunk_count_);
  put(content, message_count_ == 0 ? std::uint64_t{0} : times_.first);
  put(content, times_.last);
  std::string counts;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (!channels_[i].written) continue;
    put(counts, static_cast<std::uint16_t>(i + 1));
    put(counts, static_cast<std::uint64_t>(channels_[i].sequence));
  }
  put_text(content, counts);
  return record(Opcode::statistics, content);
}

std::string McapWriter::schema_record(std::uint16_t id) const {
  const Schema& schema = schemas_[id - 1u];
  std::string content;
  put(content, id);
  put_text(content, schema.name);
  put_text(content, schema.encoding);
  put_text(content, schema.data);
  return record(Opcode::schema, content);
}

std::string McapWriter::channel_record(std::uint16_t id) const {
  const Channel& channel = channels_[id - 1u];
  std::string content;
  put(content, id);
  put(content, channel.schema);
  put_text(content, channel.topic);
  put_text(content, channel.message_encoding);
  put_map(content, channel.metadata);
  return record(Opcode::channel, content);
}

void McapWriter::append(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size())
    fail("can't be written");
  offset_ += bytes.size();
  data_crc_ = crc32(bytes, data_crc_);
}

void McapWriter::fail(const char* what) const {
  throw FileError(path_ + ": " + what + " (" + std::strerror(errno) +
                  "); a folder that exists, may be written and has room would be valid");
}

}  // namespace surefoot::logging
