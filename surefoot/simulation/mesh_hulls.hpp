#pragma once

#include "surefoot/simulation/mujoco_handles.hpp"

namespace surefoot::simulation {

/// Replaces the spec's mesh files by their convex hulls, which are what collides, so that its text
/// needs no other file. `compiled`: from a spec with the same meshes.
void embed_hulls(mjSpec& spec, const mjModel& compiled);

}  // namespace surefoot::simulation
