#include "surefoot/estimation/base_motion.hpp"

#include <Eigen/LU>

namespace surefoot::estimation {

// About the points' mean v and ω decouple.
BaseMotion base_motion(const PerLeg<Vec3>& p_BC, const PerLeg<Vec3>& v_BC) {
  const auto count = static_cast<double>(p_BC.size());
  Vec3 p = Vec3::Zero(), v = Vec3::Zero();
  for (std::size_t k = 0; k < p_BC.size(); ++k) {
    p += p_BC[k] / count;
    v -= v_BC[k] / count;
  }
  Mat3 spread = Mat3::Zero();
  Vec3 turn = Vec3::Zero();
  for (std::size_t k = 0; k < p_BC.size(); ++k) {
    const Vec3 arm = p_BC[k] - p;
    spread += arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose();
    turn -= arm.cross(v_BC[k]);
  }
  const Vec3 w = spread.inverse() * turn;
  const BaseMotion motion{.v = v - w.cross(p), .w = w};
  return motion.v.allFinite() ? motion : BaseMotion{};
}

}  // namespace surefoot::estimation
