#include "surefoot/config/randomise.hpp"

#include "surefoot/config/section.hpp"
#include "surefoot/math/random_bits.hpp"

namespace surefoot {
namespace {

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
  return static_cast<double>(named_bits(seed, name) >> 11U) * kScale;
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
