#pragma once

#include "surefoot/model/description.hpp"
#include "surefoot/model/dynamics.hpp"
#include "surefoot/signals/robot_state.hpp"

#include <memory>
#include <string>

namespace surefoot::test {

/// The same robot, read from the same URDF by MuJoCo: an independent implementation to compare
/// with. Its quantities are in our order of legs and with our u.
class MujocoReference {
 public:
  explicit MujocoReference(const model::RobotDescription& description);
  ~MujocoReference();

  void set_state(const RobotState& state);

  [[nodiscard]] model::MassMatrix mass_matrix() const;
  [[nodiscard]] GeneralizedVector bias() const;
  [[nodiscard]] double mass() const;
  [[nodiscard]] model::PointKinematics com() const;
  /// A point that is fixed to a link, given in the link's frame.
  [[nodiscard]] model::PointKinematics point(const std::string& link, const Vec3& p_link) const;
  /// A point of a link, given in W.
  [[nodiscard]] model::PointKinematics material_point(const std::string& link,
                                                      const Vec3& p_W) const;
  [[nodiscard]] model::RotationKinematics rotation(const std::string& link) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace surefoot::test
