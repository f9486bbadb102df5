#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/parts/impact_detector.hpp"
#include "surefoot/gaits/parts/leg_limits.hpp"
#include "surefoot/gaits/parts/swing_curve.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/motion_plan.hpp"

namespace surefoot::gaits {

/// What a leg notices at a tick.
enum class LegEvent { none, touchdown, caught, unreachable, lost, flew };

/// A leg as it is believed to be, in W.
struct LegObservation {
  const model::PointKinematics &hip, &foot;
  const Vec3& force;              ///< estimated, of the ground on the foot [N]
  const Vec3& normal;             ///< of the terrain
  double force_per_torque = 0.0;  ///< error of the normal force by one of the joint torques [1/m]
};

/// How fast a foot that searches goes on down: it waits where the foot stays behind its reference,
/// and at the end of the leg's reach.
struct SearchPace {
  /// The search waits for a foot further behind [m].
  [[nodiscard]] double reference_lead() const { return scale.length * 0.02; }

  /// One tick of `period` [s]; the foot is so far behind its reference, the leg reaches so much
  /// further [m].
  void update(double behind, double reach_left, double period) {
    constexpr double kSlowZone = 0.03;  // it slows down this far before the end of the reach [m]
    constexpr double kWaiting = 0.1;    // a pace below this is none
    const double slow_zone = scale.length * kSlowZone;
    pace = behind > reference_lead() ? 0.0 : std::clamp(reach_left / slow_zone, 0.0, 1.0);
    stuck_for = std::max(0.0, stuck_for + (pace < kWaiting ? period : -period));
  }
  /// Has it waited for so long that there is no ground within reach?
  [[nodiscard]] bool is_stuck() const { return stuck_for > scale.time() * 0.3; }

  Scale scale{};           ///< of the robot
  double pace = 1.0;       ///< 1: at touchdown speed, 0: the search waits
  double stuck_for = 0.0;  ///< how long it has waited [s]
};

/// Phase, reference and force limits of one leg, and the tests that end its phases.
class LegMotion {
 public:
  /// `period` of the control loop [s], `scale` of the robot.
  LegMotion(const PlannerOptions& options, double period, const Scale& scale = {})
      : swing_(options.swing),
        touchdown_(options.contact),
        force_(options.force),
        reflex_(options.reflex),
        period_(period),
        scale_(scale),
        search_{scale},
        impact_(options.contact, period) {}

  /// Stands at p from `time` on; `loaded` from long before (no ramp).
  void plant(double time, const Vec3& p_WF, bool loaded = false);
  /// Ramps f_max down to reach 0 at `lift_off_time`.
  void unload(double lift_off_time);
  /// Takes the lift-off back: ramps up again.
  void reload(double time);
  /// Leaves the ground.
  void lift(double time, const SwingTarget& target);
  /// Goes straight down along −normal, from p and v on: a lost stance foot, or a swing to be ended
  /// at once.
  void search(double time, const Vec3& p_WF, const Vec3& v_WF, const Vec3& normal);

  /// Looks at the leg as it is.
  [[nodiscard]] LegEvent observe(double time, const LegObservation& seen);

  /// Without the friction.
  [[nodiscard]] FootPlan plan(double time) const;
  [[nodiscard]] LegPhase phase() const { return phase_; }
  [[nodiscard]] bool down() const { return in_contact(phase_); }
  [[nodiscard]] const Vec3& foothold() const { return foothold_; }
  /// Time since the touchdown (or lift-off) that began the phase [s].
  [[nodiscard]] double since(double time) const { return time - begin_; }
  [[nodiscard]] const SwingTarget& target() const { return curve_.target(); }
  /// Is the foot's estimated normal force small enough to lift it?
  [[nodiscard]] bool unloaded() const { return normal_force_ < touchdown_.lift_off_force; }

 private:
  [[nodiscard]] LegEvent observe_stance(double time, const LegObservation& seen);
  /// Is a foot that was put down at once, or that searched from where it was, in the air again: it
  /// rebounded, or there was no ground?
  [[nodiscard]] bool flies(double time, const LegObservation& seen) const;
  [[nodiscard]] LegEvent observe_swing(double time, const LegObservation& seen);
  /// How little the torques say of a force, by the leg's posture: a factor from 1 on.
  [[nodiscard]] double doubt() const;
  [[nodiscard]] bool is_caught(double time, const LegObservation& seen);
  /// Unit vector of where the foot is asked to go, without its way down; 0 if nowhere.
  [[nodiscard]] Vec3 way(const Motion<Vec3>& asked) const;
  /// Is the foot so far from its reference, along the ground, that it could not follow?
  [[nodiscard]] bool strays(double time, const Vec3& p_WF) const;
  [[nodiscard]] bool touches(double time, const LegObservation& seen);
  [[nodiscard]] LegEvent observe_search(double time, const Vec3& p_WF);
  [[nodiscard]] Motion<Vec3> reference(double time) const;
  [[nodiscard]] double force_max(double time) const;

  SwingOptions swing_;
  TouchdownOptions touchdown_;
  ForceOptions force_;
  ReflexOptions reflex_;
  double period_;
  Scale scale_;
  LegPhase phase_ = LegPhase::stance;
  double begin_ = 0.0, lift_off_time_ = kNever;  // [s]
  Vec3 foothold_ = Vec3::Zero();
  Vec3 stood_ = Vec3::Zero();   // where it stood before it came down there, in W [m]
  Vec3 landed_ = Vec3::Zero();  // where the foot came down, or was loaded again, in W [m]
  SwingCurve curve_;
  Vec3 hip_ = Vec3::Zero(), hip_velocity_ = Vec3::Zero();  // in W [m], [m/s]
  double normal_force_ = 0.0, force_per_torque_ = 0.0;
  double light_for_ = 0.0;  // how long a loaded stance foot has carried nothing [s]
  SearchPace search_;
  ImpactDetector impact_;
  double held_for_ = 0.0;  // how long something has been in the foot's way [s]
  int firm_ticks_ = 0;     // ticks in a row with a firm contact
};

/// The motion of all legs.
class Legs {
 public:
  Legs(const PlannerOptions& options, double period, const Scale& scale)
      : legs_(per_leg(LegMotion(options, period, scale))) {}

  [[nodiscard]] LegMotion& operator[](Leg leg) { return legs_[index(leg)]; }
  [[nodiscard]] const LegMotion& operator[](Leg leg) const { return legs_[index(leg)]; }
  [[nodiscard]] PerLeg<bool> down() const {
    PerLeg<bool> result{};
    for (const Leg k : kLegs) result[index(k)] = (*this)[k].down();
    return result;
  }
  [[nodiscard]] bool all_down() const { return std::ranges::all_of(legs_, &LegMotion::down); }
  [[nodiscard]] PerLeg<Vec3> footholds() const {
    PerLeg<Vec3> result;
    for (const Leg k : kLegs) result[index(k)] = (*this)[k].foothold();
    return result;
  }

 private:
  PerLeg<LegMotion> legs_;
};

}  // namespace surefoot::gaits
