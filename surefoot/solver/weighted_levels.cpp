#include "surefoot/solver/weighted_levels.hpp"

#include "surefoot/base/error.hpp"

#include <utility>

namespace surefoot::solver {

WeightedLevels::WeightedLevels(const Hierarchy& capacity, std::size_t first,
                               std::vector<double> weights, const std::string& name)
    : first_(first), weights_(std::move(weights)), weighted_(capacity.unknowns()) {
  if (first >= capacity.num_levels()) {
    throw Error("weighted from level " + std::to_string(first) + ", counted from 0; there are " +
                std::to_string(capacity.num_levels()) + " levels");
  }
  if (weights_.size() > capacity.num_levels() - first) {
    throw Error(std::to_string(weights_.size()) + " weights are given from level " +
                std::to_string(first) + " on; expected at most " +
                std::to_string(capacity.num_levels() - first) + ", one for each");
  }
  for (const double weight : weights_) check_weight(weight, "the weight of a level");
  weights_.resize(capacity.num_levels() - first, 1.0);
  Eigen::Index rows = 0;
  for (std::size_t k = 0; k < capacity.num_levels(); ++k) {
    const Level& level = capacity.level(k);
    if (k < first) weighted_.add_level(level.name(), level.max_rows());
    if (k >= first) rows += level.max_rows();
  }
  weighted_.add_level(name, rows);
}

const Hierarchy& WeightedLevels::update(const Hierarchy& hierarchy) noexcept {
  if (hierarchy.unknowns() != weighted_.unknowns()) return hierarchy;
  for (std::size_t k = 0; k <= first_; ++k) weighted_.level(k).clear();
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    if (k < first_) {
      weighted_.level(k).add(hierarchy.level(k));
    } else {
      Rows rows = weighted_.level(first_).add(hierarchy.level(k), static_cast<int>(k) * kIdStride);
      rows.weigh(weights_[k - first_]);
    }
  }
  return weighted_;
}

}  // namespace surefoot::solver
