#include "surefoot/config/randomise.hpp"

#include "surefoot/config/section.hpp"

namespace surefoot {
namespace {

/// FNV-1a.
std::uint64_t hash(const std::string& text) {
  std::uint64_t value = 0xcbf29ce484222325u;
  for (const char letter : text) {
    value = (value ^ static_cast<unsigned char>(letter)) * 0x100000001b3u;
  }
  return value;
}

/// The output function of splitmix64.
std::uint64_t mix(std::uint64_t value) {
  value = (value ^ (value >> 30)) * 0xbf58476d1ce4e5b9u;
  value = (value ^ (value >> 27)) * 0x94d049bb133111ebu;
  return value ^ (value >> 31);
}

RandomDraw draw(const ConfigNode& range, const std::string& path, std::uint64_t seed) {
  const std::string key = "randomise." + path;
  if (range.items.size() != 2) fail_at(range, key, "must be a range [min, max]");
  const double min = read_number(range.items[0], key);
  const double max = read_number(range.items[1], key);
  if (min > max) fail_at(range, key, "min must not be above max");
  return {.path = path, .value = min + (max - min) * uniform_of(seed, path)};
}

}  // namespace

double uniform_of(std::uint64_t seed, const std::string& name) {
  constexpr double kScale = 0x1.0p-53;
  const std::uint64_t bits = mix(mix(seed + 0x9e3779b97f4a7c15u) ^ hash(name));
  return static_cast<double>(bits >> 11) * kScale;
}

std::vector<RandomDraw> draw_random(const ConfigNode& scenario, std::uint64_t seed) {
  std::vector<RandomDraw> drawn;
  const ConfigNode* section = scenario.find("randomise");
  if (section == nullptr) return drawn;
  (void)Section(*section, "randomise");  // is a map
  for (const auto& [path, range] : section->members) {
    if (range.kind != ConfigNode::Kind::null) drawn.push_back(draw(range, path, seed));
  }
  if (seed == 0) drawn.clear();
  return drawn;
}

}  // namespace surefoot
