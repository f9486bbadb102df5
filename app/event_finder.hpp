#pragma once

#include "app/scenario_forces.hpp"
#include "surefoot/logging/applied_force.hpp"
#include "surefoot/logging/json_text.hpp"
#include "surefoot/logging/message_fields.hpp"
#include "surefoot/view/frame_block.hpp"
#include "surefoot/view/view_channels.hpp"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot {

/// Begin or end of a force from outside, as pages are told it beside the words.
struct ForceMark {
  std::string_view kind;   ///< "push" or "pull" of the operator, or "scenario"
  std::string_view body;   ///< its name
  bool begins = true;      ///< a push ends by itself, after its `duration`
  double duration = kNaN;  ///< of a push [s]
  double given = kNaN;     ///< of a pull that ends, as a whole [N·s]
};

/// The operator's; nothing of other changes. `given`: by a pull that ends [N·s].
[[nodiscard]] std::optional<ForceMark> force_mark(const logged::Change& change, double given);

/// As a member "force"; none where there is none.
void force_member(JsonText& json, const std::optional<ForceMark>& force);

/// Something that happened, as `/api/events` has it: {"time", "kind", "text"}, of a force "force".
[[nodiscard]] std::string text_event(double time, std::string_view kind, std::string_view text,
                                     const std::optional<ForceMark>& force = {});

/// Something that happened at a frame.
struct FoundEvent {
  std::string text;  ///< as `/api/events` has it
  std::optional<ForceMark> force;
};

/// Finds in frames, one after the other, what happened at them: the planner's events with their
/// leg, changes of the command's mode, and begin and end of the scenario's forces.
class EventFinder {
 public:
  /// `bodies`: their names by the rows of the truth's `xfrc_applied`.
  explicit EventFinder(const ViewChannels& channels, std::vector<std::string> bodies = {});

  /// What happened at this frame; valid until the next.
  [[nodiscard]] const std::vector<FoundEvent>& see(const ViewFrame& frame);
  /// A push or a pull of the operator, which is told as a change; before the frames from then on.
  void acts(const logged::Change& change) { scenario_.acts(change); }

 private:
  /// Of the sensors that a cause stands for; 0: for none.
  struct FaultOffsets {
    std::size_t fault = 0, joint = 0;
  };

  [[nodiscard]] std::string why_stopped(const std::vector<float>& floats) const;
  void see_forces(const ViewFrame& frame);

  std::size_t mode_, cause_;  // offsets of channels
  std::array<FaultOffsets, logged::kCauseNames.size()> faults_{};
  FaultOffsets then_;               // of the command: what was wrong when it stopped
  std::vector<float> last_;         // floats of the frame before
  std::vector<FoundEvent> events_;  // of the frame
  std::size_t force_, force_size_, rotation_;
  std::vector<std::string> bodies_;
  AppliedForceWatch forces_;
  ScenarioForces scenario_;
};

}  // namespace surefoot
