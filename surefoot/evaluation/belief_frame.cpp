#include "surefoot/evaluation/belief_frame.hpp"

#include "surefoot/math/rotation.hpp"

#include <cmath>

namespace surefoot {

void BeliefFrame::update(const GroundTruth& truth, const TickRecord& tick) {
  Vec3 believed = Vec3::Zero(), actual = Vec3::Zero();
  const int count = tick.plan.num_contacts();
  if (count < 2) return;
  for (const Leg leg : kLegs) {
    if (!tick.plan.contact(leg)) continue;
    believed += tick.model.p_WF[index(leg)] / count;
    actual += truth.p_WF[index(leg)] / count;
  }
  double sine = 0.0, cosine = 0.0;
  for (const Leg leg : kLegs) {
    if (!tick.plan.contact(leg)) continue;
    const Vec3 a = tick.model.p_WF[index(leg)] - believed;
    const Vec3 b = truth.p_WF[index(leg)] - actual;
    sine += a.x() * b.y() - a.y() * b.x();
    cosine += a.x() * b.x() + a.y() * b.y();
  }
  R_ = rotation_about_z(std::atan2(sine, cosine));
  p_ = actual - R_ * believed;
}

}  // namespace surefoot
