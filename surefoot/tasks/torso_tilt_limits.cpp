#include "surefoot/tasks/torso_tilt_limits.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/math/rotation.hpp"

#include <cmath>

namespace surefoot::tasks {

TorsoTiltLimits::TorsoTiltLimits(const Options& options)
    : options_(options), bound_(options.dt, options.response) {
  for (const double limit : {options.max_roll, options.max_pitch}) {
    if (!(limit > 0.0 && limit < 0.5 * kPi)) {
      throw Error("torso_tilt_limits: max_roll and max_pitch must lie between 0 and π/2 rad");
    }
  }
}

void TorsoTiltLimits::write(const TaskInput& input, solver::Level& level) const noexcept {
  const model::RotationKinematics& base = input.dynamics.base_rotation;
  const Vec3 up = base.R.col(2);
  const Vec3 centripetal = base.w.cross(base.w.cross(up));
  const Mat3 heading = rotation_about_z(yaw(input.plan.R_WC));
  const Vec2 limits(std::sin(options_.max_pitch), std::sin(options_.max_roll));
  solver::Rows rows = level.add(2, first_id());
  for (Eigen::Index i = 0; i < 2; ++i) {
    const Vec3 direction = heading.col(i);
    const Vec3 axis = up.cross(direction);
    rows.A.row(i).head(input.dynamics.num_velocities()).noalias() = axis.transpose() * base.J;
    bound_.write(rows, i, -limits[i], limits[i], direction.dot(up), axis.dot(base.w),
                 axis.dot(base.Jdot_u) + direction.dot(centripetal));
  }
}

std::string TorsoTiltLimits::row_name(int id) const { return id == 0 ? "pitch" : "roll"; }

}  // namespace surefoot::tasks
