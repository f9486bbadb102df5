#include "surefoot/view/frame_request.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/view/web_answer.hpp"

#include <charconv>
#include <limits>

namespace surefoot {
namespace {

constexpr std::uint32_t kMostFrames = 4096;  // of an answer
constexpr std::uint32_t kLargest = std::numeric_limits<std::uint32_t>::max() / 2;

/// Reads a whole number from the query; keeps the default where it is not given.
void number(const WebContent::Query& query, const char* key, std::uint32_t min, std::uint32_t max,
            std::uint32_t& value) {
  const auto found = query.find(key);
  if (found == query.end()) return;
  const std::string& text = found->second;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && value >= min && value <= max)
    return;
  throw Error(std::string(key) + " is \"" + text + "\"; valid is a whole number from " +
              std::to_string(min) + " to " + std::to_string(max));
}

FrameRequest read_frame_request(const WebContent::Query& query) {
  FrameRequest request;
  std::uint32_t min_max = 0;
  number(query, "from", 0, kLargest, request.from);
  number(query, "count", 1, kMostFrames, request.count);
  number(query, "stride", 1, kLargest, request.stride);
  number(query, "min_max", 0, 1, min_max);
  request.min_max = min_max == 1;
  return request;
}

}  // namespace

WebAnswer answer_frames(const WebContent::Query& query,
                        const std::function<std::string(const FrameRequest&)>& block) {
  try {
    return {200, "application/octet-stream", block(read_frame_request(query))};
  } catch (const Error& error) {
    return refusal(400, error.what());
  }
}

}  // namespace surefoot
