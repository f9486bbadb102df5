#include "surefoot/estimation/imu_check.hpp"

#include "surefoot/math/rotation.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>

namespace surefoot::estimation {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr int kMinFeet = 2, kMinFeetForTurn = 3;
/// Spans, as parts of the window: short ones show gross errors sooner.
constexpr std::array<double, ImuCheck::kNumSpans> kParts{0.1, 0.25, 0.5, 1.0};
constexpr double kJitter = 0.5;     // of a period
constexpr double kOneSample = 1.5;  // periods: one bad sample shows for one period

int even_ticks(double duration, double period) {
  return 2 * std::max(1, static_cast<int>(std::lround(0.5 * duration / period)));
}

}  // namespace

ImuCheck::ImuCheck(const ImuCheckOptions& options, double period, int num_legs)
    : options_(options),
      period_(period),
      R_IK_(num_legs, Mat3::Identity()),
      arm_(num_legs, Vec3::Zero()),
      rolled_(arm_),
      firm_ticks_(num_legs, 0) {
  for (std::size_t i = 0; i < kParts.size(); ++i)
    ticks_[i] = even_ticks(kParts[i] * options.window, period);
  Moment zero;
  zero.x = per_leg<Vec3>(Vec3::Zero(), num_legs);
  moments_.assign(static_cast<std::size_t>(ticks_.back()) + 1, zero);
}

void ImuCheck::forget() noexcept {
  firm_ticks_.fill(0);
  disagrees_for_ = wrong_for_ = 0.0;
}

// Called a thousand times a tick, so without a division.
inline const ImuCheck::Moment& ImuCheck::before(int ticks) const {
  const int place = newest_ - ticks;
  return moments_[static_cast<std::size_t>(place < 0 ? place + static_cast<int>(moments_.size())
                                                     : place)];
}

void ImuCheck::update(const SensorReading& reading, const RobotState& state,
                      const model::Dynamics& dynamics, const PerLeg<bool>& stands,
                      const Vec3& normal_W) noexcept {
  const bool follows = std::abs(reading.time - time_ - period_) < kJitter * period_;
  const bool is_finite =
      reading.gyro.allFinite() && reading.accelerometer.allFinite() && dynamics.q.allFinite();
  const bool is_new = reading.encoder_time > encoder_time_ && reading.imu_time > imu_time_;
  time_ = reading.time;
  encoder_time_ = reading.encoder_time;
  imu_time_ = reading.imu_time;
  if (!follows || !is_finite || !is_new) forget();
  if (is_finite) {
    move(reading, state, dynamics);
    count_firm_feet(state, stands, normal_W);
    if (is_shaken(reading, state, dynamics, stands)) firm_ticks_.fill(0);
  }
  judge();
}

void ImuCheck::move(const SensorReading& reading, const RobotState& state,
                    const model::Dynamics& dynamics) {
  const Vec3 turn = 0.5 * period_ * (gyro_before_ + reading.gyro);
  const Mat3 R_half = R_IB_ * exp_rotation(0.5 * turn).toRotationMatrix();
  R_IB_ = Quat(R_IB_ * exp_rotation(turn).toRotationMatrix()).normalized().toRotationMatrix();
  gyro_before_ = reading.gyro;
  const Mat3 R_IW = R_IB_ * state.R_WB().transpose();
  const Vec3 v =
      before(0).v_imu + period_ * (R_half * reading.accelerometer + R_IW * kGravityVector);
  newest_ = (newest_ + 1) % static_cast<int>(moments_.size());
  Moment& now = moments_[static_cast<std::size_t>(newest_)];
  now.v_imu = v;
  now.jump = (reading.accelerometer - accelerometer_before_).norm();
  accelerometer_before_ = reading.accelerometer;
  for (const Leg leg : arm_.legs()) {
    const std::size_t k = index(leg);
    const Mat3 R_IK = R_IW * dynamics.shank[k].R;
    const Vec3 rolling = log_rotation(Quat(Mat3(R_IK * R_IK_[k].transpose())));
    rolled_[k] += rolling.cross(R_IW * (dynamics.foot[k].p - dynamics.contact[k].p));
    R_IK_[k] = R_IK;
    arm_[k] = R_IW * (dynamics.foot[k].p - dynamics.base.p);
    now.x[k] = arm_[k] - rolled_[k];
  }
}

// A shock that both sense is no fault, and feet lift off before their forces show it.
bool ImuCheck::is_shaken(const SensorReading& reading, const RobotState& state,
                         const model::Dynamics& dynamics, const PerLeg<bool>& stands) const {
  Vec3 by_feet = kGravityVector;
  for (std::size_t k = 0; k < stands.size(); ++k)
    if (stands[k]) by_feet += state.foot_force[k] / dynamics.mass;
  return tumbles(reading) || by_feet.norm() > options_.max_acceleration;
}

bool ImuCheck::tumbles(const SensorReading& reading) const {
  const double shaken = std::abs(reading.accelerometer.norm() - kGravity);
  return reading.gyro.norm() > options_.tumbling && shaken > options_.shaking;
}

void ImuCheck::count_firm_feet(const RobotState& state, const PerLeg<bool>& stands,
                               const Vec3& normal_W) {
  for (const Leg leg : arm_.legs()) {
    const std::size_t k = index(leg);
    const bool is_firm =
        stands[k] && normal_W.dot(state.foot_force[k]) >= options_.force;  // not if it is NaN
    firm_ticks_[k] = is_firm ? std::min(firm_ticks_[k] + 1, 1 << 20) : 0;
    if (!is_firm) rolled_[k].setZero();
  }
}

Vec3 ImuCheck::imu_second_difference(int half) const {
  Vec3 way = Vec3::Zero();
  for (int i = 0; i < half; ++i) {
    way +=
        before(i).v_imu + before(i + 1).v_imu - before(half + i).v_imu - before(half + i + 1).v_imu;
  }
  return 0.5 * period_ * way;
}

double ImuCheck::unseen_displacement(int ticks) const {
  double jump = 0.0;
  for (int i = 0; i < ticks; ++i) jump = std::max(jump, before(i).jump);
  return jump * period_ * (0.5 * period_ * ticks);
}

// A foot that slides or lifts off differs from a correct IMU; a faulty IMU differs from all feet.
double ImuCheck::least_displacement(const Vec3& second_difference, const PerLeg<bool>& firm,
                                    int ticks) const {
  double least = kUnlimited;
  for (std::size_t k = 0; k < firm.size(); ++k) {
    if (!firm[k]) continue;
    const Vec3 of_foot = before(0).x[k] - 2.0 * before(ticks / 2).x[k] + before(ticks).x[k];
    least = std::min(least, (second_difference + of_foot).norm());
  }
  return least;
}

double ImuCheck::largest_turn(const PerLeg<bool>& firm, int from, int to) const {
  double result = 0.0;
  for (std::size_t i = 0; i < firm.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!firm[i] || !firm[k]) continue;
      const Vec3 now = before(to).x[i] - before(to).x[k],
                 then = before(from).x[i] - before(from).x[k];
      result = std::max(result, (now - then).norm() / (arm_[i] - arm_[k]).norm());
    }
  }
  return result;
}

ImuCheck::Disagreement ImuCheck::compare(int ticks) const {
  Disagreement result;
  const int settled = static_cast<int>(std::lround(options_.settle / period_));
  const int half = ticks / 2;
  PerLeg<bool> firm;
  firm.resize(static_cast<int>(arm_.size()));
  const Vec3 second_difference = imu_second_difference(half);
  for (const Leg leg : arm_.legs()) {
    const std::size_t k = index(leg);
    firm[k] = firm_ticks_[k] > ticks + settled;
    result.feet += firm[k] ? 1 : 0;
  }
  if (result.feet < kMinFeet) return result;
  result.displacement = least_displacement(second_difference, firm, ticks);
  result.unseen = unseen_displacement(ticks);
  const Turn first = turn(firm, ticks, half), second = turn(firm, half, 0);
  result.spread = first.spread + second.spread;
  if (result.feet < kMinFeetForTurn) return result;
  const auto sure = [&](const Turn& half_turn) {
    return half_turn.angle.norm() - options_.doubt * half_turn.misfit / half_turn.lever;
  };
  const bool goes_on = first.angle.dot(second.angle) > 0.0;
  result.turn = goes_on ? 2.0 * std::max(0.0, std::min(sure(first), sure(second))) : 0.0;
  if (result.turn == 0.0) return result;
  // A foot that slides off an edge looks like a turn about the others, so these must turn, too.
  for (std::size_t k = 0; k < firm.size(); ++k) {
    if (!firm[k]) continue;
    PerLeg<bool> others = firm;
    others[k] = false;
    result.turn = std::min(result.turn, 2.0 * std::min(largest_turn(others, ticks, half),
                                                       largest_turn(others, half, 0)));
  }
  return result;
}

ImuCheck::Turn ImuCheck::turn(const PerLeg<bool>& firm, int from, int to) const {
  Turn result;
  const auto count = static_cast<double>(std::ranges::count(firm, true));
  Vec3 mean_arm = Vec3::Zero(), mean_moved = Vec3::Zero();
  const auto moved = [&](std::size_t k) { return Vec3(before(to).x[k] - before(from).x[k]); };
  for (std::size_t k = 0; k < firm.size(); ++k) {
    if (!firm[k]) continue;
    mean_arm += arm_[k] / count;
    mean_moved += moved(k) / count;
  }
  Mat3 information = Mat3::Zero();
  Vec3 moments = Vec3::Zero();
  for (std::size_t k = 0; k < firm.size(); ++k) {
    if (!firm[k]) continue;
    const Vec3 arm = arm_[k] - mean_arm, own = moved(k) - mean_moved;
    result.spread += own.squaredNorm() / count;
    result.lever += arm.squaredNorm() / count;
    information += arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose();
    moments += arm.cross(own);
  }
  result.angle = information.ldlt().solve(moments);
  for (std::size_t k = 0; k < firm.size(); ++k) {
    if (!firm[k]) continue;
    const Vec3 arm = arm_[k] - mean_arm, own = moved(k) - mean_moved;
    result.misfit += (own - result.angle.cross(arm)).squaredNorm() / count;
  }
  result.spread = std::sqrt(result.spread);
  result.lever = std::sqrt(result.lever);
  result.misfit = std::sqrt(result.misfit);
  return result;
}

void ImuCheck::judge() {
  double longest = 0.0;
  for (std::size_t i = 0; i < ticks_.size(); ++i) {
    const Disagreement found = compare(ticks_[i]);
    shares_[i] = 0.0;
    if (found.feet < kMinFeet) continue;
    const double span = period_ * ticks_[i];
    const double max_displacement = options_.position_margin + options_.velocity_margin * span;
    const double max_turn = options_.turn_margin + options_.rate_margin * span;
    const double uncertainty = options_.doubt * (found.spread + found.unseen);
    shares_[i] = std::max(0.0, (found.displacement - uncertainty) / max_displacement);
    if (found.feet >= kMinFeetForTurn) {
      shares_[i] = std::max(shares_[i], found.turn / max_turn);
    }
    if (shares_[i] > 1.0) longest = std::max(longest, span);
  }
  disagrees_for_ = longest > 0.0 ? disagrees_for_ + period_ : 0.0;
  wrong_for_ = disagrees_for_ > kOneSample * period_ ? longest + disagrees_for_ : 0.0;
}

}  // namespace surefoot::estimation
