#pragma once

#include "surefoot/math/types.hpp"
#include "surefoot/simulation/mujoco_handles.hpp"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace surefoot::simulation {

/// What a geom shows, which the compiled robot does without.
struct MjcfLook {
  bool is_mesh = false;
  std::string mesh;           ///< its file, seen from the MJCF's folder; empty: it has none
  Vec3 scale = Vec3::Ones();  ///< of the mesh
  std::array<float, 4> rgba{};
};

/// The robot of an MJCF, alone: one free base and what hangs on it, without the world, actuators,
/// sensors and files of meshes. All its bodies and joints have names.
struct MjcfRobot {
  SpecHandle spec;
  ModelHandle model;  ///< compiled from `spec`
  mjsBody* base = nullptr;
  std::map<std::string, double> effort;  ///< of joints with limited actuators [N·m]
  std::map<const mjsGeom*, MjcfLook> looks;
  std::vector<std::string> notes;  ///< what was left out, a line each
};

/// Line of an element in its file, from the `info` that MuJoCo keeps of it; 1 if unknown.
[[nodiscard]] int line_of(const mjString* info);

/// Reads an MJCF with MuJoCo, with all that it includes. Throws FileError, with file and line, if
/// it can't be read, has no or several free joints, or has what a tree of rigid bodies with one
/// joint each and drives at the joints does not have: equality constraints, tendons that act,
/// springs, gravity compensation, bodies with several joints.
[[nodiscard]] MjcfRobot read_mjcf(const std::string& path);

}  // namespace surefoot::simulation
