#include "surefoot/config/config_tree.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/nearest_name.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace surefoot::config {
namespace {

constexpr int kMaxDepth = 32;
constexpr const char* kRandomise = "randomise";
constexpr std::array<std::string_view, 4> kNamedEntries{"terrain.elements", "disturbances.pushes",
                                                        "disturbances.lifts", "sensors.faults"};

/// Converts yaml-cpp's nodes to ConfigNode.
class Converter {
 public:
  explicit Converter(const std::string& name) : name_(name) {}

  ConfigNode convert(const YAML::Node& yaml, int depth = 0) const {
    ConfigNode node;
    node.where = place(yaml.Mark());
    if (depth > kMaxDepth) {
      throw FileError(node.where + ": nested deeper than " + std::to_string(kMaxDepth) + " levels");
    }
    if (yaml.IsScalar() && !is_nothing(yaml)) {
      node.kind = ConfigNode::Kind::scalar;
      node.text = yaml.Scalar();
    } else if (yaml.IsSequence()) {
      node.kind = ConfigNode::Kind::list;
      for (const YAML::Node& item : yaml) node.items.push_back(convert(item, depth + 1));
    } else if (yaml.IsMap()) {
      node.kind = ConfigNode::Kind::map;
      for (const auto& member : yaml) add_member(node, member.first, member.second, depth);
    }
    return node;
  }

  std::string place(const YAML::Mark& mark) const {
    return mark.is_null() ? name_ : name_ + ":" + std::to_string(mark.line + 1);
  }

 private:
  /// `none` replaces ~, which a shell would expand. In quotes it is text.
  static bool is_nothing(const YAML::Node& scalar) {
    return scalar.Tag() == "?" && scalar.Scalar() == "none";
  }

  void add_member(ConfigNode& map, const YAML::Node& key, const YAML::Node& value,
                  int depth) const {
    if (!key.IsScalar()) throw FileError(place(key.Mark()) + ": a key must be a plain word");
    if (map.find(key.Scalar()) != nullptr) {
      throw FileError(place(key.Mark()) + ": the key \"" + key.Scalar() + "\" is given twice");
    }
    map.members.emplace_back(key.Scalar(), convert(value, depth + 1));
    // The key's place: an empty value has no mark, and other values may start on a later line.
    map.members.back().second.where = place(key.Mark());
  }

  const std::string& name_;
};

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> keys;
  std::istringstream stream(path);
  for (std::string key; std::getline(stream, key, '.');) keys.push_back(key);
  if (keys.empty() || path.back() == '.' || std::ranges::count(keys, "") > 0) {
    throw Error("the path \"" + path +
                "\" must be keys with a dot between them, as in terrain.friction");
  }
  return keys;
}

/// The keys of a path; what follows `randomise.` is one key.
std::vector<std::string> keys_of(const std::string& path) {
  std::vector<std::string> keys = split(path);
  if (keys.size() < 2 || keys.front() != kRandomise) return keys;
  return {kRandomise, path.substr(path.find('.') + 1)};
}

ConfigNode& item(ConfigNode& list, const std::string& key, const std::string& path) {
  std::size_t number = list.items.size();
  if (key == "x" || key == "y" || key == "z") {
    number = static_cast<std::size_t>(key[0] - 'x');
  } else {
    (void)std::from_chars(key.data(), key.data() + key.size(), number);
  }
  if (number >= list.items.size()) {
    throw Error("the path \"" + path + "\": \"" + key + "\" is no entry of the list at " +
                list.where + ", which has " + std::to_string(list.items.size()) +
                ", counted from 0");
  }
  return list.items[number];
}

ConfigNode& child(ConfigNode& node, const std::string& key, const std::string& path,
                  const std::string& where) {
  if (node.kind == ConfigNode::Kind::list) return item(node, key, path);
  if (node.kind == ConfigNode::Kind::scalar) {
    throw Error("the path \"" + path + "\": there is nothing below \"" + node.text + "\" (" +
                node.where + "), so no \"" + key + "\"");
  }
  node.kind = ConfigNode::Kind::map;
  if (ConfigNode* found = node.find(key)) return *found;
  node.members.emplace_back(key, ConfigNode{});
  node.members.back().second.where = where;
  return node.members.back().second;
}

std::size_t equals_sign(const std::string& assignment) {
  const std::size_t position = assignment.find('=');
  if (position == std::string::npos || position == 0) {
    throw Error("--set " + assignment + ": write it as path.to.key=value");
  }
  return position;
}

bool is_named_entry(const std::string& path) {
  const std::string map = path.substr(0, path.rfind('.'));
  return std::ranges::find(kNamedEntries, map) != kNamedEntries.end();
}

/// Throws Error if the named entry to be removed does not exist.
void check_removed(const ConfigNode& tree, const std::string& path) {
  const std::vector<std::string> keys = split(path);
  const std::string map = path.substr(0, path.rfind('.'));
  const ConfigNode* section = tree.find(keys[0]);
  const ConfigNode* entries = section == nullptr ? nullptr : section->find(keys[1]);
  std::vector<std::string> names;
  if (entries != nullptr) {
    for (const auto& [name, entry] : entries->members) names.push_back(name);
  }
  if (std::ranges::find(names, keys[2]) != names.end()) return;
  throw Error(path + ": \"" + keys[2] + "\" is not there to be taken off; " +
              (names.empty() ? map + " has no entries" : valid_names(keys[2], names)));
}

/// Removes the random ranges of a removed entry.
void remove_ranges_below(ConfigNode& tree, const std::string& path) {
  ConfigNode* randomise = tree.find(kRandomise);
  if (randomise == nullptr) return;
  for (auto& [key, range] : randomise->members) {
    if (key.starts_with(path + ".")) range = ConfigNode{.where = range.where};
  }
}

/// Throws Error if the shell has expanded an unquoted ~.
void check_not_home(const std::string& assignment) {
  const char* home = std::getenv("HOME");
  const std::string value = assignment.substr(equals_sign(assignment) + 1);
  if (home == nullptr || value.empty() || value != home) return;
  throw Error("--set " + assignment + ": this is your home folder, which the shell makes of ~; " +
              "valid is " + assigned_path(assignment) + "=none");
}

void set_places(ConfigNode& node, const std::string& where) {
  node.where = where;
  for (ConfigNode& entry : node.items) set_places(entry, where);
  for (auto& [key, value] : node.members) set_places(value, where);
}

}  // namespace

const ConfigNode* ConfigNode::find(std::string_view key) const {
  const auto found = std::ranges::find(members, key, &Member::first);
  return found == members.end() ? nullptr : &found->second;
}

ConfigNode* ConfigNode::find(std::string_view key) {
  const auto found = std::ranges::find(members, key, &Member::first);
  return found == members.end() ? nullptr : &found->second;
}

ConfigNode parse_yaml(const std::string& text, const std::string& name) {
  const Converter converter(name);
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.size() > 1)
      throw FileError(name + ": holds several YAML documents; one is valid");
    if (documents.empty()) return ConfigNode{.where = name};
    return converter.convert(documents.front());
  } catch (const YAML::Exception& error) {
    const std::string advice = text.find("\n\t") == std::string::npos
                                   ? ""
                                   : "; a line begins with a tab, valid are spaces";
    throw FileError(converter.place(error.mark) + ": this is not YAML: " + error.msg + advice);
  }
}

ConfigNode parse_yaml_map(const std::string& text, const std::string& name) {
  ConfigNode tree = parse_yaml(text, name);
  if (tree.kind != ConfigNode::Kind::map) {
    throw FileError(tree.where + ": must be YAML of the form `key: value`; this is " +
                    (tree.kind == ConfigNode::Kind::list ? "a list" : "not"));
  }
  return tree;
}

ConfigNode parse_yaml_file(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  if (std::filesystem::is_directory(file) || !(text << stream.rdbuf())) {
    throw FileError(file.string() + ": this file can't be read, or is empty");
  }
  return parse_yaml_map(text.str(), file.string());
}

void merge(ConfigNode& tree, ConfigNode overlay) {
  if (tree.kind != ConfigNode::Kind::map || overlay.kind != ConfigNode::Kind::map) {
    tree = std::move(overlay);
    return;
  }
  tree.where = overlay.where;
  for (auto& [key, value] : overlay.members) {
    if (ConfigNode* known = tree.find(key)) {
      merge(*known, std::move(value));
    } else {
      tree.members.emplace_back(key, std::move(value));
    }
  }
}

void set_path(ConfigNode& tree, const std::string& path, ConfigNode value) {
  ConfigNode* node = &tree;
  for (const std::string& key : keys_of(path)) node = &child(*node, key, path, value.where);
  *node = std::move(value);
}

std::string assigned_path(const std::string& assignment) {
  return assignment.substr(0, equals_sign(assignment));
}

void apply_assignment(ConfigNode& tree, const std::string& assignment) {
  const std::string where = "--set " + assignment;
  check_not_home(assignment);
  ConfigNode value = parse_yaml(assignment.substr(equals_sign(assignment) + 1), where);
  set_places(value, where);
  const std::string path = assigned_path(assignment);
  if (value.kind == ConfigNode::Kind::null && is_named_entry(path)) {
    check_removed(tree, path);
    remove_ranges_below(tree, path);
  }
  set_path(tree, path, std::move(value));
}

}  // namespace surefoot::config
