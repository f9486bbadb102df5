#include "surefoot/evaluation/path_judge.hpp"

#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::evaluation {

void PathJudge::add(const simulation::GroundTruth& truth, const UserCommand& user,
                    const Vec3& heading) {
  Vec2 centre = Vec2::Zero();
  for (const Vec3& foot : truth.p_SF)
    centre += foot.head<2>() / static_cast<double>(truth.p_SF.size());
  if (!begun_) {
    begun_ = true;
    yaw_ = std::atan2(heading.y(), heading.x());
    direction_ = heading.head<2>().normalized();
    point_ = centre;
  }
  advance(user);
  const Vec2 across(-direction_.y(), direction_.x());
  feet_ = std::max(feet_, std::abs(across.dot(centre - point_)));
  base_ = std::max(base_, std::abs(across.dot(truth.p_SB.head<2>() - point_)));
}

void PathJudge::advance(const UserCommand& user) {
  yaw_ += period_ * user.yaw_rate;
  const Vec2 velocity = rotation_about_z(yaw_).topLeftCorner<2, 2>() * user.velocity;
  point_ += period_ * velocity;
  if (velocity.norm() > 0.0) direction_ = velocity.normalized();
}

void PathJudge::write(Metrics& metrics) const {
  if (!begun_) return;
  metrics.path_deviation_max_m = feet_;
  metrics.path_deviation_base_max_m = base_;
}

}  // namespace surefoot::evaluation
