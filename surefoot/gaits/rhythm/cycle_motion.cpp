#include "surefoot/gaits/rhythm/cycle_motion.hpp"

#include "surefoot/base/scale.hpp"
#include "surefoot/gaits/parts/leg_limits.hpp"
#include "surefoot/math/numbers.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <utility>

namespace surefoot::gaits {
namespace {

constexpr int kSamples = 100;
constexpr double kWeight = 300.0;   // of a robot of scale 1 [N]
constexpr double kGyration = 0.25;  // its radius of gyration about the pitch axis [m]

/// What bears the robot at an instant of the cycle.
struct Support {
  double load = 0.0;  // that the feet may bear, in the robot's weight, at most 1
  Vec2 center{0.0, 0.0};
  bool flies = true;
};

double fraction(double x) { return x - std::floor(x); }

Support support_at(double phase, const PlannerOptions& o, const Scale& scale) {
  const RhythmOptions& rhythm = o.rhythm;
  Support result;
  double load = 0.0;
  for (const Leg leg : rhythm.duty.legs()) {
    const double duty = rhythm.duty[index(leg)];
    const double stood = fraction(phase - rhythm.offset[index(leg)]) - (1.0 - duty);
    if (stood < 0.0) continue;
    result.flies = false;
    const double share =
        ramped_force_max(o.force, stood * rhythm.period, (duty - stood) * rhythm.period);
    load += share;
    result.center += share * nominal_offset(o.stance, leg, o.gait.num_legs());
  }
  if (load > 0.0) result.center *= rhythm.sway / load;
  result.load = std::min(1.0, load / (scale.force() * kWeight));
  return result;
}

/// The function around a circle of step `dt` whose second derivative is `a`, both without a mean.
Eigen::VectorXd integrated(Eigen::VectorXd a, double dt) {
  for (int twice = 0; twice < 2; ++twice) {
    a.array() -= a.mean();
    double sum = 0.0;
    for (double& value : a) value = std::exchange(sum, sum + dt * value);
  }
  a.array() -= a.mean();
  return a;
}

/// Rows of c̈ − k (c − z) = 0 around the circle.
Eigen::MatrixXd pendulum(const Eigen::VectorXd& k, double dt) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(kSamples, kSamples);
  for (int i = 0; i < kSamples; ++i) {
    A(i, i) = -2.0 / (dt * dt) - k[i];
    A(i, (i + 1) % kSamples) = A(i, (i + kSamples - 1) % kSamples) = 1.0 / (dt * dt);
  }
  return A;
}

template <typename T>
Motion<T> between(const std::vector<Motion<T>>& samples, double phase) {
  const double place = fraction(phase - 0.5 / kSamples) * kSamples;
  const auto i = std::min<std::size_t>(static_cast<std::size_t>(place), kSamples - 1);
  const Motion<T>&from = samples[i], &to = samples[(i + 1) % kSamples];
  const double share = place - static_cast<double>(i);
  return {from.p + share * (to.p - from.p), from.v + share * (to.v - from.v),
          from.a + share * (to.a - from.a)};
}

}  // namespace

CycleMotion::CycleMotion(const PlannerOptions& options, const Scale& scale)
    : samples_(kSamples, {Vec3::Zero(), Vec3::Zero(), Vec3::Zero()}),
      pitch_(kSamples, {0.0, 0.0, 0.0}) {
  if (!options.rhythm.enabled) return;
  const double dt = options.rhythm.period / kSamples;
  Eigen::VectorXd load(kSamples);
  Eigen::MatrixX2d center(kSamples, 2);
  bool flies = false;
  for (int i = 0; i < kSamples; ++i) {
    const Support support = support_at((i + 0.5) / kSamples, options, scale);
    load[i] = support.load;
    center.row(i) = support.center;
    flies = flies || support.flies;
  }
  if (!flies) load.setOnes();
  const Eigen::VectorXd up = kGravity * (load.array() / load.mean() - 1.0);
  const Eigen::VectorXd k = (up.array() + kGravity) / options.stance.height;
  const double gyration = scale.length * kGyration;
  const Eigen::VectorXd turn = -options.rhythm.pitch / (gyration * gyration) *
                               (up.array() + kGravity) * center.col(0).array();
  center.col(0) *= 1.0 - options.rhythm.pitch;
  const Eigen::MatrixXd pulled = -(k.asDiagonal() * center);
  Eigen::MatrixX3d p(kSamples, 3);
  p.leftCols(2) = pendulum(k, dt).partialPivLu().solve(pulled);
  p.col(2) = integrated(up, dt);
  const Eigen::VectorXd angle = integrated(turn, dt);
  for (int i = 0; i < kSamples; ++i) {
    const int before = (i + kSamples - 1) % kSamples, after = (i + 1) % kSamples;
    Motion<Vec3>& sample = samples_[static_cast<std::size_t>(i)];
    sample.p = p.row(i);
    sample.v = (p.row(after) - p.row(before)) / (2.0 * dt);
    sample.a << k[i] * (p.row(i).head<2>() - center.row(i)).transpose(), up[i];
    pitch_[static_cast<std::size_t>(i)] = {angle[i], (angle[after] - angle[before]) / (2.0 * dt),
                                           turn[i]};
  }
}

Motion<Vec3> CycleMotion::at(double phase) const { return between(samples_, phase); }

Motion<double> CycleMotion::pitch_at(double phase) const { return between(pitch_, phase); }

}  // namespace surefoot::gaits
