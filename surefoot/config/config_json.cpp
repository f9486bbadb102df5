#include "surefoot/config/config_json.hpp"

#include "surefoot/logging/json_text.hpp"

#include <charconv>
#include <cmath>

namespace surefoot::config {
namespace {

void write(logging::JsonText& json, const std::string& text) {
  double number = 0.0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, number);
  // JSON has no nan and inf: they become strings.
  if (error == std::errc() && stopped == end && std::isfinite(number)) {
    json.value(number);
  } else if (text == "true" || text == "false") {
    json.value(text == "true");
  } else {
    json.value(std::string_view(text));
  }
}

void write(logging::JsonText& json, const ConfigNode& node) {
  switch (node.kind) {
    case ConfigNode::Kind::null:
      json.null();
      break;
    case ConfigNode::Kind::scalar:
      write(json, node.text);
      break;
    case ConfigNode::Kind::list:
      json.array();
      for (const ConfigNode& item : node.items) write(json, item);
      json.end_array();
      break;
    case ConfigNode::Kind::map:
      json.object();
      for (const auto& [key, value] : node.members) {
        json.key(key);
        write(json, value);
      }
      json.end_object();
      break;
  }
}

}  // namespace

std::string to_json(const ConfigNode& tree) {
  std::string text;
  logging::JsonText json(text);
  write(json, tree);
  return text;
}

}  // namespace surefoot::config
