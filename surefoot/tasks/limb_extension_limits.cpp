#include "surefoot/tasks/limb_extension_limits.hpp"

#include "surefoot/base/error.hpp"

#include <algorithm>

namespace surefoot::tasks {
namespace {

using RowVector = Eigen::Matrix<double, 1, Eigen::Dynamic, Eigen::RowMajor, 1, kMaxVelocities>;

/// A distance r with r̈ = J u̇ + drift.
struct Extension {
  double r = 0.0;
  double rdot = 0.0;
  RowVector J;
  double drift = 0.0;
};

Extension vertical_to_still_foot(const model::PointKinematics& hip,
                                 const model::PointKinematics& foot) {
  return {hip.p.z() - foot.p.z(), hip.v.z(), hip.J.row(2), hip.Jdot_u.z()};
}

Extension vertical(const model::PointKinematics& hip, const model::PointKinematics& foot) {
  return {hip.p.z() - foot.p.z(), hip.v.z() - foot.v.z(), hip.J.row(2) - foot.J.row(2),
          hip.Jdot_u.z() - foot.Jdot_u.z()};
}

Extension radial(const model::PointKinematics& hip, const model::PointKinematics& foot) {
  constexpr double kShortest = 1e-3;  // [m]; below it a leg's direction is meaningless
  const Vec3 p = hip.p - foot.p;
  const Vec3 v = hip.v - foot.v;
  const double r = std::max(p.norm(), kShortest);
  const Vec3 e = p / r;
  const double rdot = e.dot(v);
  return {r, rdot, e.transpose() * (hip.J - foot.J),
          e.dot(hip.Jdot_u - foot.Jdot_u) + (v.squaredNorm() - rdot * rdot) / r};
}

Extension extension(LimbExtensionLimits::Form form, const model::PointKinematics& hip,
                    const model::PointKinematics& foot) {
  switch (form) {
    case LimbExtensionLimits::Form::paper:
      return vertical_to_still_foot(hip, foot);
    case LimbExtensionLimits::Form::relative:
      return vertical(hip, foot);
    case LimbExtensionLimits::Form::radial:
      break;
  }
  return radial(hip, foot);
}

}  // namespace

LimbExtensionLimits::LimbExtensionLimits(const Options& options)
    : options_(options), bound_(options.dt, options.response) {
  if (!(options.min >= 0.0 && options.min < options.max)) {
    throw Error("limb_extension_limits: min must be at least 0 and below max");
  }
}

void LimbExtensionLimits::write(const TaskInput& input, solver::Level& level) const noexcept {
  solver::Rows rows = level.add(num_legs(), first_id());
  for (const Leg leg : input.dynamics.foot.legs()) {
    const Extension limb =
        extension(options_.form, input.dynamics.hip[index(leg)], input.dynamics.foot[index(leg)]);
    const auto row = static_cast<Eigen::Index>(leg);
    rows.A.row(row).head(input.dynamics.num_velocities()) = limb.J;
    bound_.write(rows, row, options_.min, options_.max, limb.r, limb.rdot, limb.drift);
  }
}

std::string LimbExtensionLimits::row_name(int id) const { return leg_name(id) + " extension"; }

}  // namespace surefoot::tasks
