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
constexpr double kMinAimTime = 0.2;    // share of the swing that is left when the goal moves last
constexpr double kLateAimTime = 0.15;  // until a late foot is over its goal [s]
constexpr double kSearchAcceleration = 10.0;  // of a late foot [m/s²]
constexpr int kPeakSamples = 40;

}  // namespace

SwingCurve::SwingCurve(const SwingTarget& target, const SwingOptions& options, const Scale& scale)
    : target_(target),
      late_aim_time_(scale.time() * kLateAimTime),
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
  const Motion<Vec3> motion = unaimed(t);
  if (aimed_at_ < 0.0) return motion;
  const Motion<Vec3> along = aimed_motion(t);
  const auto with = [&](const Vec3& x, const Vec3& part) -> Vec3 { return x - flat(x) + part; };
  return {target_.start + with(motion.p - target_.start, along.p), with(motion.v, along.v),
          with(motion.a, along.a)};
}

Motion<Vec3> SwingCurve::unaimed(double t) const {
  if (target_.straight) return straight_motion(t);
  const Motion<double> up = normal_motion(t);
  const Motion<double> share = horizontal_share(t);
  const Motion<double> back = retreat(t);
  return {target_.start + share.p * along_ + back.p * back_ + up.p * target_.normal,
          share.v * along_ + back.v * back_ + up.v * target_.normal,
          share.a * along_ + back.a * back_ + up.a * target_.normal};
}

Motion<Vec3> SwingCurve::straight_motion(double t) const {
  const double T = target_.duration;
  const Vec3 down = -search_speed_ * target_.normal;
  if (t > T) return {target_.goal + (t - T) * down, down, Vec3::Zero()};
  return hermite<Vec3>({target_.start, target_.velocity, Vec3::Zero()},
                       {target_.goal, down, Vec3::Zero()}, t, T);
}

void SwingCurve::aim(double t, const Vec3& goal) {
  const double T = target_.duration, begin = horizontal_start_ * T, end = horizontal_end_ * T;
  const bool late = t > T;
  if (!late && (target_.straight || t >= end - kMinAimTime * T)) return;
  if (late || t > begin) {
    const Motion<Vec3> now = at(t);
    aimed_from_ = {flat(now.p - target_.start), flat(now.v), flat(now.a)};
    aimed_at_ = t;
    aimed_until_ = late ? t + late_aim_time_ : end;
  }
  const Vec3 way = goal - target_.start;
  along_ = flat(way);
  if (!late && t < apex_share_ * T) rise_ = target_.normal.dot(way);
  target_.goal = target_.start + along_ + rise_ * target_.normal;
}

Motion<Vec3> SwingCurve::aimed_motion(double t) const {
  return hermite<Vec3>(aimed_from_, {along_, Vec3::Zero(), Vec3::Zero()}, t - aimed_at_,
                       aimed_until_ - aimed_at_);
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
    const Motion<double> more = haste(t - T);
    return {rise_ - touchdown_speed_ * (t - T) - more.p, -touchdown_speed_ - more.v, -more.a};
  }
  if (t < apex_time) return hermite<double>({0.0, 0.0, 0.0}, {top_, 0.0, 0.0}, t, apex_time);
  return hermite<double>({top_, 0.0, 0.0}, {rise_, -touchdown_speed_, 0.0}, t - apex_time,
                         T - apex_time);
}

Motion<double> SwingCurve::haste(double t) const {
  const double most = search_speed_ - touchdown_speed_, end = most / kSearchAcceleration;
  if (t < end) {
    return {0.5 * kSearchAcceleration * t * t, kSearchAcceleration * t, kSearchAcceleration};
  }
  return {most * (t - 0.5 * end), most, 0.0};
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
