#pragma once

#include "surefoot/control/stack_options.hpp"
#include "surefoot/logging/log_header.hpp"
#include "surefoot/logging/message_fields.hpp"
#include "surefoot/signals/tick_record.hpp"
#include "surefoot/tasks/friction_cone.hpp"

#include <optional>

namespace surefoot::explain {

/// Contact forces of a tick's solution, relative to their friction pyramids; NaN for feet without
/// contact.
struct CommandedForces {
  explicit CommandedForces(int num_legs = kNumLegs);

  PerLeg<double> normal;            ///< along the pyramid's axis [N]
  PerLeg<double> friction_use;      ///< 1: a face of the pyramid is active
  PerLeg<Quat> q_WP;                ///< axes of the pyramid P in W
  PerLeg<double> pyramid_friction;  ///< its μ'
  double least_load = 0.0;          ///< see LogRobot [N]
};

/// The friction task of a stack; empty if the stack has none, or one that this program does not
/// know.
[[nodiscard]] std::optional<tasks::FrictionCone> friction_cone_of(
    const control::StackOptions& stack);
/// The same for the stack attached to a log. A run can't change the task's choices.
[[nodiscard]] std::optional<tasks::FrictionCone> friction_cone_of(const logging::LogHeader& header);

/// All NaN if the tick's command is no solution. Without a known cone, forces are along the
/// terrain's normal, and friction is NaN. `least_load`: see LogRobot.
[[nodiscard]] CommandedForces commanded_forces(const std::optional<tasks::FrictionCone>& cone,
                                               const TickRecord& tick, double least_load);

/// The limit that a foot's force exceeds in the solution, because the level of that limit gave way.
/// The ground can't give such a force.
enum class Beyond : int { nothing = 0, force, friction };
[[nodiscard]] Beyond beyond_limits(const CommandedForces& forces, const MotionPlan& plan, Leg leg);

}  // namespace surefoot::explain

namespace surefoot::logged {

template <typename Archive, Is<explain::CommandedForces> T>
void fields(Archive& field, T& forces) {
  field("normal_force", forces.normal,
        "of the solution's force on a foot, along its friction pyramid's axis [N]");
  field("friction_use", forces.friction_use,
        "share of its friction pyramid that the solution's force on a foot uses; 1: at a face");
  field("q_WP", forces.q_WP,
        "axes of the friction pyramid P that held a foot's force, z along the pyramid: turns P "
        "coordinates into W");
  field("pyramid_friction", forces.pyramid_friction,
        "μ' of that pyramid: it holds forces with |f_x| and |f_y| up to μ' f_z in P");
}

}  // namespace surefoot::logged
