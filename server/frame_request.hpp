#pragma once

#include "server/web_server.hpp"

#include <cstdint>
#include <functional>
#include <string>

namespace surefoot::server {

/// A request of `/api/frames` (viewer/README.md): frames of ticks `from`, `from` + `stride`,
/// …, at most `count`; with `min_max` two frames for each stride.
struct FrameRequest {
  std::uint32_t from = 0, count = 1, stride = 1;
  bool min_max = false;
};

/// Answers a query with the block that `block` returns. Refuses a number out of range, saying what
/// is valid, and an Error of `block`.
[[nodiscard]] WebAnswer answer_frames(const WebContent::Query& query,
                                      const std::function<std::string(const FrameRequest&)>& block);

}  // namespace surefoot::server
