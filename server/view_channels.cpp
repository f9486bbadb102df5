#include "server/view_channels.hpp"

#include "surefoot/logging/json_text.hpp"

#include <utility>

namespace surefoot::server {
namespace {

constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};

/// A description without its unit, and the unit: "since the start [s]; …" has "s" in its first
/// brackets. A list of units, "[m/s, rad/s, …]", stays in the description.
std::pair<std::string, std::string> split_unit(std::string_view about) {
  const std::size_t begin = about.find('[');
  const std::size_t end = about.find(']', begin);
  if (end == std::string_view::npos) return {std::string(about), ""};
  const std::string_view unit = about.substr(begin + 1, end - begin - 1);
  if (unit.empty() || unit.find(", ") != std::string_view::npos) return {std::string(about), ""};
  std::string text(about.substr(0, begin));
  while (text.ends_with(' ')) text.pop_back();
  return {text + std::string(about.substr(end + 1)), std::string(unit)};
}

}  // namespace

}  // namespace surefoot::server

namespace surefoot::logged {

void ChannelLister::add_channel(std::string_view about, std::vector<std::string> labels) {
  const std::size_t size = std::max<std::size_t>(labels.size(), 1);
  auto [text, unit] = server::split_unit(about);
  table_.channels.push_back({.name = name_,
                             .unit = std::move(unit),
                             .about = std::move(text),
                             .labels = std::move(labels),
                             .values = {},
                             .offset = table_.floats,
                             .size = size});
  table_.floats += size;
}

std::vector<std::string> ChannelLister::labels(int rows, int columns) const {
  std::vector<std::string> result;
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      if (columns > 1) {
        result.push_back(std::to_string(i + 1) + std::to_string(j + 1));
      } else if (rows == std::ssize(table_.joint_names)) {
        result.push_back(table_.joint_names[static_cast<std::size_t>(i)]);
      } else if (rows <= 3) {
        result.emplace_back(server::kAxes[static_cast<std::size_t>(i)]);
      } else {
        result.push_back(std::to_string(i));
      }
    }
  }
  return result;
}

}  // namespace surefoot::logged

namespace surefoot::server {

std::string to_json(const std::vector<ViewChannel>& channels) {
  std::string out;
  logging::JsonText json(out);
  json.array();
  for (const ViewChannel& channel : channels) {
    json.object()
        .member("name", std::string_view(channel.name))
        .member("unit", std::string_view(channel.unit))
        .member("about", std::string_view(channel.about))
        .member("size", channel.size)
        .member("offset", channel.offset);
    if (!channel.labels.empty()) json.member("labels", channel.labels);
    if (!channel.values.empty()) json.member("values", channel.values);
    json.end_object();
  }
  json.end_array();
  return out;
}

}  // namespace surefoot::server
