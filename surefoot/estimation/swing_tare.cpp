#include "surefoot/estimation/swing_tare.hpp"

#include "surefoot/signals/sensor_reading.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace surefoot::estimation {
namespace {

/// Usual size of θ: [N·m], 1, [N·m·s/rad], [N·m·s²/rad].
const Eigen::Vector4d kUsual(0.5, 0.1, 0.2, 0.02);

SwingTareOptions scaled(SwingTareOptions options, const Scale& scale) {
  for (double* time : {&options.begin, &options.end, &options.wait, &options.memory})
    *time *= scale.time();
  options.most *= scale.torque();
  options.noise *= scale.torque();
  return options;
}

Eigen::Vector4d usual_sizes(const Scale& scale) {
  const double torque = scale.torque(), time = scale.time();
  return kUsual.cwiseProduct(Eigen::Vector4d(torque, 1.0, torque * time, torque * time * time));
}

}  // namespace

SwingTare::SwingTare(const SwingTareOptions& options, double bandwidth, double period,
                     const Scale& scale, int num_legs)
    : options_(scaled(options, scale)),
      usual_(usual_sizes(scale)),
      period_(period),
      forgetting_(std::exp(-period / options_.memory)),
      low_pass_gain_(1.0 - std::exp(-bandwidth * period)),
      wait_(std::min(kMaxWaiting - 1, static_cast<std::size_t>(std::ceil(options_.wait / period)))),
      tare_(LegJointVector::Zero(kJointsPerLeg * num_legs)) {
  legs_.resize(num_legs);
  stages_.fill(Signals::Constant(tare_.size(), kNumFeatures - 1, kNaN));
}

void SwingTare::update(const PerLeg<bool>& stands, const LegJointVector& missing,
                       const JointVector& torque, const JointVector& velocity,
                       const JointVector& acceleration) noexcept {
  tare_.setZero();
  if (!options_.enabled) return;
  const Eigen::Index n = tare_.size();
  Signals now(n, kNumFeatures - 1);
  now << torque.head(n), velocity.head(n), acceleration.head(n);
  const Signals& signals = lagged(now);
  for (const Leg k : legs_.legs()) {
    LegTare& leg = legs_[index(k)];
    const int first = first_joint(k);
    if (stands[index(k)]) {
      // Only now: part of a swing does not predict the rest of it.
      if (leg.num_seen > 0)
        for (Joint& joint : leg.joints) fit(joint);
      leg.num_seen = 0;
      leg.air_time = 0.0;
      continue;
    }
    leg.air_time += period_;
    Sample sample;
    sample.missing = missing.segment<3>(first);
    for (int j = 0; j < kJointsPerLeg; ++j) {
      const int i = first + j;
      sample.features[static_cast<std::size_t>(j)] << 1.0, signals.row(i).transpose();
      tare_[i] = leg.joints[static_cast<std::size_t>(j)].theta.dot(
          sample.features[static_cast<std::size_t>(j)]);
    }
    if (leg.air_time > options_.begin && leg.air_time < options_.end + options_.wait) {
      enqueue(leg, sample);
    }
  }
}

// A low-pass never recovers from a NaN: restart it.
const SwingTare::Signals& SwingTare::lagged(const Signals& now) noexcept {
  if (!stages_.back().allFinite()) stages_.fill(now);
  const Signals* input = &now;
  for (Signals& stage : stages_) {
    stage += low_pass_gain_ * (*input - stage);
    input = &stage;
  }
  return stages_.back();
}

void SwingTare::fit(Joint& joint) const {
  Moments regularised = joint.moments;
  regularised.diagonal() += (options_.noise / usual_.array()).square().matrix();
  joint.theta = regularised.llt().solve(joint.products);
}

// A sample from `wait` ago was in the air, as no touchdown followed.
void SwingTare::enqueue(LegTare& leg, const Sample& sample) {
  leg.waiting[leg.num_seen % kMaxWaiting] = sample;
  if (leg.num_seen >= wait_) learn(leg, leg.waiting[(leg.num_seen - wait_) % kMaxWaiting]);
  ++leg.num_seen;
}

void SwingTare::learn(LegTare& leg, const Sample& sample) const {
  for (std::size_t j = 0; j < kJointsPerLeg; ++j) {
    const Features& x = sample.features[j];
    const double y = sample.missing[static_cast<Eigen::Index>(j)];
    if (!x.allFinite() || !(std::abs(y) < options_.most)) continue;
    Joint& joint = leg.joints[j];
    joint.moments = forgetting_ * joint.moments + x * x.transpose();
    joint.products = forgetting_ * joint.products + y * x;
  }
}

}  // namespace surefoot::estimation
