#include "server/web_answer.hpp"

#include "server/page_files.hpp"
#include "surefoot/base/error.hpp"

#include <algorithm>
#include <charconv>
#include <exception>

namespace surefoot::server {
namespace {

constexpr std::string_view kApi = "/api/";

/// Characters of our own links; others, such as %, are refused.
bool is_plain(char c) {
  constexpr std::string_view kMarks = "/._-=&?";
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         kMarks.find(c) != std::string_view::npos;
}

WebContent::Query read_query(std::string_view text) {
  WebContent::Query query;
  while (!text.empty()) {
    const std::string_view part = text.substr(0, text.find('&'));
    const std::size_t equals = part.find('=');
    if (equals != std::string_view::npos) {
      query[std::string(part.substr(0, equals))] = std::string(part.substr(equals + 1));
    }
    text.remove_prefix(std::min(part.size() + 1, text.size()));
  }
  return query;
}

WebAnswer page_file(std::string_view path) {
  const std::string_view name = path == "/" ? "index.html" : path.substr(1);
  for (const PageFile& file : page_files()) {
    if (file.name == name) return {200, std::string(file.media_type), std::string(file.data)};
  }
  return refusal(404, "there is no " + std::string(path) + " here; the page is at /");
}

}  // namespace

void read_number(const WebContent::Query& query, const char* key, std::uint32_t min,
                 std::uint32_t max, std::uint32_t& value) {
  const auto found = query.find(key);
  if (found == query.end()) return;
  const std::string& text = found->second;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && value >= min && value <= max)
    return;
  throw Error(std::string(key) + " is \"" + text + "\"; valid is a whole number from " +
              std::to_string(min) + " to " + std::to_string(max));
}

WebAnswer refusal(int status, std::string why) {
  return {.status = status, .body = std::move(why) + "\n"};
}

std::optional<std::pair<std::string, WebContent::Query>> read_target(std::string_view target) {
  if (!target.starts_with('/') || !std::ranges::all_of(target, is_plain)) return std::nullopt;
  const std::size_t end = std::min(target.find('?'), target.size());
  const std::string_view query = target.substr(std::min(end + 1, target.size()));
  return std::pair(std::string(target.substr(0, end)), read_query(query));
}

WebAnswer answer_for(std::string_view target, WebContent& content) {
  const auto parts = read_target(target);
  if (!parts) return refusal(404, "there is nothing under this name; the page is at /");
  const auto& [path, query] = *parts;
  if (!path.starts_with(kApi)) return page_file(path);
  if (path == "/api/alive") return {.body = content.start() + "\n"};
  try {
    return content.get(path, query);
  } catch (const std::exception& error) {
    return refusal(500, error.what());
  }
}

}  // namespace surefoot::server
