#pragma once

#include <cstdint>
#include <string_view>

namespace surefoot {

/// splitmix64's increment: 2⁶⁴ over the golden ratio.
inline constexpr std::uint64_t kGoldenStep = 0x9e3779b97f4a7c15U;

/// splitmix64's output function: spreads differences in a few bits over all of them.
[[nodiscard]] constexpr std::uint64_t mixed_bits(std::uint64_t value) {
  value = (value ^ (value >> 30U)) * 0xbf58476d1ce4e5b9U;
  value = (value ^ (value >> 27U)) * 0x94d049bb133111ebU;
  return value ^ (value >> 31U);
}

/// Bits that depend only on a seed and a name (hashed by FNV-1a), so that draws under one name do
/// not change those under another.
[[nodiscard]] constexpr std::uint64_t named_bits(std::uint64_t seed, std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char letter : name) {
    hash = (hash ^ static_cast<unsigned char>(letter)) * 0x100000001b3U;
  }
  return mixed_bits(mixed_bits(seed + kGoldenStep) ^ hash);
}

}  // namespace surefoot
