#pragma once

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/body.hpp"
#include "surefoot/gaits/command_limits.hpp"
#include "surefoot/gaits/crawl/crawl.hpp"
#include "surefoot/gaits/gait_choice.hpp"
#include "surefoot/gaits/parts/calibration_schedule.hpp"
#include "surefoot/gaits/parts/friction_frame.hpp"
#include "surefoot/gaits/parts/torso_reference.hpp"
#include "surefoot/gaits/reference_blend.hpp"
#include "surefoot/gaits/rhythm/rhythmic_gait.hpp"
#include "surefoot/gaits/stand/flat_stand.hpp"
#include "surefoot/gaits/stand/stand.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace surefoot::gaits {

/// Plans the motion: selects the gait, stand, crawl or one by a clock, changes it as the user
/// commands, and does what all gaits need: command limits, heading, torso along the plane through
/// the footholds, calibration. A robot with flat feet stands (`FlatStand`), whatever the command.
/// Plans relative to the footholds, independent of the world's origin.
class Planner {
 public:
  /// `period` of the control loop [s], `scale` of the robot. A command may name one of `gaits`;
  /// `first` is the gait of one that names none, as in `UserCommand::gait`. Throws Error unless the
  /// gaits' orders have each leg once, and where a user's gait is not made.
  Planner(const PlannerOptions& options, double period, const Scale& scale = {},
          const std::vector<NamedGait>& gaits = {}, int first = UserCommand::kOwnGait);

  /// One tick. Allocates nothing. What a gait of the user's own throws is thrown as Error with the
  /// gait's name.
  const MotionPlan& update(const UserCommand& command, const RobotState& state,
                           const model::Dynamics& dynamics, const HierarchyOutcome& last = {});

  /// Before an update: resets to `fresh`, which has had no tick, but keeps the steps taken.
  void begin_anew(const Planner& fresh);

  /// Between two ticks: sets the friction coefficient of all feet. Throws Error unless above 0.
  void set_friction(double friction);

  /// Before an update: did the calibration that has just ended find the legs and the payload? If
  /// not, a disturbed calibration is repeated.
  void tell_calibration_known(bool known) { calibration_.tell_known(known); }

  /// Estimated unit normal of the terrain in W, filtered by the friction frame. Continuous, except
  /// when a calibration restarts the plan.
  [[nodiscard]] const Vec3& terrain_normal() const { return friction_frame_.normal(); }
  [[nodiscard]] int steps_taken() const { return body_.steps_taken; }
  /// Must the estimate restart before the next update, and the plan with it? For a calibration that
  /// the user requested or that is repeated, once the robot has stood still for 1 s.
  [[nodiscard]] bool restarts() const { return restarts_; }
  /// By the last plan.
  [[nodiscard]] bool is_undisturbed(const RobotState& state) const;

 private:
  void plan(const UserCommand& command, const RobotState& state, const model::Dynamics& dynamics,
            const HierarchyOutcome& last);
  void initialise(const RobotState& state, const model::Dynamics& dynamics);
  /// A restart or a calibration of the estimate moves the footholds in W.
  void relearn_ground();
  [[nodiscard]] CommandContext command_context() const;
  /// The command for the gait; updates the heading.
  [[nodiscard]] UserCommand limit(const UserCommand& command);
  /// The gait of a walk.
  [[nodiscard]] const Gait& walk() const {
    const std::size_t place = static_cast<std::size_t>(present_ + 1);
    if (own_[place] != nullptr) return *own_[place];
    if (!body_.options.rhythm.enabled) return crawl_;
    return rhythms_[place];
  }
  [[nodiscard]] Gait& walk() { return const_cast<Gait&>(std::as_const(*this).walk()); }
  [[nodiscard]] Gait& gait() { return walks_ ? walk() : stand_; }
  /// May the robot change to the wanted gait, which it is slow enough for?
  [[nodiscard]] bool may_change() const;
  /// That the present gait and the wanted one allow [m/s].
  [[nodiscard]] double speed_max() const;
  /// Makes the wanted gait the present one. All feet are down.
  void change_gait(double time);
  void move_legs(Situation& now);
  void finish_calibration(const RobotState& state);
  /// What the calibration and the gait add to the torso's angles.
  [[nodiscard]] Motion<Vec3> turn(double time);
  void write_plan(const Situation& now);

  Body body_;
  Stand stand_;
  FlatStand flat_stand_;
  Crawl crawl_;
  GaitChoice choice_;
  int present_, wanted_;               // gaits, as in GaitChoice
  std::vector<RhythmicGait> rhythms_;  // by gait, the own one first
  /// By gait, the user's own ones; the others are null. Shared with copies: only one copy may plan.
  std::vector<std::shared_ptr<Gait>> own_;
  std::vector<std::string> names_;
  bool walks_ = false;         // the stand is not active
  bool has_new_gait_ = false;  // at this tick: walks by a clock, or did
  ReferenceBlend blend_;
  Motion<double> pitch_{0.0, 0.0, 0.0};  // of the gait, with what is left of the one before [rad]
  CommandLimits limits_;
  TorsoReference torso_;
  FrictionFrame friction_frame_;
  CalibrationSchedule calibration_;
  RestWatch rest_;
  MotionPlan plan_;
  PerLeg<Vec2> hips_;                  // relative to the torso's centre, in heading axes [m]
  double yaw_ = 0.0, yaw_rate_ = 0.0;  // reference of the torso [rad], [rad/s]
  bool learns_ground_ = false;         // again after the calibration
  bool initialised_ = false;
  bool restarts_ = false;
};

}  // namespace surefoot::gaits
