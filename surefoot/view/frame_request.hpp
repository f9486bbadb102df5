#pragma once

#include "surefoot/view/web_server.hpp"

#include <cstdint>

namespace surefoot {

/// What `/api/frames` is asked for (docs/view_protocol.md): frames of ticks `from`, `from` +
/// `stride`, …, at most `count` of them; with `min_max` two frames for each stride.
struct FrameRequest {
  std::uint32_t from = 0, count = 1, stride = 1;
  bool min_max = false;
};

/// Throws Error, with what would be valid, where a number of it is none or out of its range.
[[nodiscard]] FrameRequest read_frame_request(const WebContent::Query& query);

}  // namespace surefoot
