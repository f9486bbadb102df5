#pragma once

#include "server/frame_range.hpp"
#include "server/frame_request.hpp"
#include "server/web_server.hpp"

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::server {

/// The last frames of a live run, in the bytes that were sent; later pages request them.
class FrameHistory {
 public:
  /// Keeps so many ticks, and the rest of the oldest block.
  explicit FrameHistory(std::uint32_t ticks) : ticks_(ticks) {}

  /// Blocks come in the order of their ticks.
  void add(SharedBlock block);
  void clear() { pieces_.clear(); }

  [[nodiscard]] bool is_empty() const { return pieces_.empty(); }
  /// The oldest kept tick; 0: none.
  [[nodiscard]] std::uint32_t first_tick() const;
  /// Its time [s].
  [[nodiscard]] double first_time() const;
  /// The newest blocks, with at least `frames` frames if there are so many.
  [[nodiscard]] std::vector<SharedBlock> newest(std::size_t frames) const;

  /// A block of the requested ticks that are kept. `num_floats` of each frame; `period` of a tick
  /// [s].
  [[nodiscard]] std::string block(const FrameRequest& request, std::uint32_t generation,
                                  std::size_t num_floats, double period) const;

 private:
  struct Piece {
    std::uint32_t first, last;  // ticks
    SharedBlock block;
  };

  /// Calls with each frame of ticks [from, to).
  template <typename Call>
  void visit(std::uint64_t from, std::uint64_t to, const Call& call) const;
  [[nodiscard]] std::uint32_t pack_ticks(const FrameRequest& request, std::string& out) const;
  [[nodiscard]] std::uint32_t pack_ranges(const FrameRequest& request, std::size_t num_floats,
                                          double period, std::string& out) const;

  std::uint32_t ticks_;
  std::deque<Piece> pieces_;
};

}  // namespace surefoot::server
