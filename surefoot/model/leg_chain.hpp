#pragma once

#include "surefoot/signals/leg.hpp"

namespace surefoot::model {

/// A hinge: the child's frame in the parent's at angle 0, and the axis it turns about.
struct Hinge {
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();      ///< [m]
  Vec3 axis = Vec3::UnitX();  ///< in the child's frame
};

/// Kinematics of one leg in the base frame B: the three hinges that place its foot, and the points
/// on them. Further joints stand still in it.
struct LegChain {
  std::array<Hinge, kJointsPerLeg> hinges;  ///< HAA, HFE, KFE
  Vec3 foot = Vec3::Zero();                 ///< centre of the foot sphere, in the KFE child's frame
  Vec3 hip = Vec3::Zero();                  ///< hip H, in the child frame of hinge `hip_hinge`
  int hip_hinge = 1;

  /// Position of the foot in B [m] and, optionally, its Jacobian J with v = J q̇.
  [[nodiscard]] Vec3 foot_in_base(const Vec3& q, Mat3* jacobian = nullptr) const noexcept;
  /// Orientation in B of the body that carries the foot.
  [[nodiscard]] Mat3 shank_in_base(const Vec3& q) const noexcept;
  [[nodiscard]] Vec3 hip_in_base(const Vec3& q) const noexcept;
  /// In which a longer thigh moves the KFE, in the HFE child's frame, and a longer shank the foot,
  /// in the KFE child's.
  [[nodiscard]] Vec3 along_thigh() const noexcept;
  [[nodiscard]] Vec3 along_shank() const noexcept;
  /// Directions in B in which a longer thigh and a longer shank move the foot.
  [[nodiscard]] Eigen::Matrix<double, 3, 2> lengthening_in_base(const Vec3& q) const noexcept;
  /// From the HFE axis to the KFE axis, and from there to the foot, across the axes [m].
  [[nodiscard]] double thigh() const noexcept;
  [[nodiscard]] double shank() const noexcept;
  /// Angle between the lines of the HFE and the KFE axis [rad].
  [[nodiscard]] double knee_skew() const noexcept;
  /// The same leg with longer thigh and shank [m]: KFE moves away from the HFE axis, the foot from
  /// the KFE axis.
  [[nodiscard]] LegChain lengthened(double thigh, double shank) const noexcept;

  /// Damped Newton (Levenberg–Marquardt) from `guess`, which chooses the knee's side. Returns false
  /// and the closest angles found if p_BF can't be reached within 0.1 µm.
  [[nodiscard]] bool inverse_kinematics(const Vec3& p_BF, const Vec3& guess,
                                        Vec3& q) const noexcept;
};

}  // namespace surefoot::model
