#pragma once

#include <sstream>
#include <string>
#include <vector>

namespace surefoot::simulation {

/// The concatenated arguments, as `<<` writes them.
template <typename... Parts>
[[nodiscard]] std::string text(const Parts&... parts) {
  std::ostringstream stream;
  (stream << ... << parts);
  return stream.str();
}

/// MuJoCo's messages have several lines; ours have one.
[[nodiscard]] inline std::string one_line(std::string message) {
  while (message.ends_with('\n')) message.pop_back();
  for (std::size_t end = 0; (end = message.find('\n')) != std::string::npos;)
    message.replace(end, 1, ", ");
  return message;
}

/// Names separated by spaces, for messages that list valid ones.
[[nodiscard]] inline std::string listed(const std::vector<std::string>& names) {
  std::string line;
  for (const std::string& name : names) line += line.empty() ? name : " " + name;
  return line;
}

}  // namespace surefoot::simulation
