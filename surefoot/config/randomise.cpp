#include "surefoot/config/randomise.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/base/nearest_name.hpp"
#include "surefoot/config/data_file.hpp"
#include "surefoot/config/scaling.hpp"
#include "surefoot/config/scenario_fields.hpp"
#include "surefoot/config/section.hpp"
#include "surefoot/math/random_bits.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace surefoot::config {
namespace {

namespace fs = std::filesystem;

constexpr const char* kInclude = "include";
constexpr std::string_view kSection = "randomise.";

struct Range {
  double min = 0.0, max = 0.0;
  bool whole = false;
};

/// A key of the section with its range, and its paths.
struct Entry {
  std::string key;
  Range range;
  std::vector<std::string> paths;
  std::string where;
};

/// Names of the elements of a key, in order; none for a key with one number.
std::vector<std::string> elements_of(const std::string& key, int num_legs) {
  std::vector<std::string> names;
  visit_scenario_option(
      key,
      [&](const Field& option) {
        if (const auto* numbers = std::get_if<Numbers>(&option.value)) names = numbers->names;
      },
      num_legs);
  return names;
}

/// True for delays in ticks, seeds, counts.
bool is_whole_number(const std::string& key) {
  bool is_whole = false;
  visit_scenario_option(key, [&](const Field& option) {
    is_whole = std::holds_alternative<int*>(option.value) ||
               std::holds_alternative<std::uint64_t*>(option.value);
  });
  return is_whole;
}

Range read_range(const ConfigNode& range, const std::string& path) {
  const std::string key = "randomise." + path;
  if (range.items.size() != 2) fail_at(range, key, "must be a range [min, max]");
  const double min = read_number(range.items[0], key);
  const double max = read_number(range.items[1], key);
  if (min > max) {
    fail_at(range, key, formatted("min, %g, must not be above max, which is %g", min, max));
  }
  const bool whole = is_whole_number(path);
  if (whole && (min != std::floor(min) || max != std::floor(max)))
    fail_at(range, key, "the ends of this range must be whole numbers");
  return {.min = min, .max = max, .whole = whole};
}

double drawn_from(const Range& range, double uniform) {
  if (!range.whole) return range.min + (range.max - range.min) * uniform;
  return std::min(range.max, range.min + std::floor((range.max - range.min + 1.0) * uniform));
}

/// The shortest exact text; whole numbers without exponent, which would not be read back.
std::string text_of(double value, bool whole) {
  std::array<char, 320> text{};
  char* const last = text.data() + text.size();
  const auto written = whole ? std::to_chars(text.data(), last, value, std::chars_format::fixed)
                             : std::to_chars(text.data(), last, value);
  return {text.data(), written.ptr};
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

/// Converts a list to a map by the elements' names, so that they can be drawn one by one.
void name_elements(ConfigNode& tree, const std::string& key,
                   const std::vector<std::string>& names) {
  ConfigNode* list = node_at(tree, key);
  if (list == nullptr || list->kind != ConfigNode::Kind::list) return;
  if (list->items.size() != names.size()) return;  // reported when it is read
  for (std::size_t i = 0; i < names.size(); ++i)
    list->members.emplace_back(names[i], std::move(list->items[i]));
  list->items.clear();
  list->kind = ConfigNode::Kind::map;
}

/// The paths of a key of the section.
std::vector<std::string> paths_of(const std::string& key, int num_legs) {
  std::vector<std::string> paths;
  for (const std::string& name : elements_of(key, num_legs)) paths.push_back(key + "." + name);
  return paths.empty() ? std::vector<std::string>{key} : paths;
}

bool holds(const std::vector<std::string>& list, const std::string& text) {
  return std::ranges::find(list, text) != list.end();
}

/// The ranges to draw: the scenario's section without assigned paths and removed ranges.
std::vector<Entry> entries_of(const ConfigNode& scenario, const std::vector<std::string>& assigned,
                              int num_legs) {
  const ConfigNode* section = scenario.find("randomise");
  if (section == nullptr) return {};
  (void)Section(*section, "randomise");  // throws unless it is a map
  std::vector<Entry> entries;
  for (const auto& [key, node] : section->members) {
    if (node.kind == ConfigNode::Kind::null) continue;
    const Range range = read_range(node, key);
    if (holds(assigned, key)) continue;
    std::vector<std::string> paths = paths_of(key, num_legs);
    std::erase_if(paths, [&](const std::string& path) { return holds(assigned, path); });
    if (paths.empty()) continue;
    entries.push_back({.key = key, .range = range, .paths = std::move(paths), .where = node.where});
  }
  return entries;
}

void write(ConfigNode& scenario, const Entry& entry, const std::string& path, double value) {
  set_path(scenario, path,
           {.kind = ConfigNode::Kind::scalar,
            .text = text_of(value, entry.range.whole),
            .where = entry.where + kDrawn});
}

fs::path find_ranges(const ConfigNode& name, const fs::path& folder) {
  const std::string key = std::string("randomise.") + kInclude;
  try {
    return find_data_file("randomisations", read_text(name, key), folder);
  } catch (const UnknownNameError& error) {
    fail_at(name, key, error.what());
  }
}

void include(const ConfigNode& names, const fs::path& folder, const Scale& scale,
             ConfigNode& section, std::vector<fs::path>& files);

/// Adds a file's ranges whose keys the section does not have.
void add_ranges(const fs::path& file, const Scale& scale, ConfigNode& section,
                std::vector<fs::path>& files) {
  ConfigNode ranges = parse_yaml_file(file);
  if (take_scaled(ranges)) scale_ranges(ranges, scale);
  for (auto& [key, range] : ranges.members) {
    if (key == kInclude) {
      include(range, file.parent_path(), scale, section, files);
      continue;
    }
    if (range.kind != ConfigNode::Kind::null) (void)read_range(range, key);
    if (section.find(key) == nullptr) section.members.emplace_back(key, std::move(range));
  }
}

/// Includes one file or a list of them, each file once.
void include(const ConfigNode& names, const fs::path& folder, const Scale& scale,
             ConfigNode& section, std::vector<fs::path>& files) {
  if (names.kind == ConfigNode::Kind::null) return;
  const bool is_list = names.kind == ConfigNode::Kind::list;
  for (const ConfigNode& name : is_list ? names.items : std::vector<ConfigNode>{names}) {
    const fs::path file = find_ranges(name, folder);
    if (std::ranges::find(files, file) != files.end()) continue;
    files.push_back(file);
    add_ranges(file, scale, section, files);
  }
}

/// The key whose range an assignment removes; empty for any other assignment.
std::string taken_range(const std::string& assignment) {
  const std::string path = assigned_path(assignment);
  if (!path.starts_with(kSection)) return "";
  ConfigNode alone{.kind = ConfigNode::Kind::map};
  apply_assignment(alone, assignment);
  std::string key = path.substr(kSection.size());
  const ConfigNode* given = alone.members.front().second.find(key);
  const bool is_taken = given->kind == ConfigNode::Kind::null && key != kInclude;
  return is_taken ? key : "";
}

}  // namespace

double uniform_of(std::uint64_t seed, const std::string& name) {
  constexpr double kScale = 0x1.0p-53;
  return static_cast<double>(named_bits(seed, name) >> 11U) * kScale;
}

std::vector<fs::path> include_ranges(ConfigNode& scenario, const fs::path& folder,
                                     const Scale& scale) {
  ConfigNode* section = scenario.find("randomise");
  if (section == nullptr || section->find(kInclude) == nullptr) return {};
  const ConfigNode names = *section->find(kInclude);
  std::erase_if(section->members, [](const auto& member) { return member.first == kInclude; });
  std::vector<fs::path> files;
  include(names, folder, scale, *section, files);
  return files;
}

void check_taken_ranges(ConfigNode scenario, const fs::path& folder,
                        const std::vector<std::string>& assignments) {
  std::vector<std::string> taken;
  for (const std::string& assignment : assignments) {
    std::string key = taken_range(assignment);
    if (key.empty()) {
      apply_assignment(scenario, assignment);
    } else {
      taken.push_back(std::move(key));
    }
  }
  if (taken.empty()) return;
  (void)include_ranges(scenario, folder);
  std::vector<std::string> drawn;
  if (const ConfigNode* section = scenario.find("randomise")) {
    for (const auto& [key, range] : section->members) drawn.push_back(key);
  }
  for (const std::string& key : taken) {
    if (holds(drawn, key)) continue;
    throw Error("randomise." + key + ": this is not drawn, so there is nothing to take away; " +
                (drawn.empty() ? "the scenario draws nothing" : valid_names(key, drawn)));
  }
}

std::vector<RandomDraw> randomise(ConfigNode& scenario, std::uint64_t seed,
                                  const std::vector<std::string>& assigned, int num_legs) {
  std::vector<RandomDraw> drawn;
  for (const Entry& entry : entries_of(scenario, assigned, num_legs)) {
    if (seed == 0) continue;
    name_elements(scenario, entry.key, elements_of(entry.key, num_legs));
    for (const std::string& path : entry.paths) {
      const double value = drawn_from(entry.range, uniform_of(seed, path));
      write(scenario, entry, path, value);
      drawn.push_back({.path = path, .value = value, .key = entry.key});
    }
  }
  return drawn;
}

std::vector<ConfigNode> ends_of_ranges(const ConfigNode& scenario,
                                       const std::vector<std::string>& assigned, int num_legs) {
  const std::vector<Entry> entries = entries_of(scenario, assigned, num_legs);
  if (entries.empty()) return {};
  std::vector<ConfigNode> ends;
  for (double Range::* const end : {&Range::min, &Range::max}) {
    ConfigNode& at_end = ends.emplace_back(scenario);
    for (const Entry& entry : entries) {
      name_elements(at_end, entry.key, elements_of(entry.key, num_legs));
      for (const std::string& path : entry.paths) write(at_end, entry, path, entry.range.*end);
    }
  }
  return ends;
}

}  // namespace surefoot::config
