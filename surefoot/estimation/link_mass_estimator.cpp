#include "surefoot/estimation/link_mass_estimator.hpp"

#include <Eigen/Cholesky>

#include <cmath>

namespace surefoot::estimation {
namespace {

constexpr double kMaxShare = 0.5;  // of a link's modelled mass

LinkMassOptions scaled(LinkMassOptions options, const Scale& scale) {
  for (double* time : {&options.begin, &options.duration, &options.wait}) *time *= scale.time();
  options.noise *= scale.torque();
  return options;
}

}  // namespace

LinkMassEstimator::LinkMassEstimator(const LinkMassOptions& options, double period,
                                     const Scale& scale, int num_legs)
    : options_(scaled(options, scale)),
      period_(period),
      num_links_(kJointsPerLeg * num_legs),
      swings_(num_legs, Swing{}),
      state_(Unknowns::Zero(num_links_ + 1)) {
  const auto ticks = [period](double duration) {
    return static_cast<int>(std::lround(duration / period));
  };
  begin_ = ticks(options_.begin);
  end_ = begin_ + ticks(options_.duration);
  known_ = end_ + ticks(options_.wait);
  Unknowns usual = Unknowns::Constant(num_links_ + 1, options_.usual_share);
  usual[num_links_] = options_.usual_delay;
  covariance_ = usual.cwiseAbs2().asDiagonal();
}

void LinkMassEstimator::update(double time, const model::Dynamics& dynamics,
                               const PerLeg<bool>& stands, const JointVector& torque) noexcept {
  if (!options_.enabled) return;
  const bool is_next = std::abs(time - time_ - period_) < 0.5 * period_;
  time_ = time;
  for (const Leg leg : swings_.legs()) {
    Swing& swing = swings_[index(leg)];
    if (stands[index(leg)]) {
      swing = Swing{};
      continue;
    }
    ++swing.ticks;
    swing.is_over = swing.is_over || !is_next;
    if (swing.is_over) continue;
    if (swing.ticks > begin_ && swing.ticks < end_) {
      add(swing, dynamics.links[index(leg)], torque.segment<kJointsPerLeg>(first_joint(leg)));
    } else if (swing.ticks >= known_) {
      swing.is_over = true;
      learn(leg, swing);
    }
  }
}

LinkMassEstimator::Shares LinkMassEstimator::shares() const {
  return state_.head(num_links_).cwiseMax(-kMaxShare).cwiseMin(kMaxShare);
}

void LinkMassEstimator::add(Swing& swing, const model::LegLinks& links, const Vec3& torque) const {
  const double T = period_ * (end_ - begin_);
  const double t = period_ * (swing.ticks - begin_);
  const double s = std::sin(kPi * t / T), c = std::cos(kPi * t / T);
  for (int n = 0; n < kNumWeights; ++n) {
    const double sn = std::sin(n * kPi * t / T), cn = std::cos(n * kPi * t / T);
    const double share = 2.0 / T * period_;
    const double weight = share * s * s * cn;
    const double slope = share * kPi / T * (2.0 * s * c * cn - n * s * s * sn);
    const int row = n * kJointsPerLeg;
    swing.links.middleRows<kJointsPerLeg>(row) -= slope * links.momentum + weight * links.free_rate;
    swing.torque.segment<kJointsPerLeg>(row) += weight * torque;
    swing.torque_slope.segment<kJointsPerLeg>(row) += slope * torque;
  }
}

// A bad fit gives no masses: the foot caught on something, or a number is not finite.
void LinkMassEstimator::learn(Leg leg, const Swing& swing) {
  using RowsOfAll =
      Eigen::Matrix<double, kNumRows, Eigen::Dynamic, Eigen::ColMajor, kNumRows, kMaxUnknowns>;
  using Gain =
      Eigen::Matrix<double, Eigen::Dynamic, kNumRows, Eigen::ColMajor, kMaxUnknowns, kNumRows>;
  RowsOfAll A = RowsOfAll::Zero(kNumRows, num_links_ + 1);
  A.middleCols<kJointsPerLeg>(first_joint(leg)) = swing.links;
  A.col(num_links_) = -swing.torque_slope;
  const Rows missing = swing.torque - swing.links.rowwise().sum() - A * state_;
  const Gain PA = covariance_ * A.transpose();
  Eigen::Matrix<double, kNumRows, kNumRows> S = A * PA;
  S.diagonal().array() += options_.noise * options_.noise;
  const Eigen::LLT<Eigen::Matrix<double, kNumRows, kNumRows>> S_factor(S);
  const double misfit = missing.dot(S_factor.solve(missing)) / kNumRows;
  if (!(misfit < options_.most_sigmas * options_.most_sigmas)) return;
  state_ += PA * S_factor.solve(missing);
  covariance_ -= PA * S_factor.solve(PA.transpose());
  covariance_ = 0.5 * (covariance_ + covariance_.transpose()).eval();
}

}  // namespace surefoot::estimation
