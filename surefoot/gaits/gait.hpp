#pragma once

#include "surefoot/gaits/body.hpp"
#include "surefoot/gaits/gait_tick.hpp"
#include "surefoot/gaits/reactions/action.hpp"

#include <optional>

namespace surefoot {

/// What came of a gait's tick.
struct GaitOutcome {
  bool hands_over = false;        ///< a stand that is to walk, or a walk that has ended
  std::optional<Action> first{};  ///< what the gait that takes over begins with
  bool begins_step = false;  ///< by the gait's own time: the next step may have other velocities
};

/// A way to stand or to walk. One gait has the legs at a time. Nothing allocates or throws.
class Gait {
 public:
  virtual ~Gait() = default;

  /// Takes the legs over, which all stand, and begins with `first`, if there is such an action.
  virtual void begin(const GaitTick& tick, Body& body,
                     const std::optional<Action>& first) noexcept = 0;
  /// The first half of a tick: looks at the legs, and reacts to what they have met.
  virtual void observe(const GaitTick& tick, Body& body) noexcept = 0;
  /// The second half: reacts to feet that slide and to pushes, then goes on in time.
  virtual GaitOutcome advance(const GaitTick& tick, Body& body) noexcept = 0;

  /// Does the heading stay as it is, because no step is going on or the next one waits?
  [[nodiscard]] virtual bool waits(const Body& body) const = 0;
};

}  // namespace surefoot
