#pragma once

#include <cstdint>
#include <string_view>

namespace surefoot::logging {

/// CRC-32 as in zlib (polynomial 0xEDB88320), continued from `crc`.
[[nodiscard]] std::uint32_t crc32(std::string_view bytes, std::uint32_t crc = 0);

}  // namespace surefoot::logging
