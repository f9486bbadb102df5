#pragma once

#include "surefoot/simulation/mujoco_handles.hpp"

namespace surefoot::simulation {

/// Puts convex hulls, which is what collides, in the place of the mesh files that a spec names, so
/// that its text needs no other file. `compiled`: of a spec with the same meshes.
void embed_hulls(mjSpec& spec, const mjModel& compiled);

}  // namespace surefoot::simulation
