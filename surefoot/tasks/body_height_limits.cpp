#include "surefoot/tasks/body_height_limits.hpp"

#include "surefoot/base/error.hpp"

namespace surefoot::tasks {
namespace {

/// h_z of Eq. 32; at least one leg is in contact.
double footprint_height(const TaskInput& input) {
  double sum = 0.0;
  for (const Leg leg : input.plan.feet.legs()) {
    if (input.plan.contact(leg)) sum += input.dynamics.foot[index(leg)].p.z();
  }
  return sum / input.plan.num_contacts();
}

}  // namespace

BodyHeightLimits::BodyHeightLimits(const Options& options)
    : options_(options), bound_(options.dt, options.response) {
  if (!(options.min < options.max)) throw Error("body_height_limits: min must be below max");
}

void BodyHeightLimits::write(const TaskInput& input, solver::Level& level) const noexcept {
  if (input.plan.num_contacts() == 0) return;
  const model::PointKinematics& base = input.dynamics.base;
  const double height = base.p.z() - footprint_height(input);
  solver::Rows row = level.add(1, first_id());
  row.A.leftCols(input.dynamics.num_velocities()) = base.J.row(2);
  bound_.write(row, 0, options_.min, options_.max, height, base.v.z(), base.Jdot_u.z());
}

std::string BodyHeightLimits::row_name(int) const { return "height above the footprint"; }

}  // namespace surefoot::tasks
