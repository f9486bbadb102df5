#include "surefoot/model/belief_frame.hpp"

#include "surefoot/math/rotation.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::model {
namespace {

bool are_known(const PerLeg<Vec3>& points) {
  return std::ranges::all_of(points, [](const Vec3& p) { return p.allFinite(); });
}

}  // namespace

void BeliefFrame::update(const MotionPlan& plan, const PerLeg<Vec3>& p_WF,
                         const PerLeg<Vec3>& p_SF) {
  Vec3 believed = Vec3::Zero(), actual = Vec3::Zero();
  const int count = plan.num_contacts();
  if (count < 2 || !are_known(p_WF)) return;
  for (const Leg leg : plan.feet.legs()) {
    if (!plan.contact(leg)) continue;
    believed += p_WF[index(leg)] / count;
    actual += p_SF[index(leg)] / count;
  }
  double sine = 0.0, cosine = 0.0;
  for (const Leg leg : plan.feet.legs()) {
    if (!plan.contact(leg)) continue;
    const Vec3 a = p_WF[index(leg)] - believed;
    const Vec3 b = p_SF[index(leg)] - actual;
    sine += a.x() * b.y() - a.y() * b.x();
    cosine += a.x() * b.x() + a.y() * b.y();
  }
  R_SW_ = rotation_about_z(std::atan2(sine, cosine));
  p_SW_ = actual - R_SW_ * believed;
}

}  // namespace surefoot::model
