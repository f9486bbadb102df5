#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/parts/impact_detector.hpp"
#include "surefoot/gaits/parts/leg_limits.hpp"
#include "surefoot/gaits/parts/swing_curve.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/motion_plan.hpp"

namespace surefoot::gaits {

/// What happened to a leg at a tick.
enum class LegEvent { none, touchdown, caught, unreachable, lost, airborne };

/// The estimated state of a leg, in W.
struct LegObservation {
  const model::PointKinematics &hip, &foot;
  const Vec3& force;              ///< estimated contact force on the foot [N]
  const Vec3& normal;             ///< of the terrain
  double force_per_torque = 0.0;  ///< normal force per joint torque [1/m]
};

/// Speed of a search as a share of the touchdown speed: it waits for a foot that lags behind its
/// reference, and at the end of the leg's reach.
struct SearchPace {
  /// Tracking error above which the search waits [m].
  [[nodiscard]] double reference_lead() const { return scale.length * 0.02; }

  /// One tick of `period` [s]. `behind` is the foot's tracking error, `reach_left` the remaining
  /// reach of the leg [m].
  void update(double behind, double reach_left, double period) {
    constexpr double kSlowZone = 0.03;  // before the end of the reach [m]
    constexpr double kMinPace = 0.1;    // below it the search waits
    const double slow_zone = scale.length * kSlowZone;
    pace = behind > reference_lead() ? 0.0 : std::clamp(reach_left / slow_zone, 0.0, 1.0);
    stuck_for = std::max(0.0, stuck_for + (pace < kMinPace ? period : -period));
  }
  /// Has it waited so long that there is no ground within reach?
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
        impact_(options.contact, period, scale) {}

  /// Begins a stance at p; `loaded`: without a force ramp.
  void plant(double time, const Vec3& p_WF, bool loaded = false);
  /// Ramps f_max down to reach 0 at `lift_off_time`.
  void unload(double lift_off_time);
  /// Cancels the lift-off: ramps f_max up again.
  void reload(double time);
  /// Goes on with other options; f_max does not jump. The foot is down.
  void use(const PlannerOptions& options, double time);
  /// Begins a swing.
  void lift(double time, const SwingTarget& target);
  /// Moves the goal of a swing, or of a search along the ground, without a jump.
  void aim(double time, const Vec3& goal) {
    if (!down()) curve_.aim(since(time), goal);
  }
  /// Moves straight down along −normal, starting at p and v: for a stance foot that lost contact,
  /// or a swing that must end at once.
  void search(double time, const Vec3& p_WF, const Vec3& v_WF, const Vec3& normal);

  /// One tick.
  [[nodiscard]] LegEvent observe(double time, const LegObservation& seen);

  /// The plan of the foot, except for its friction.
  [[nodiscard]] FootPlan plan(double time) const;
  [[nodiscard]] LegPhase phase() const { return phase_; }
  [[nodiscard]] bool down() const { return in_contact(phase_); }
  [[nodiscard]] const Vec3& foothold() const { return foothold_; }
  /// Time since the touchdown (or lift-off) that began the phase [s].
  [[nodiscard]] double since(double time) const { return time - begin_; }
  /// Time since the touchdown, of a foot that is down, however its force was limited since [s].
  [[nodiscard]] double stood(double time) const { return time - touchdown_time_; }
  [[nodiscard]] const SwingTarget& target() const { return curve_.target(); }
  /// Is the foot's estimated normal force small enough to lift it?
  [[nodiscard]] bool unloaded() const { return normal_force_ < touchdown_.lift_off_force; }

 private:
  [[nodiscard]] LegEvent observe_stance(double time, const LegObservation& seen);
  /// Has a foot left the ground again soon after its touchdown, or had it none?
  [[nodiscard]] bool is_airborne(double time, const LegObservation& seen) const;
  [[nodiscard]] LegEvent observe_swing(double time, const LegObservation& seen);
  /// Factor ≥ 1 on force thresholds, for the error of the estimated force in this posture.
  [[nodiscard]] double force_uncertainty() const;
  [[nodiscard]] bool is_caught(double time, const LegObservation& seen);
  /// Unit direction of the reference's velocity without its downward part; 0 if it is slow.
  [[nodiscard]] Vec3 motion_direction(const Motion<Vec3>& asked) const;
  /// Is the tracking error along the ground too large?
  [[nodiscard]] bool is_off_track(double time, const Vec3& p_WF) const;
  /// Is a foot in mid-swing fast, or one in a fast search as fast as asked, or on its way up?
  [[nodiscard]] bool moves_freely(const Vec3& v_WF, double descent) const;
  [[nodiscard]] double search_speed() const {
    return std::max(swing_.search_speed, swing_.touchdown_speed);
  }
  /// Has it hit the ground? `brake`: velocity along the normal that the reference lost [m/s].
  [[nodiscard]] bool has_bounced(const Motion<Vec3>& asked, const Vec3& v_WF, double force,
                                 double brake);
  [[nodiscard]] bool searches_fast() const { return search_speed() > swing_.touchdown_speed; }
  [[nodiscard]] bool touches(double time, const LegObservation& seen);
  [[nodiscard]] LegEvent observe_search(double time, const Vec3& p_WF);
  [[nodiscard]] Motion<Vec3> reference(double time) const;
  [[nodiscard]] double force_max(double time) const;
  void load_from(double force_max, double time);

  SwingOptions swing_;
  TouchdownOptions touchdown_;
  ForceOptions force_;
  ReflexOptions reflex_;
  double period_;
  Scale scale_;
  LegPhase phase_ = LegPhase::stance;
  double begin_ = 0.0, touchdown_time_ = 0.0, lift_off_time_ = kNever;  // [s]
  Vec3 foothold_ = Vec3::Zero();
  Vec3 previous_foothold_ = Vec3::Zero();  // in W [m]
  Vec3 touchdown_point_ = Vec3::Zero();    // where the stance began or was loaded again, in W [m]
  SwingCurve curve_;
  Vec3 hip_ = Vec3::Zero(), hip_velocity_ = Vec3::Zero();  // in W [m], [m/s]
  double normal_force_ = 0.0, force_per_torque_ = 0.0;
  double unloaded_for_ = 0.0;  // how long a stance foot has carried no force [s]
  SearchPace search_;
  ImpactDetector impact_;
  double blocked_for_ = 0.0;  // how long an obstacle has blocked the foot [s]
  bool hit_ = false;          // the ground, and has not fallen as asked since
  int contact_ticks_ = 0;     // in a row
};

/// The motion of all legs.
class Legs {
 public:
  Legs(const PlannerOptions& options, double period, const Scale& scale)
      : legs_(options.gait.num_legs(), LegMotion(options, period, scale)) {}

  [[nodiscard]] LegMotion& operator[](Leg leg) { return legs_[index(leg)]; }
  [[nodiscard]] const LegMotion& operator[](Leg leg) const { return legs_[index(leg)]; }
  [[nodiscard]] std::span<const Leg> all() const { return legs_.legs(); }
  [[nodiscard]] PerLeg<bool> down() const {
    PerLeg<bool> result(num_legs(), false);
    for (const Leg k : all()) result[index(k)] = (*this)[k].down();
    return result;
  }
  [[nodiscard]] bool all_down() const { return std::ranges::all_of(legs_, &LegMotion::down); }
  [[nodiscard]] PerLeg<Vec3> footholds() const {
    PerLeg<Vec3> result(num_legs(), Vec3::Zero());
    for (const Leg k : all()) result[index(k)] = (*this)[k].foothold();
    return result;
  }

 private:
  [[nodiscard]] int num_legs() const { return static_cast<int>(legs_.size()); }

  PerLeg<LegMotion> legs_;
};

}  // namespace surefoot::gaits
