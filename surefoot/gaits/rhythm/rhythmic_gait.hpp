#pragma once

#include "surefoot/gaits/gait.hpp"
#include "surefoot/gaits/rhythm/cycle_motion.hpp"
#include "surefoot/gaits/rhythm/driven_com.hpp"
#include "surefoot/gaits/rhythm/phase_clock.hpp"
#include "surefoot/gaits/rhythm/velocity_integral.hpp"

namespace surefoot::gaits {

/// A gait by a clock, such as a trot: legs lift off at their times, whatever the others do, and
/// step to where they catch the robot. The clock waits for late feet before a leg is unloaded, and
/// goes back to the landing of a foot that flies off again. Where the gait is slow its feet rise
/// higher, and the torso is lower, for legs that reach further down. It ends with all feet down,
/// the capture point between them, and as wide apart as what comes next needs.
class RhythmicGait final : public Gait {
 public:
  RhythmicGait(const PlannerOptions& options, const Scale& scale)
      : options_(options.rhythm),
        gathering_(gathering(options)),
        clock_(options.rhythm),
        cycle_(options, scale) {}

  void begin(Situation& now, Body& body, const std::optional<Action>& first) override;
  [[nodiscard]] bool waits(const Body&) const override { return sways_only_; }
  [[nodiscard]] bool is_static() const override { return false; }
  [[nodiscard]] double stride_duration(double) const override;
  [[nodiscard]] ComPlan com(const Situation& now, const Body& body) const override;
  [[nodiscard]] Motion<double> bounce() const override {
    return {sway_.p.z(), sway_.v.z(), sway_.a.z()};
  }
  [[nodiscard]] Motion<double> pitch() const override { return pitch_; }
  [[nodiscard]] double speed() const override { return com_.plan().v.norm(); }
  [[nodiscard]] double height() const override { return -slowness() * options_.crouch; }

 private:
  [[nodiscard]] std::optional<Action> answer(LegEvent event, const Situation& now,
                                             Leg leg) const override;
  void follow(const Action& action, const Situation& now, Body& body) override;
  void plan_com(const Situation&, Body&) override {}
  GaitOutcome go_on(Situation& now, Body& body) override;

  /// 1 in a slow gait, 0 in a fast one.
  [[nodiscard]] double slowness() const;
  /// The legs that search for ground after this one lost it.
  [[nodiscard]] PerLeg<bool> searches_for(Leg lost, bool flew, const Situation& now) const;
  /// The rhythm in which feet that stand wide come closer: pairs take turns.
  [[nodiscard]] static RhythmOptions gathering(const PlannerOptions& options);
  [[nodiscard]] bool is_spread(const Situation& now) const;
  /// Does no leg lift off any more?
  [[nodiscard]] bool stops(const Situation& now) const;
  /// All feet are down: ends the gait, or goes on with steps into another stance, or in its own.
  GaitOutcome go_on_from_stop(const Situation& now, Body& body);
  /// Could the robot stop where it is? Its capture point is then near the middle of the feet; that
  /// of the steady motion counts where the next gait begins at rest.
  [[nodiscard]] bool is_poised(const Situation& now) const;
  [[nodiscard]] bool is_about_to_lift(const Body& body) const;
  /// Must the first legs push off, as all lift off at once or the torso pitches? They stand for a
  /// whole stance before.
  [[nodiscard]] bool pushes_off() const;
  void start_clock(const Situation& now, const Body& body);
  [[nodiscard]] Leg first_leg(const Situation& now, const Body& body) const;
  void drive_com(const Situation& now);
  /// Sways, ever more in the first cycle, or until the first lift-off where legs push off for it.
  /// A slow gait goes to its place in the cycle first, with its clock and commands at rest.
  void sway(const Situation& now);
  void advance_clock(const Body& body);
  void move_leg(Leg leg, const Situation& now, Body& body);
  void lift(Leg leg, const Situation& now, Body& body);
  /// Is a foot in the air that should land before the next lift-off, its own or another's, whose
  /// force ramp begins?
  [[nodiscard]] bool misses_foot(const Body& body) const;
  [[nodiscard]] bool is_slow(const Situation& now) const;
  [[nodiscard]] Vec3 foothold(Leg leg, double until_landing, const Situation& now) const;

  RhythmOptions options_, gathering_;
  PhaseClock clock_;
  CycleMotion cycle_;
  Motion<Vec3> sway_{Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};  // in heading axes
  Motion<double> pitch_{0.0, 0.0, 0.0};
  double begin_ = 0.0, grows_for_ = 0.0;  // of the sway [s]
  bool sways_only_ = false;               // no leg lifts off yet
  DrivenCom com_;
  VelocityIntegral integral_;
  double waited_ = 0.0;   // of the clock, for late feet [s]
  StanceOptions stance_;  // into which the feet step
  bool gathers_ = false;  // the steps into this stance
  bool stops_ = false;    // no leg lifts off any more
};

}  // namespace surefoot::gaits
