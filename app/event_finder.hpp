#pragma once

#include "surefoot/logging/applied_force.hpp"
#include "surefoot/logging/message_fields.hpp"
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
/// leg, changes of the command's mode, and begin and end of forces from outside.
class EventFinder {
 public:
  /// `bodies`: their names by the rows of the truth's `xfrc_applied`.
  explicit EventFinder(const ViewChannels& channels, std::vector<std::string> bodies = {});

  /// Appends what happened at this frame as `/api/events` has it.
  void see(const ViewFrame& frame, std::vector<std::string>& events);
  /// A push or a pull that the operator begins or ends is told as a change, and not again; before
  /// the frames from then on.
  void acts(const logged::Change& change);

 private:
  void see_forces(const ViewFrame& frame, std::vector<std::string>& events);
  [[nodiscard]] bool is_told(double time) const;
  [[nodiscard]] PerLeg<LegPhase> phases(const std::vector<float>& floats) const;

  std::size_t event_, mode_, cause_;  // offsets of channels
  PerLeg<std::size_t> phases_{};
  std::vector<float> last_;  // floats of the frame before
  std::size_t force_, force_size_, rotation_;
  std::vector<std::string> bodies_;
  AppliedForceWatch forces_;
  std::vector<double> told_;  // times at which the operator began or ended a force
};

}  // namespace surefoot
