#pragma once

#include <cstdint>
#include <string_view>

/// The MCAP container format, version 0 (https://mcap.dev/spec), for writer and reader.
namespace surefoot::logging::mcap {

inline constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

enum class Opcode : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  attachment = 0x09,
  attachment_index = 0x0A,
  statistics = 0x0B,
  metadata = 0x0C,
  metadata_index = 0x0D,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

inline constexpr std::uint64_t kMaxChunkTime = 10'000'000'000;  ///< ours take one second [ns]

/// Are these plausible first and last times of a chunk's messages [ns]?
[[nodiscard]] constexpr bool can_be_times(std::uint64_t first, std::uint64_t last) {
  return last >= first && last - first <= kMaxChunkTime;
}

}  // namespace surefoot::logging::mcap
