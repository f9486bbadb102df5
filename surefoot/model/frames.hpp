#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/model/dynamics.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace surefoot::model {

/// A frame that is fixed to a body.
struct BodyFrame {
  int body = 0;  ///< 0: the base; 1 + j: the body behind joint j of a JointVector
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();  ///< [m]
};

/// A frame that a task follows.
struct FollowedFrame {
  int number = -1;        ///< in `Frames`; −1: none
  bool in_world = false;  ///< held in W, else in B, until the user asks for something else
  BodyFrame at{};
};

/// All frames of a robot, by name: its links (of an MJCF the bodies and sites), its joints, each as
/// the frame that it turns, and its arms, each as its tip.
class Frames {
 public:
  /// Reads the description's URDF. Throws Error where `RobotModel` does.
  explicit Frames(const RobotDescription& robot);

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// Its place among the names. Throws UnknownNameError with the nearest names.
  [[nodiscard]] int number(std::string_view name) const;
  [[nodiscard]] const BodyFrame& operator[](int number) const {
    return frames_[static_cast<std::size_t>(number)];
  }
  /// The arm that moves a frame; −1: none does.
  [[nodiscard]] int arm_of(int number) const;

 private:
  void add(const std::string& name, const BodyFrame& frame);

  std::string robot_;
  std::vector<int> arm_of_body_;
  std::vector<std::string> names_;
  std::vector<BodyFrame> frames_;  // by name
};

/// A frame's place, velocity and Jacobians at the state of the dynamics. Does not allocate.
[[nodiscard]] FrameKinematics frame_kinematics(const BodyFrame& frame,
                                               const Dynamics& dynamics) noexcept;

/// The same motion relative to the base, in B: with r the frame's place there,
///
///     r̈ = J u̇ + Jdot_u,   J = R_WBᵀ J_v of the joints, and 0 of the base
[[nodiscard]] FrameKinematics relative_to_base(const FrameKinematics& frame,
                                               const Dynamics& dynamics) noexcept;

}  // namespace surefoot::model
