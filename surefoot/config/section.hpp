#pragma once

#include "surefoot/base/fields.hpp"
#include "surefoot/config/config_tree.hpp"
#include "surefoot/math/types.hpp"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace surefoot::config {

/// Reads one map of a configuration key by key. An absent key leaves the value as it is; a key that
/// was not read is an error. Every error names file, line and the key's whole path, what was given
/// and what would be valid.
///
///     Section section(tree, "planner.swing");
///     section.number("apex", options.apex, kPositive);
///     section.finish();
class Section final : public Given {
 public:
  /// `path` is the map's place in the file, "" at the top. A null node counts as an empty map.
  Section(const ConfigNode& node, std::string path);

  void number(const char* key, double& value, NumberRange range = kAnyNumber);
  void integer(const char* key, int& value, int min = std::numeric_limits<int>::min(),
               int max = std::numeric_limits<int>::max());
  void integer(const char* key, std::uint64_t& value);
  void flag(const char* key, bool& value);
  void text(const char* key, std::string& value);
  void vector(const char* key, Vec3& value);
  void numbers(const char* key, std::vector<double>& values);
  /// One number per name: a list of all, or a map with some of them by name.
  void elements(const char* key, double* values, const std::vector<std::string>& names,
                NumberRange range = kAnyNumber);

  /// Index of the given name; none without the key.
  std::optional<std::size_t> choice(const char* key, const std::vector<std::string>& names,
                                    const char* what = "choice");

  /// A map below this one, read by `fields(Section&)`; it is optional.
  template <typename Fields>
  void section(const char* key, Fields&& fields);

  /// The raw node of a key; null if absent.
  [[nodiscard]] const ConfigNode* node(const char* key);
  /// The keys as written, for maps whose keys are names.
  [[nodiscard]] std::vector<std::string> keys() const;
  /// Makes this key required at `finish()`.
  void require(const char* key);

  /// Call last: throws Error on the first key that was not read, then on absent required keys.
  void finish() const;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::string path_of(const std::string& key) const;
  [[nodiscard]] const std::string& where() const { return node_.where; }
  /// Is there this key, or dotted path below this map?
  [[nodiscard]] bool has(const std::string& key) const override;
  /// Throws Error about a key or dotted path of this section, at the line where it is written, or
  /// as much of it as is there.
  [[noreturn]] void fail(const std::string& key, const std::string& message) const override;

 private:
  const ConfigNode* present(const char* key);
  /// As much of a dotted path as is there; entries of a list by their `name`.
  struct Place {
    const ConfigNode& node;
    bool is_whole;
  };
  [[nodiscard]] Place below(const std::string& key) const;

  const ConfigNode& node_;
  std::string path_;
  std::vector<std::string> known_;
  std::vector<std::string> required_;
};

/// The number in a text, with or without a sign; none if it is no number.
[[nodiscard]] std::optional<double> number_in(const std::string& text);
/// As short a text as gives the same number again.
[[nodiscard]] std::string shortest_text(double number);
/// A finite number in the range. Throws Error, naming `path` and the node's place.
[[nodiscard]] double read_number(const ConfigNode& node, const std::string& path,
                                 NumberRange range = kAnyNumber);
/// The text of a scalar. Throws Error for other nodes.
[[nodiscard]] const std::string& read_text(const ConfigNode& node, const std::string& path);
[[noreturn]] void fail_at(const ConfigNode& node, const std::string& path,
                          const std::string& message);

template <typename Fields>
void Section::section(const char* key, Fields&& fields) {
  const ConfigNode* given = node(key);
  const ConfigNode empty{.where = node_.where};
  Section below(given == nullptr ? empty : *given, path_of(key));
  fields(below);
  below.finish();
}

}  // namespace surefoot::config
