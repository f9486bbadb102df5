#pragma once

#include "server/web_server.hpp"

#include <cstdint>
#include <functional>
#include <string>

namespace surefoot::server {

/// What `/api/frames` is asked for (docs/view_protocol.md): frames of ticks `from`, `from` +
/// `stride`, …, at most `count` of them; with `min_max` two frames for each stride.
struct FrameRequest {
  std::uint32_t from = 0, count = 1, stride = 1;
  bool min_max = false;
};

/// The frames that a query asks for, as `block` gives them; a refusal with what would be valid
/// where a number of it is none or out of its range, or where `block` throws Error.
[[nodiscard]] WebAnswer answer_frames(const WebContent::Query& query,
                                      const std::function<std::string(const FrameRequest&)>& block);

}  // namespace surefoot::server
