#include "surefoot/config/randomise.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/plant_vectors.hpp"
#include "surefoot/config/section.hpp"
#include "surefoot/math/random_bits.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace surefoot {
namespace {

namespace fs = std::filesystem;

constexpr const char* kInclude = "include";

struct Range {
  double min = 0.0, max = 0.0;
  bool whole = false;
};

Range read_range(const ConfigNode& range, const std::string& path) {
  const std::string key = "randomise." + path;
  if (range.items.size() != 2) fail_at(range, key, "must be a range [min, max]");
  const double min = read_number(range.items[0], key);
  const double max = read_number(range.items[1], key);
  if (min > max) fail_at(range, key, "min must not be above max");
  const bool whole = is_whole_number(path);
  if (whole && (min != std::floor(min) || max != std::floor(max)))
    fail_at(range, key, "the ends of this range must be whole numbers");
  return {.min = min, .max = max, .whole = whole};
}

double drawn_from(const Range& range, double uniform) {
  if (!range.whole) return range.min + (range.max - range.min) * uniform;
  return std::min(range.max, range.min + std::floor((range.max - range.min + 1.0) * uniform));
}

std::string shortest(double value) {
  std::array<char, 32> text{};
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end};
}

/// The node at a dotted path of maps; null where there is none.
ConfigNode* node_at(ConfigNode& tree, const std::string& path) {
  ConfigNode* node = &tree;
  for (std::size_t begin = 0; node != nullptr && begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    node = node->find(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return node;
}

/// A list gets the form that elements are drawn into: a map by their names.
void name_elements(ConfigNode& tree, const std::string& key,
                   const std::vector<std::string>& names) {
  ConfigNode* list = node_at(tree, key);
  if (list == nullptr || list->kind != ConfigNode::Kind::list) return;
  if (list->items.size() != names.size()) return;  // told by who reads it
  for (std::size_t i = 0; i < names.size(); ++i)
    list->members.emplace_back(names[i], std::move(list->items[i]));
  list->items.clear();
  list->kind = ConfigNode::Kind::map;
}

/// The paths that a key of the section stands for.
std::vector<std::string> paths_of(const std::string& key) {
  std::vector<std::string> paths;
  for (const std::string& name : elements_of(key)) paths.push_back(key + "." + name);
  return paths.empty() ? std::vector<std::string>{key} : paths;
}

bool holds(const std::vector<std::string>& list, const std::string& text) {
  return std::ranges::find(list, text) != list.end();
}

fs::path find_ranges(const ConfigNode& name, const fs::path& folder) {
  const std::string key = std::string("randomise.") + kInclude;
  try {
    return find_data_file("randomisations", read_text(name, key), folder);
  } catch (const UnknownNameError& error) {
    fail_at(name, key, error.what());
  }
}

void include(const ConfigNode& names, const fs::path& folder, ConfigNode& section,
             std::vector<fs::path>& files);

/// Ranges of a file that the section does not speak of itself.
void add_ranges(const fs::path& file, ConfigNode& section, std::vector<fs::path>& files) {
  ConfigNode ranges = parse_yaml_file(file);
  for (auto& [key, range] : ranges.members) {
    if (key == kInclude) {
      include(range, file.parent_path(), section, files);
      continue;
    }
    if (range.kind != ConfigNode::Kind::null) (void)read_range(range, key);
    if (section.find(key) == nullptr) section.members.emplace_back(key, std::move(range));
  }
}

/// One name or a list of them; a file that was included before adds nothing.
void include(const ConfigNode& names, const fs::path& folder, ConfigNode& section,
             std::vector<fs::path>& files) {
  if (names.kind == ConfigNode::Kind::null) return;
  const bool is_list = names.kind == ConfigNode::Kind::list;
  for (const ConfigNode& name : is_list ? names.items : std::vector<ConfigNode>{names}) {
    const fs::path file = find_ranges(name, folder);
    if (std::ranges::find(files, file) != files.end()) continue;
    files.push_back(file);
    add_ranges(file, section, files);
  }
}

}  // namespace

double uniform_of(std::uint64_t seed, const std::string& name) {
  constexpr double kScale = 0x1.0p-53;
  return static_cast<double>(named_bits(seed, name) >> 11U) * kScale;
}

std::vector<fs::path> include_ranges(ConfigNode& scenario, const fs::path& folder) {
  ConfigNode* section = scenario.find("randomise");
  if (section == nullptr || section->find(kInclude) == nullptr) return {};
  const ConfigNode names = *section->find(kInclude);
  std::erase_if(section->members, [](const auto& member) { return member.first == kInclude; });
  std::vector<fs::path> files;
  include(names, folder, *section, files);
  return files;
}

std::vector<RandomDraw> randomise(ConfigNode& scenario, std::uint64_t seed,
                                  const std::vector<std::string>& assigned) {
  const ConfigNode* given = scenario.find("randomise");
  if (given == nullptr) return {};
  const ConfigNode section = *given;
  (void)Section(section, "randomise");  // is a map
  std::vector<RandomDraw> drawn;
  for (const auto& [key, node] : section.members) {
    if (node.kind == ConfigNode::Kind::null) continue;
    const Range range = read_range(node, key);
    if (seed == 0 || holds(assigned, key)) continue;
    name_elements(scenario, key, elements_of(key));
    for (const std::string& path : paths_of(key)) {
      if (holds(assigned, path)) continue;
      const double value = drawn_from(range, uniform_of(seed, path));
      set_path(scenario, path,
               {.kind = ConfigNode::Kind::scalar,
                .text = shortest(value),
                .where = node.where + ": randomise"});
      drawn.push_back({.path = path, .value = value, .key = key});
    }
  }
  return drawn;
}

}  // namespace surefoot
