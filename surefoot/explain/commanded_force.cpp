#include "surefoot/explain/commanded_force.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/config/stack_file.hpp"
#include "surefoot/logging/hierarchy_status.hpp"
#include "surefoot/tasks/catalog.hpp"

namespace surefoot::explain {
namespace {

constexpr double kUseTolerance = 0.01;  // of a friction use that may be rounding

}  // namespace

CommandedForces::CommandedForces(int num_legs)
    : normal(num_legs, kNaN),
      friction_use(num_legs, kNaN),
      q_WP(num_legs, Quat(kNaN, kNaN, kNaN, kNaN)),
      pyramid_friction(num_legs, kNaN) {}

std::optional<tasks::FrictionCone> friction_cone_of(const control::StackOptions& stack) {
  for (const control::LevelSpec& level : stack.levels) {
    for (const control::TaskSpec& spec : level.tasks) {
      const auto task = tasks::make_task(spec.task, {spec.numbers, spec.choices}, stack.own_tasks);
      if (const auto* cone = dynamic_cast<const tasks::FrictionCone*>(task.get())) return *cone;
    }
  }
  return std::nullopt;
}

std::optional<tasks::FrictionCone> friction_cone_of(const logging::LogHeader& header) {
  const std::string* stack = header.attachment("resolved_stack.yaml");
  if (stack == nullptr) return std::nullopt;
  try {
    return friction_cone_of(config::parse_stack(*stack, "resolved_stack.yaml"));
  } catch (const Error&) {  // recorded by another version
    return std::nullopt;
  }
}

CommandedForces commanded_forces(const std::optional<tasks::FrictionCone>& cone,
                                 const TickRecord& tick, double least_load) {
  CommandedForces result(static_cast<int>(tick.plan.feet.size()));
  result.least_load = least_load;
  if (!logging::was_used(tick)) return result;
  for (const Leg leg : tick.plan.feet.legs()) {
    if (!tick.plan.contact(leg)) continue;
    const std::size_t k = index(leg);
    const Vec3& force = tick.model.force[k];
    if (!cone) {
      result.normal[k] = tick.plan.R_WC.col(2).dot(force);
      continue;
    }
    const tasks::FrictionPyramid pyramid = cone->pyramid(tick.plan, leg);
    result.q_WP[k] = Quat(pyramid.axes);
    result.pyramid_friction[k] = pyramid.mu;
    result.normal[k] = pyramid.normal().dot(force);
    if (result.normal[k] > least_load && pyramid.mu > 0.0)
      result.friction_use[k] = pyramid.use(force);
  }
  return result;
}

Beyond beyond_limits(const CommandedForces& forces, const MotionPlan& plan, Leg leg) {
  const std::size_t k = index(leg);
  const double normal = forces.normal[k];
  if (normal < -forces.least_load || normal > plan.feet[k].force_max + forces.least_load)
    return Beyond::force;
  return forces.friction_use[k] > 1.0 + kUseTolerance ? Beyond::friction : Beyond::nothing;
}

}  // namespace surefoot::explain
