#include "tests/support/nees.hpp"

#include "surefoot/math/rotation.hpp"

#include <Eigen/Cholesky>

#include <array>

namespace surefoot::test {

double nees(const estimation::InvariantFilter& filter, const Mat3& true_R_WB,
            const Vec3& true_v_WB) {
  // Right-invariant errors of this estimate, with the true state turned into the filter's heading.
  const Mat3 turn = rotation_about_z(yaw(filter.R_WB()) - yaw(true_R_WB));
  const Vec3 theta = log_rotation(Quat(Mat3(filter.R_WB() * (turn * true_R_WB).transpose())));
  const Vec3 xi_v = filter.v_WB() - exp_rotation(theta) * (turn * true_v_WB);
  Eigen::Matrix<double, 5, 1> error;
  error << theta.head<2>(), xi_v;
  constexpr int kTheta = estimation::InvariantFilter::kTheta,
                kVelocity = estimation::InvariantFilter::kVelocity;
  constexpr std::array<int, 5> kRows{kTheta, kTheta + 1, kVelocity, kVelocity + 1, kVelocity + 2};
  const Eigen::Matrix<double, 5, 5> P = filter.covariance()(kRows, kRows);
  return error.dot(P.ldlt().solve(error));
}

}  // namespace surefoot::test
