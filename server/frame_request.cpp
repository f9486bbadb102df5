#include "server/frame_request.hpp"

#include "server/web_answer.hpp"
#include "surefoot/base/error.hpp"

#include <limits>

namespace surefoot::server {
namespace {

constexpr std::uint32_t kMostFrames = 4096;  // of an answer
constexpr std::uint32_t kLargest = std::numeric_limits<std::uint32_t>::max() / 2;

FrameRequest read_frame_request(const WebContent::Query& query) {
  FrameRequest request;
  std::uint32_t min_max = 0;
  read_number(query, "from", 0, kLargest, request.from);
  read_number(query, "count", 1, kMostFrames, request.count);
  read_number(query, "stride", 1, kLargest, request.stride);
  read_number(query, "min_max", 0, 1, min_max);
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

}  // namespace surefoot::server
