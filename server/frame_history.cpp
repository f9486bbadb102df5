#include "server/frame_history.hpp"

#include <algorithm>
#include <optional>

namespace surefoot::server {

void FrameHistory::add(SharedBlock block) {
  std::string_view rest = *block.bytes;
  if (rest.empty()) return;
  block.lost = 0;  // a later page lost nothing
  Piece piece{.first = first_frame(rest).tick, .last = 0, .block = std::move(block)};
  for (; !rest.empty(); rest.remove_prefix(first_frame(rest).bytes.size())) {
    piece.last = first_frame(rest).tick;
  }
  pieces_.push_back(std::move(piece));
  while (std::uint64_t{pieces_.front().last} + ticks_ <= pieces_.back().last) pieces_.pop_front();
}

std::uint32_t FrameHistory::first_tick() const {
  return pieces_.empty() ? 0 : pieces_.front().first;
}

double FrameHistory::first_time() const {
  return pieces_.empty() ? 0.0 : first_frame(*pieces_.front().block.bytes).time;
}

std::vector<SharedBlock> FrameHistory::newest(std::size_t frames) const {
  auto first = pieces_.end();
  for (std::size_t found = 0; first != pieces_.begin() && found < frames;) {
    found += (--first)->block.frames;
  }
  std::vector<SharedBlock> blocks;
  for (; first != pieces_.end(); ++first) blocks.push_back(first->block);
  return blocks;
}

template <typename Call>
void FrameHistory::visit(std::uint64_t from, std::uint64_t to, const Call& call) const {
  auto piece = std::ranges::lower_bound(pieces_, from, {}, &Piece::last);
  for (; piece != pieces_.end() && piece->first < to; ++piece) {
    for (std::string_view rest = *piece->block.bytes; !rest.empty();) {
      const PackedFrame frame = first_frame(rest);
      rest.remove_prefix(frame.bytes.size());
      if (frame.tick >= from && frame.tick < to) call(frame);
    }
  }
}

std::uint32_t FrameHistory::pack_ticks(const FrameRequest& request, std::string& out) const {
  std::uint32_t frames = 0;
  const std::uint64_t to = request.from + std::uint64_t{request.count} * request.stride;
  visit(request.from, to, [&](const PackedFrame& frame) {
    if ((frame.tick - request.from) % request.stride != 0) return;
    out.append(frame.bytes);
    ++frames;
  });
  return frames;
}

std::uint32_t FrameHistory::pack_ranges(const FrameRequest& request, std::size_t num_floats,
                                        double period, std::string& out) const {
  FrameRange range;
  std::vector<float> floats(num_floats);
  std::optional<std::uint32_t> begin;  // of the current stride
  std::uint32_t frames = 0;
  const auto finish = [&] {
    if (!begin) return;
    range.pack(*begin, period * *begin, out);
    frames += 2;
  };
  const std::uint64_t to = request.from + std::uint64_t{request.count / 2} * request.stride;
  visit(request.from, to, [&](const PackedFrame& frame) {
    const std::uint32_t stride = frame.tick - (frame.tick - request.from) % request.stride;
    if (begin != stride) {
      finish();
      begin = stride;
      range.clear(num_floats);
    }
    read_floats(frame, floats);
    range.add(floats);
  });
  finish();
  return frames;
}

std::string FrameHistory::block(const FrameRequest& request, std::uint32_t generation,
                                std::size_t num_floats, double period) const {
  std::string bytes(kBlockHeadBytes, '\0');
  const std::uint32_t frames = request.min_max ? pack_ranges(request, num_floats, period, bytes)
                                               : pack_ticks(request, bytes);
  const auto head = packed({.frames = frames, .dropped = 0, .generation = generation});
  std::ranges::copy(head, bytes.begin());
  return bytes;
}

}  // namespace surefoot::server
