#pragma once

#include "surefoot/gaits/reactions/situation.hpp"

namespace surefoot::gaits {

/// Result of a gait's tick.
struct GaitOutcome {
  bool hands_over = false;         ///< to the other gait
  std::optional<Action> first{};   ///< of the gait that takes over
  bool begins_step = false;        ///< planned step: velocities may change
  bool has_new_reference = false;  ///< of COM and height, which may jump
};

/// A way to stand or to walk. One gait is active at a time: it reads the situation and changes the
/// body. Nothing allocates. If it throws, the controller holds its posture, then sits down. Derive
/// one of your own and add it to `OwnGaits`: scenarios and commands then name it.
class Gait {
 public:
  virtual ~Gait() = default;

  /// Forgets everything, as the robot may stand elsewhere: the gait is not active.
  virtual void restart() {}

  /// Becomes active, with all feet down, and carries out `first` if given.
  virtual void begin(Situation& now, Body& body, const std::optional<Action>& first) = 0;
  /// First half of a tick: observes the legs and reacts to their contacts.
  void observe(Situation& now, Body& body);
  /// Second half: reacts to slip and pushes, then advances the gait.
  GaitOutcome advance(Situation& now, Body& body);
  /// Does the heading keep still, because there is no step or the next one waits?
  [[nodiscard]] virtual bool waits(const Body& body) const = 0;
  /// Can the robot stop at any moment? Then its heading waits for late feet, its first step has the
  /// commanded velocity, and it leans against pushes and is slower for them.
  [[nodiscard]] virtual bool is_static() const { return true; }
  /// Time in which a foot moves by its stride relative to the torso [s].
  [[nodiscard]] virtual double stride_duration(double) const { return 0.0; }
  /// Of the torso, relative to the stance [m].
  [[nodiscard]] virtual double height() const { return 0.0; }
  /// Reference of the COM at this tick.
  [[nodiscard]] virtual ComPlan com(const Situation& now, const Body& body) const {
    return body.com.at(now.time);
  }
  /// How the torso goes up and down in a cycle [m].
  [[nodiscard]] virtual Motion<double> bounce() const { return {0.0, 0.0, 0.0}; }
  /// How the torso pitches in a cycle [rad].
  [[nodiscard]] virtual Motion<double> pitch() const { return {0.0, 0.0, 0.0}; }
  /// Of the reference, without its sway [m/s].
  [[nodiscard]] virtual double speed() const { return 0.0; }

 protected:
  using Reaction = std::optional<Action> (*)(const Situation&);
  void react(Reaction reaction, Situation& now, Body& body);
  void act(const Action& action, Situation& now, Body& body);
  /// Has the load changed, or the COM left its plan, so much that a new plan is needed?
  [[nodiscard]] static bool wants_plan(const Situation& now);

  [[nodiscard]] virtual GaitStatus status(const Body&) const { return {}; }
  /// Reaction to a leg's event.
  [[nodiscard]] virtual std::optional<Action> answer(LegEvent event, const Situation& now,
                                                     Leg leg) const;
  /// Updates the gait's own times and state after an action.
  virtual void follow(const Action&, const Situation&, Body&) {}
  virtual void plan_com(const Situation& now, Body& body) = 0;
  virtual GaitOutcome go_on(Situation& now, Body& body) = 0;
};

}  // namespace surefoot::gaits
