#include "surefoot/config/section.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/nearest_name.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace surefoot::config {
namespace {

std::string describe(const ConfigNode& node) {
  switch (node.kind) {
    case ConfigNode::Kind::null:
      return "nothing";
    case ConfigNode::Kind::scalar:
      return "\"" + node.text + "\"";
    case ConfigNode::Kind::list:
      return "a list of " + std::to_string(node.items.size());
    case ConfigNode::Kind::map:
      return "a map";
  }
  return "";
}

template <typename Number>
bool parse(const std::string& text, Number& value) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (text.size() > 1 && text[0] == '+') ++begin;
  const auto [stopped, error] = std::from_chars(begin, end, value);
  return error == std::errc() && stopped == end;
}

/// The value of a key, or a list's entry with this `name`; null without one.
const ConfigNode* child(const ConfigNode& node, const std::string& key) {
  if (node.kind != ConfigNode::Kind::list) return node.find(key);
  const auto is_meant = [&](const ConfigNode& item) {
    const ConfigNode* name = item.find("name");
    return name != nullptr && name->text == key;
  };
  const auto found = std::ranges::find_if(node.items, is_meant);
  return found == node.items.end() ? nullptr : &*found;
}

}  // namespace

std::optional<double> number_in(const std::string& text) {
  double value = 0.0;
  return parse(text, value) ? std::optional(value) : std::nullopt;
}

std::string shortest_text(double number) {
  std::array<char, 32> text{};
  const auto written = std::to_chars(text.data(), text.data() + text.size(), number);
  return {text.data(), written.ptr};
}

void fail_at(const ConfigNode& node, const std::string& path, const std::string& message) {
  const std::string place = node.where.empty() ? "" : node.where + ": ";
  throw Error(place + (path.empty() ? "" : path + ": ") + message);
}

double read_number(const ConfigNode& node, const std::string& path, NumberRange range) {
  double value = 0.0;
  const bool valid =
      node.kind == ConfigNode::Kind::scalar && parse(node.text, value) && range.holds(value);
  if (!valid) fail_at(node, path, describe(node) + " is not " + range.words);
  return value;
}

const std::string& read_text(const ConfigNode& node, const std::string& path) {
  if (node.kind != ConfigNode::Kind::scalar) fail_at(node, path, describe(node) + " is not a text");
  return node.text;
}

Section::Section(const ConfigNode& node, std::string path) : node_(node), path_(std::move(path)) {
  const bool is_map = node.kind == ConfigNode::Kind::map || node.kind == ConfigNode::Kind::null;
  if (!is_map) fail_at(node, path_, describe(node) + " is not a map of keys and values");
}

std::string Section::path_of(const std::string& key) const {
  return path_.empty() ? key : path_ + "." + key;
}

void Section::fail(const std::string& key, const std::string& message) const {
  fail_at(below(key).node, path_of(key), message);
}

bool Section::has(const std::string& key) const { return below(key).is_whole; }

Section::Place Section::below(const std::string& key) const {
  if (const ConfigNode* found = node_.find(key)) return {*found, true};
  const ConfigNode* node = &node_;
  for (std::size_t begin = 0; begin <= key.size();) {
    const std::size_t end = std::min(key.find('.', begin), key.size());
    const ConfigNode* next = child(*node, key.substr(begin, end - begin));
    if (next == nullptr) return {*node, false};
    node = next;
    begin = end + 1;
  }
  return {*node, true};
}

const ConfigNode* Section::node(const char* key) {
  if (std::ranges::find(known_, key) == known_.end()) known_.emplace_back(key);
  return node_.find(key);
}

const ConfigNode* Section::present(const char* key) {
  const ConfigNode* given = node(key);
  if (given == nullptr || given->kind != ConfigNode::Kind::null) return given;
  fail(key, "has no value");
}

void Section::require(const char* key) { required_.emplace_back(key); }

std::vector<std::string> Section::keys() const {
  std::vector<std::string> names;
  for (const auto& [key, value] : node_.members) names.push_back(key);
  return names;
}

void Section::finish() const {
  for (const auto& [key, value] : node_.members) {
    if (std::ranges::find(known_, key) != known_.end()) continue;
    fail(key, "unknown key; " + valid_names(key, known_));
  }
  for (const std::string& key : required_) {
    if (node_.find(key) == nullptr) fail(key, "this key is missing");
  }
}

void Section::number(const char* key, double& value, NumberRange range) {
  if (const ConfigNode* given = present(key)) value = read_number(*given, path_of(key), range);
}

void Section::integer(const char* key, int& value, int min, int max) {
  const ConfigNode* given = present(key);
  if (given == nullptr) return;
  if (given->kind != ConfigNode::Kind::scalar || !parse(given->text, value)) {
    fail(key, describe(*given) + " is not a whole number");
  }
  if (value < min) fail(key, describe(*given) + " is less than " + std::to_string(min));
  if (value > max) fail(key, describe(*given) + " is more than " + std::to_string(max));
}

void Section::integer(const char* key, std::uint64_t& value) {
  const ConfigNode* given = present(key);
  if (given == nullptr) return;
  if (given->kind != ConfigNode::Kind::scalar || !parse(given->text, value)) {
    fail(key, describe(*given) + " is not a whole number of at least 0");
  }
}

void Section::flag(const char* key, bool& value) {
  if (const auto given = choice(key, {"true", "false"})) value = *given == 0;
}

void Section::text(const char* key, std::string& value) {
  if (const ConfigNode* given = present(key)) value = read_text(*given, path_of(key));
}

void Section::vector(const char* key, Vec3& value) { elements(key, value.data(), {"x", "y", "z"}); }

void Section::elements(const char* key, double* values, const std::vector<std::string>& names,
                       NumberRange range) {
  const ConfigNode* given = present(key);
  if (given == nullptr) return;
  if (given->kind == ConfigNode::Kind::map) {
    Section named(*given, path_of(key));
    for (std::size_t i = 0; i < names.size(); ++i) named.number(names[i].c_str(), values[i], range);
    return named.finish();
  }
  if (given->kind != ConfigNode::Kind::list || given->items.size() != names.size()) {
    fail(key, describe(*given) + " is not a list of " + std::to_string(names.size()) +
                  " numbers, nor a map from " + names.front() + " … " + names.back());
  }
  for (std::size_t i = 0; i < names.size(); ++i)
    values[i] = read_number(given->items[i], path_of(key), range);
}

void Section::numbers(const char* key, std::vector<double>& values) {
  const ConfigNode* given = present(key);
  if (given == nullptr) return;
  if (given->kind != ConfigNode::Kind::list)
    fail(key, describe(*given) + " is not a list of numbers");
  values.clear();
  for (const ConfigNode& entry : given->items) values.push_back(read_number(entry, path_of(key)));
}

std::optional<std::size_t> Section::choice(const char* key, const std::vector<std::string>& names,
                                           const char* what) {
  const ConfigNode* given = present(key);
  if (given == nullptr) return {};
  const std::string name = read_text(*given, path_of(key));
  const auto found = std::ranges::find(names, name);
  if (found == names.end()) {
    fail(key, std::string("unknown ") + what + " \"" + name + "\"; " + valid_names(name, names));
  }
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace surefoot::config
