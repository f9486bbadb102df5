#pragma once

#include "server/frame_block.hpp"
#include "server/view_channels.hpp"
#include "surefoot/logging/applied_force.hpp"
#include "surefoot/logging/message_fields.hpp"
#include "surefoot/logging/scenario_forces.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace surefoot::server {

/// An event as in `/api/events`: {"time", "kind", "text"}.
[[nodiscard]] std::string text_event(double time, std::string_view kind, std::string_view text);

/// Events as a JSON array.
[[nodiscard]] std::string json_list(const auto& events) {
  std::string text = "[";
  for (const std::string& event : events) text += (text.size() == 1 ? "" : ",") + event;
  return text + "]";
}

/// Finds events in consecutive frames: the planner's events with their leg, changes of the
/// command's mode, and begin and end of the scenario's forces.
class EventFinder {
 public:
  /// `bodies`: names by the rows of the truth's `xfrc_applied`.
  explicit EventFinder(const ViewChannels& channels, std::vector<std::string> bodies = {});

  /// Events of this frame as in `/api/events`; valid until the next call.
  [[nodiscard]] const std::vector<std::string>& see(const ViewFrame& frame);
  /// Takes an operator's push, which is shown as a change; call it before the frames from then on.
  void acts(const logged::Change& change) { scenario_.acts(change); }

 private:
  void see_forces(const ViewFrame& frame);

  int num_legs_;
  std::size_t mode_, rotation_;  // offsets of channels
  ViewChannel stop_, force_;
  std::vector<float> last_;          // floats of the frame before
  std::vector<std::string> events_;  // of the frame
  std::vector<std::string> bodies_;
  logging::AppliedForceWatch forces_;
  logging::ScenarioForces scenario_;
};

}  // namespace surefoot::server
