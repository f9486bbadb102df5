#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/simulation/mujoco_handles.hpp"

namespace surefoot::simulation {

/// What a geom of the compiled model belongs to.
enum class Part : signed char {
  terrain,
  torso,  ///< the base, what is fixed to it, and the hips up to the HFE axes
  leg,    ///< thigh, knee and shank, without the foot sphere
  foot,
};

struct GeomOwner {
  Part part = Part::terrain;
  int leg = -1;  ///< index of the leg, of `leg` and `foot`
};

/// Where our joints, legs and feet are in MuJoCo's arrays; found by name, as its order is the
/// URDF's.
struct RobotParts {
  int base_body = -1;
  int base_qpos = 0, base_dof = 0;         ///< of the free joint
  std::array<int, kNumJoints> qpos{};      ///< index in qpos of joint j in our order
  std::array<int, kNumJoints> dof{};       ///< index in qvel
  std::array<int, kNumJoints> actuator{};  ///< index in ctrl
  PerLeg<int> foot_geom{};
  PerLeg<int> foot_body{};
  std::vector<GeomOwner> owner;  ///< of each geom
};

/// Name of the geom that is the sphere of a foot.
[[nodiscard]] std::string foot_geom_name(Leg leg);

[[nodiscard]] RobotParts find_parts(const mjModel& model, const RobotDescription& description);

}  // namespace surefoot::simulation
