#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/model/frames.hpp"
#include "surefoot/model/leg_chain.hpp"
#include "surefoot/model/urdf.hpp"

namespace surefoot::model {

/// A walker's leg.
struct LegTree {
  std::vector<int> bodies;  ///< of all its joints, from the base to the foot, as `BodyFrame::body`
  LegChain chain;           ///< with the further joints in the nominal posture
};

/// The rigid body behind a joint: everything that is welded together is one.
struct LimbBody {
  int parent = 0;  ///< as `BodyFrame::body`
  Hinge hinge;     ///< in the parent's frame
  Inertia inertia;
};

/// A legged robot as rigid bodies in our order of legs, arms and joints; frames are those of the
/// URDF.
struct BodyTree {
  Inertia base;                            ///< in B
  std::vector<LimbBody> limb_bodies;       ///< behind the joints, in the order of a JointVector
  std::vector<BodyFrame> arm_tips;         ///< by arm
  PerLeg<BodyFrame> hips;                  ///< H
  PerLeg<BodyFrame> feet;                  ///< centres of spheres, with the shank's axes, or soles
  PerLeg<LegTree> legs;                    ///< of a walker, else empty
  std::map<std::string, BodyFrame> links;  ///< all of them
};

/// Finds the description's parts in a URDF. Throws UnknownNameError (listing the valid names) for
/// an unknown name; Error unless a walker's parts connect as base – HAA – HFE – KFE – shank – foot,
/// further joints anywhere between them, and the joints of another's leg as one chain;
/// FileError with the URDF's line if a joint missing in the description can move, a described joint
/// mimics another, or a moving body has an impossible inertia.
[[nodiscard]] BodyTree make_body_tree(const RobotDescription& description, const Urdf& urdf);

/// Of a walker's leg, its further joints at these angles. Does not allocate.
[[nodiscard]] LegChain leg_chain(const BodyTree& tree, Leg leg, const JointVector& q) noexcept;

}  // namespace surefoot::model
