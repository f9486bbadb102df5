#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace surefoot::config {

/// A configuration as a tree of text. Every node knows where it was written, so that errors can
/// name file and line even after merging.
struct ConfigNode {
  enum class Kind { null, scalar, list, map };
  using Member = std::pair<std::string, ConfigNode>;

  Kind kind = Kind::null;
  std::string text{};               ///< of a scalar
  std::vector<ConfigNode> items{};  ///< of a list
  std::vector<Member> members{};    ///< of a map, in the order written; keys are unique
  std::string where{};              ///< "file:line", or the option of the command line

  /// The member with this key, or null.
  [[nodiscard]] const ConfigNode* find(std::string_view key) const;
  [[nodiscard]] ConfigNode* find(std::string_view key);
};

/// Reads YAML text: one document of maps, lists and scalars; the scalar `none` is null, like ~.
/// `name` stands for the file in errors. Throws FileError on invalid YAML and duplicate keys.
[[nodiscard]] ConfigNode parse_yaml(const std::string& text, const std::string& name);

/// The same for a text whose top level must be a map.
[[nodiscard]] ConfigNode parse_yaml_map(const std::string& text, const std::string& name);

/// The same for a file. Throws FileError also if it can't be read.
[[nodiscard]] ConfigNode parse_yaml_file(const std::filesystem::path& file);

/// Merges `overlay` into `tree`: maps are merged key by key, everything else is replaced.
void merge(ConfigNode& tree, ConfigNode overlay);

/// Replaces the node at a dotted path ("terrain.friction"; entries of a list by number, or by x, y,
/// z). Creates missing maps. What follows "randomise." is one key, as the section's keys are paths.
/// Throws Error, naming the path, if it leads through a scalar or beyond the end of a list.
void set_path(ConfigNode& tree, const std::string& path, ConfigNode value);

/// Applies an assignment from the command line, "path.to.key=value", with the value in YAML. An
/// empty value removes a terrain element, a push, a lift or a fault, with its random ranges. Throws
/// Error on another form, if there is nothing to remove, and if a shell has expanded ~.
void apply_assignment(ConfigNode& tree, const std::string& assignment);

/// The path of an assignment. Throws Error if it has none.
[[nodiscard]] std::string assigned_path(const std::string& assignment);

}  // namespace surefoot::config
