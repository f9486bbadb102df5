#pragma once

#include "surefoot/gaits/planner.hpp"

#include <functional>
#include <limits>
#include <vector>

namespace surefoot::test {

inline constexpr double kNoGround = -std::numeric_limits<double>::infinity();

/// Height that a foot's centre rests at over a place; kNoGround where there is none.
using Ground = std::function<double(const Vec2&)>;

[[nodiscard]] Ground level_ground(double height = 0.0);
/// Level at 0, and from x = `edge` on at `height`.
[[nodiscard]] Ground step_at(double edge, double height);

/// What a planner said at a tick, and where.
struct Happening {
  double time = 0.0;
  PlanEvent event = PlanEvent::none;
  Leg leg = Leg::LF;      ///< that it happened to; LF where it is none
  Vec3 p = Vec3::Zero();  ///< its foot
};

/// A robot without mass that does what its planner says: the torso and the centre of mass are where
/// the plan wants them, feet in the air follow their references until the ground stops them, feet
/// on the ground stay and carry what they may. The planner sees nothing else.
class Puppet {
 public:
  static constexpr double kPeriod = 0.0025;
  static constexpr double kWeight = 300.0;

  explicit Puppet(const gaits::PlannerOptions& options = {}, Ground ground = level_ground(),
                  const Vec2& position = Vec2::Zero(), double heading = 0.0,
                  const std::vector<gaits::NamedGait>& gaits = {},
                  int first = UserCommand::kOwnGait);

  /// Puts a foot elsewhere, as if it had stood there.
  void place(Leg leg, const Vec2& place);
  /// Moves a foot, which is seen to have this velocity from then on [m/s].
  void fling(Leg leg, const Vec3& by, const Vec3& velocity);
  /// One period on.
  void tick();
  /// Calls `each()` after every tick.
  void run(double duration, const std::function<void()>& each = [] {});

  [[nodiscard]] double time() const { return state_.time; }
  [[nodiscard]] const MotionPlan& plan() const { return plan_; }
  [[nodiscard]] const Vec3& foot(Leg leg) const { return dynamics_.foot[index(leg)].p; }
  [[nodiscard]] const Vec3& force(Leg leg) const { return state_.foot_force[index(leg)]; }
  [[nodiscard]] Vec2 com() const { return dynamics_.com.p.head<2>(); }
  [[nodiscard]] const gaits::Planner& planner() const { return planner_; }
  [[nodiscard]] const std::vector<Happening>& happenings() const { return happenings_; }
  [[nodiscard]] std::vector<Happening> happenings(PlanEvent event) const;
  /// The first of its kind after a time; of no event if there is none.
  [[nodiscard]] Happening first_after(double time, PlanEvent event) const;

  UserCommand user;
  Ground ground;
  PerLeg<bool> sticky{};     ///< this foot carries on, whatever it may
  Vec3 push = Vec3::Zero();  ///< what is believed to push the robot [N]
  PerLeg<Vec2> slide;     ///< forces along the ground at which these feet slide [N]; 0: they stand
  HierarchyOutcome last;  ///< what the hierarchy tells
  bool calibration_known = false;  ///< what one that ends tells
  double leg_length = 0.3;         ///< of every leg at any time: none is ever too short [m]
  bool com_follows = true;         ///< otherwise the centre of mass stays where it is
  Vec2 blow{0.0, 0.0};             ///< what the centre of mass is faster than planned [m/s]
  double drift = 0.0;              ///< velocity at which the base is believed to go besides [m/s]

 private:
  void move_body();
  void move_foot(std::size_t k);
  void note_events();

  gaits::Planner planner_;
  model::Dynamics dynamics_;
  RobotState state_;
  MotionPlan plan_;
  std::vector<Happening> happenings_;
};

}  // namespace surefoot::test
