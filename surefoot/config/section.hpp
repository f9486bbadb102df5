#pragma once

#include "surefoot/config/config_tree.hpp"
#include "surefoot/math/types.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace surefoot {

/// Numbers that make sense for a key, and how to say so.
struct NumberRange {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_included = true;
  const char* words = "a finite number";
};

inline constexpr NumberRange kAnyNumber{};
inline constexpr NumberRange kPositive{
    .min = 0.0, .min_included = false, .words = "a number above 0"};
/// Of a low-pass: some periods of control at least, or it is none and may be unstable.
inline constexpr NumberRange kTimeConstant{.min = 0.01, .max = 10.0, .words = "from 0.01 to 10 s"};
inline constexpr NumberRange kNotNegative{.min = 0.0, .words = "a number of at least 0"};
inline constexpr NumberRange kShare{.min = 0.0, .max = 1.0, .words = "a number from 0 to 1"};

/// Reads one map of a configuration key by key. A key that is absent leaves the value as it is;
/// a key that nobody asked for is an error. Every error names file, line and the key's whole path,
/// what was given and what would be valid.
///
///     Section section(tree, "planner.swing");
///     section.number("apex", options.apex, kPositive);
///     section.finish();
class Section {
 public:
  /// `path` is the map's own place in the file, "" at the top. An empty node counts as an empty
  /// map.
  Section(const ConfigNode& node, std::string path);

  void number(const char* key, double& value, NumberRange range = kAnyNumber);
  void integer(const char* key, int& value, int min = std::numeric_limits<int>::min(),
               int max = std::numeric_limits<int>::max());
  void integer(const char* key, std::uint64_t& value);
  void flag(const char* key, bool& value);
  void text(const char* key, std::string& value);
  void vector(const char* key, Vec2& value);
  void vector(const char* key, Vec3& value);
  void numbers(const char* key, std::vector<double>& values);
  /// As many numbers as there are names: a list of all, or a map with some of them by name.
  void elements(const char* key, double* values, const std::vector<std::string>& names,
                NumberRange range = kAnyNumber);

  /// Of two numbers that were read: an error, with both, where the high one is below the low one.
  void require_order(const char* low_key, double low, const char* high_key, double high) const;

  /// One of the named values of an enumeration.
  template <typename T>
  void choice(const char* key, T& value, const std::vector<std::pair<std::string, T>>& choices);

  /// A map below this one, read by `fields(Section&)`; everything in it is optional.
  template <typename Fields>
  void section(const char* key, Fields&& fields);

  /// The raw node of a key, for forms of its own; null where absent.
  [[nodiscard]] const ConfigNode* node(const char* key);
  /// The keys as written, for maps whose keys are names.
  [[nodiscard]] std::vector<std::string> keys() const;
  /// Says at `finish()` that this key must be there.
  void require(const char* key);

  /// Call last: throws Error on the first key that nobody asked for, then on required ones that are
  /// absent.
  void finish() const;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::string path_of(const std::string& key) const;
  [[nodiscard]] const std::string& where() const { return node_.where; }
  /// Throws Error about a key of this section, at the line where it is written.
  [[noreturn]] void fail(const std::string& key, const std::string& message) const;

 private:
  const ConfigNode* present(const char* key);
  std::size_t choose(const char* key, const std::string& given,
                     const std::vector<std::string>& names) const;

  const ConfigNode& node_;
  std::string path_;
  std::vector<std::string> known_;
  std::vector<std::string> required_;
};

/// A finite number in the range. Throws Error that names `path` and the node's place.
[[nodiscard]] double read_number(const ConfigNode& node, const std::string& path,
                                 NumberRange range = kAnyNumber);
/// A word or a line of text.
[[nodiscard]] const std::string& read_text(const ConfigNode& node, const std::string& path);
[[noreturn]] void fail_at(const ConfigNode& node, const std::string& path,
                          const std::string& message);

template <typename T>
void Section::choice(const char* key, T& value,
                     const std::vector<std::pair<std::string, T>>& choices) {
  const ConfigNode* given = present(key);
  if (given == nullptr) return;
  std::vector<std::string> names;
  for (const auto& [name, meaning] : choices) names.push_back(name);
  value = choices[choose(key, read_text(*given, path_of(key)), names)].second;
}

template <typename Fields>
void Section::section(const char* key, Fields&& fields) {
  const ConfigNode* given = node(key);
  const ConfigNode empty{.where = node_.where};
  Section below(given == nullptr ? empty : *given, path_of(key));
  fields(below);
  below.finish();
}

}  // namespace surefoot
