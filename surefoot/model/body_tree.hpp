#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/model/frames.hpp"
#include "surefoot/model/leg_chain.hpp"
#include "surefoot/model/urdf.hpp"

namespace surefoot::model {

/// One leg as rigid bodies: everything that is welded together is one body.
struct LegTree {
  LegChain chain;
  std::array<Inertia, kJointsPerLeg> inertias;  ///< of the bodies behind HAA, HFE, KFE
  Mat3 R_shank = Mat3::Identity();              ///< shank link's axes in the KFE child's frame
};

/// A body behind a joint of an arm, or of a leg without `LegChain`.
struct LimbBody {
  int parent = 0;  ///< as `BodyFrame::body`
  Hinge hinge;     ///< in the parent's frame
  Inertia inertia;
};

/// A legged robot as rigid bodies in our order of legs, arms and joints; frames are those of the
/// URDF.
struct BodyTree {
  Inertia base;                            ///< in B
  PerLeg<LegTree> legs;                    ///< of a walker, else empty
  std::vector<LimbBody> limb_bodies;       ///< behind all other joints, in their order
  std::vector<BodyFrame> arm_tips;         ///< by arm
  PerLeg<BodyFrame> hips, soles;           ///< of a robot that only stands, else empty
  std::map<std::string, BodyFrame> links;  ///< all of them
};

/// Finds the description's parts in a URDF. Throws UnknownNameError (listing the valid names) for
/// an unknown name; Error unless a walker's parts connect as base – HAA – HFE – KFE – shank – foot,
/// and the joints of another's leg as one chain;
/// FileError with the URDF's line if a joint missing in the description can move, a described joint
/// mimics another, or a moving body has an impossible inertia.
[[nodiscard]] BodyTree make_body_tree(const RobotDescription& description, const Urdf& urdf);

}  // namespace surefoot::model
