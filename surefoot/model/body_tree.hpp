#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/model/leg_chain.hpp"
#include "surefoot/model/urdf.hpp"

namespace surefoot {

/// One leg as rigid bodies: everything that is welded together is one body.
struct LegTree {
  LegChain chain;
  std::array<Inertia, kJointsPerLeg> inertias;  ///< of the bodies behind HAA, HFE, KFE
  Mat3 R_shank = Mat3::Identity();              ///< shank link's axes in the KFE child's frame
};

/// A legged robot as rigid bodies in our order of legs and joints; frames are those of the URDF.
struct BodyTree {
  Inertia base;  ///< in B
  PerLeg<LegTree> legs;
};

/// Finds the description's parts in a URDF. Throws UnknownNameError if a name is not in it (the
/// message lists what is), Error if the parts are not connected as base – HAA – HFE – KFE – shank –
/// foot, FileError, with the URDF's line, if a joint that the description does not name can move, a
/// leg's joint mimics another, or the base or what a joint moves has not the inertia of a body.
[[nodiscard]] BodyTree make_body_tree(const RobotDescription& description, const Urdf& urdf);

}  // namespace surefoot
