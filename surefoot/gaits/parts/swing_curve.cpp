#include "surefoot/gaits/parts/swing_curve.hpp"

#include <algorithm>

namespace surefoot::gaits {
namespace {

constexpr double kStepHeight = 0.05;     // a greater rise or drop is a step of the ground [m]
constexpr double kUpstairsStart = 0.35;  // of horizontal motion: the foot clears the edge first
constexpr double kDownstairsEnd = 0.60;  // of horizontal motion: it passes the edge first
constexpr double kMinLength = 1e-6;      // a shorter step has no direction [m]
constexpr double kMinWindow = 0.2;       // least share of the swing with horizontal motion
constexpr double kUpstairsApexShare = 0.40;
constexpr double kApexShare = 0.45;
constexpr double kMinAimTime = 0.2;  // share of the swing that is left when the goal moves last
constexpr double kSearchAcceleration = 10.0;  // of a late foot [m/s²]
constexpr int kPeakSamples = 40;

}  // namespace

SwingCurve::SwingCurve(const SwingTarget& target, const SwingOptions& options, const Scale& scale)
    : target_(target),
      touchdown_speed_(options.touchdown_speed),
      search_speed_(std::max(options.search_speed, options.touchdown_speed)) {
  const Vec3 difference = target.goal - target.start;
  rise_ = target.normal.dot(difference);
  along_ = difference - rise_ * target.normal;
  top_ = std::max(0.0, rise_) + target.apex;
  if (along_.norm() > kMinLength) back_ = -target.back * along_.normalized();
  horizontal_start_ = options.horizontal_start;
  horizontal_end_ = options.horizontal_end;
  apex_share_ = kApexShare;
  const double step_height = scale.length * kStepHeight;
  if (rise_ > step_height || target.back > 0.0) {
    const double start = std::min(kUpstairsStart, horizontal_end_ - kMinWindow);
    horizontal_start_ = std::max(horizontal_start_, start);
    apex_share_ = kUpstairsApexShare;
  }
  if (rise_ < -step_height && target.back == 0.0) {
    const double end = std::max(kDownstairsEnd, horizontal_start_ + kMinWindow);
    horizontal_end_ = std::min(horizontal_end_, end);
  }
}

Motion<Vec3> SwingCurve::at(double t) const {
  if (target_.straight) return straight_motion(t);
  const Motion<double> up = normal_motion(t);
  if (aimed_at_ >= 0.0) {
    const Motion<Vec3> flat = aimed_motion(t);
    return {target_.start + flat.p + up.p * target_.normal, flat.v + up.v * target_.normal,
            flat.a + up.a * target_.normal};
  }
  const Motion<double> share = horizontal_share(t);
  const Motion<double> back = retreat(t);
  return {target_.start + share.p * along_ + back.p * back_ + up.p * target_.normal,
          share.v * along_ + back.v * back_ + up.v * target_.normal,
          share.a * along_ + back.a * back_ + up.a * target_.normal};
}

Motion<Vec3> SwingCurve::straight_motion(double t) const {
  const double T = target_.duration;
  const Vec3 down = -touchdown_speed_ * target_.normal;
  if (t > T) return {target_.goal + (t - T) * down, down, Vec3::Zero()};
  return hermite<Vec3>({target_.start, target_.velocity, Vec3::Zero()},
                       {target_.goal, down, Vec3::Zero()}, t, T);
}

void SwingCurve::aim(double t, const Vec3& goal) {
  const double T = target_.duration, begin = horizontal_start_ * T, end = horizontal_end_ * T;
  if (t < apex_share_ * T) rise_ = target_.normal.dot(goal - target_.start);
  if (t < end - kMinAimTime * T) {
    if (t > begin) {
      const Motion<Vec3> now = at(t);
      const auto flat = [&](const Vec3& x) -> Vec3 {
        return x - target_.normal.dot(x) * target_.normal;
      };
      aimed_from_ = {flat(now.p - target_.start), flat(now.v), flat(now.a)};
      aimed_at_ = t;
    }
    along_ = goal - target_.start;
    along_ -= target_.normal.dot(along_) * target_.normal;
  }
  target_.goal = target_.start + along_ + rise_ * target_.normal;
}

Motion<Vec3> SwingCurve::aimed_motion(double t) const {
  const double end = horizontal_end_ * target_.duration;
  return hermite<Vec3>(aimed_from_, {along_, Vec3::Zero(), Vec3::Zero()}, t - aimed_at_,
                       end - aimed_at_);
}

double SwingCurve::peak_acceleration() const {
  double peak = 0.0;
  for (int i = 0; i <= kPeakSamples; ++i)
    peak = std::max(peak, at(target_.duration * i / kPeakSamples).a.norm());
  return peak;
}

Motion<double> SwingCurve::normal_motion(double t) const {
  const double T = target_.duration;
  const double apex_time = apex_share_ * T;
  if (t > T) {
    const Motion<double> down = search_motion(t - T);
    return {rise_ - down.p, -down.v, -down.a};
  }
  if (t < apex_time) return hermite<double>({0.0, 0.0, 0.0}, {top_, 0.0, 0.0}, t, apex_time);
  return hermite<double>({top_, 0.0, 0.0}, {rise_, -touchdown_speed_, 0.0}, t - apex_time,
                         T - apex_time);
}

// A late foot comes down ever faster, up to the speed of the search.
Motion<double> SwingCurve::search_motion(double t) const {
  const double end = (search_speed_ - touchdown_speed_) / kSearchAcceleration;
  if (t < end) {
    return {touchdown_speed_ * t + 0.5 * kSearchAcceleration * t * t,
            touchdown_speed_ + kSearchAcceleration * t, kSearchAcceleration};
  }
  return {search_speed_ * t - 0.5 * kSearchAcceleration * end * end, search_speed_, 0.0};
}

Motion<double> SwingCurve::horizontal_share(double t) const {
  const double T = target_.duration;
  const double begin = horizontal_start_ * T, length = (horizontal_end_ - horizontal_start_) * T;
  return hermite<double>({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, t - begin, length);
}

// Backward until the horizontal motion starts, then forward again with it.
Motion<double> SwingCurve::retreat(double t) const {
  const double T = target_.duration;
  const double turn = horizontal_start_ * T, end = horizontal_end_ * T;
  if (t < turn) return hermite<double>({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, t, turn);
  return hermite<double>({1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, t - turn, end - turn);
}

}  // namespace surefoot::gaits
