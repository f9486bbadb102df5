#pragma once

#include "surefoot/signals/motion_plan.hpp"
#include "surefoot/view/frame_block.hpp"
#include "surefoot/view/view_channels.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace surefoot {

/// Something that happened, as `/api/events` has it: {"time", "kind", "text"}.
[[nodiscard]] std::string text_event(double time, std::string_view kind, std::string_view text);

/// Finds in frames, one after the other, what happened at them: the planner's events with their
/// leg, and changes of the command's mode.
class EventFinder {
 public:
  explicit EventFinder(const ViewChannels& channels);

  /// Appends what happened at this frame as `/api/events` has it.
  void see(const ViewFrame& frame, std::vector<std::string>& events);

 private:
  [[nodiscard]] PerLeg<LegPhase> phases(const std::vector<float>& floats) const;

  std::size_t event_, mode_, cause_;  // offsets of channels
  PerLeg<std::size_t> phases_{};
  std::vector<float> last_;  // floats of the frame before
};

}  // namespace surefoot
