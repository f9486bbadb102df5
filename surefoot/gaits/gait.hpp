#pragma once

#include "surefoot/gaits/reactions/situation.hpp"

namespace surefoot::gaits {

/// What came of a gait's tick.
struct GaitOutcome {
  bool hands_over = false;        ///< a stand that is to walk, or a walk that has ended
  std::optional<Action> first{};  ///< what the gait that takes over begins with
  bool begins_step = false;  ///< by the gait's own time: the next step may have other velocities
};

/// A way to stand or to walk. One gait has the legs at a time. It sees the situation and changes
/// the body. Nothing allocates or throws.
class Gait {
 public:
  virtual ~Gait() = default;

  /// Takes the legs over, which all stand, and begins with `first`, if there is such an action.
  virtual void begin(Situation& now, Body& body, const std::optional<Action>& first) = 0;
  /// The first half of a tick: looks at the legs, and reacts to what they have met.
  void observe(Situation& now, Body& body);
  /// The second half: reacts to feet that slide and to pushes, then goes on in time.
  GaitOutcome advance(Situation& now, Body& body);
  /// Does the heading stay as it is, because no step is going on or the next one waits?
  [[nodiscard]] virtual bool waits(const Body& body) const = 0;

 protected:
  using Reaction = std::optional<Action> (*)(const Situation&);
  void react(Reaction reaction, Situation& now, Body& body);
  void act(const Action& action, Situation& now, Body& body);
  /// Does the load, or where the COM has gone, ask for a new COM plan?
  [[nodiscard]] static bool wants_plan(const Situation& now);

  [[nodiscard]] virtual GaitStatus status(const Body&) const { return {}; }
  /// Its own times and state after an action that legs and ground already know.
  virtual void follow(const Action&, const Situation&, Body&) {}
  virtual void plan_com(const Situation& now, Body& body) = 0;
  virtual GaitOutcome go_on(Situation& now, Body& body) = 0;
};

}  // namespace surefoot::gaits
