#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/simulation/mujoco_handles.hpp"

namespace surefoot::simulation {

/// The part that a geom of the compiled model belongs to.
enum class Part : signed char {
  terrain,
  torso,  ///< the base, what is fixed to it, and the hips up to the HFE axes
  leg,    ///< thigh, knee and shank, without the foot sphere
  foot,
};

struct GeomOwner {
  Part part = Part::terrain;
  int leg = -1;  ///< for `leg` and `foot`
};

/// Indices of our joints, legs and feet in MuJoCo's arrays, found by name, as MuJoCo keeps the
/// URDF's order.
struct RobotParts {
  int base_body = -1;
  int base_qpos = 0, base_dof = 0;  ///< of the free joint
  std::vector<int> qpos;            ///< index in qpos of joint j in our order
  std::vector<int> dof;             ///< index in qvel
  std::vector<int> actuator;        ///< index in ctrl
  int num_leg_joints = 0;           ///< the first ones
  PerLeg<int> foot_geom{};
  PerLeg<int> foot_body{};
  std::vector<int> tip_body;     ///< of each arm
  std::vector<GeomOwner> owner;  ///< of each geom

  /// Else it has flat feet, and only stands.
  [[nodiscard]] bool is_walker() const { return static_cast<int>(foot_geom.size()) >= kNumLegs; }
};

/// Name of the geom of a foot sphere, or of a sole.
[[nodiscard]] std::string foot_geom_name(Leg leg, int num_legs);

[[nodiscard]] RobotParts find_parts(const mjModel& model,
                                    const model::RobotDescription& description);

}  // namespace surefoot::simulation
