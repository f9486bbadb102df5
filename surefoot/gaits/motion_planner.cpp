#include "surefoot/gaits/motion_planner.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/gaits/planner.hpp"

namespace surefoot::gaits {
namespace {

class GaitPlanner final : public MotionPlanner {
 public:
  GaitPlanner(const PlannerOptions& options, double period, const Scale& scale,
              const std::vector<NamedGait>& gaits, int first)
      : planner_(options, period, scale, gaits, first), fresh_(planner_) {}

  const MotionPlan& update(const UserCommand& user, const RobotState& state,
                           const model::Dynamics& dynamics, const HierarchyOutcome& last) override {
    return planner_.update(user, state, dynamics, last);
  }
  void restart() override { planner_.begin_anew(fresh_); }
  int steps_taken() const noexcept override { return planner_.steps_taken(); }
  void set_friction(double friction) override {
    planner_.set_friction(friction);
    fresh_.set_friction(friction);
  }
  Vec3 terrain_normal(const MotionPlan&) const noexcept override {
    return planner_.terrain_normal();
  }
  bool restarts() const noexcept override { return planner_.restarts(); }
  bool is_undisturbed(const RobotState& state) const noexcept override {
    return planner_.is_undisturbed(state);
  }
  void tell_calibration_known(bool known) noexcept override {
    planner_.tell_calibration_known(known);
  }

 private:
  Planner planner_;
  Planner fresh_;  // without a tick, for a restart
};

}  // namespace

void MotionPlanner::set_friction(double) {
  throw Error("this planner has no friction to set; override MotionPlanner::set_friction");
}

std::unique_ptr<MotionPlanner> make_planner(const PlannerOptions& options, double period,
                                            const Scale& scale, const std::vector<NamedGait>& gaits,
                                            int first) {
  return std::make_unique<GaitPlanner>(options, period, scale, gaits, first);
}

}  // namespace surefoot::gaits
