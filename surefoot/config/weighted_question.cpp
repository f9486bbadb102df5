#include "surefoot/config/weighted_question.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/solver/weighted_levels.hpp"

namespace surefoot::config {
namespace {

/// Number of levels in the line, without the reference of x.
std::size_t num_levels_of_line(const NamedHierarchy& question) {
  return question.hierarchy.num_levels() - (question.has_reference ? 1 : 0);
}

void append_level(const solver::Level& level, solver::Hierarchy& hierarchy) {
  hierarchy.level(hierarchy.add_level(level.name(), level.num_rows())).add(level);
}

solver::Hierarchy first_levels(const solver::Hierarchy& hierarchy, std::size_t count) {
  solver::Hierarchy result(hierarchy.unknowns());
  for (std::size_t k = 0; k < count; ++k) append_level(hierarchy.level(k), result);
  return result;
}

/// `first` is counted from 0.
NamedHierarchy weighted(const NamedHierarchy& question, std::size_t first,
                        const std::vector<double>& weights) {
  const std::size_t num_levels = num_levels_of_line(question);
  const solver::Hierarchy of_line = first_levels(question.hierarchy, num_levels);
  solver::WeightedLevels levels(of_line, first, weights);
  NamedHierarchy result{levels.update(of_line), {}, {}};
  const auto weight_of = [&](std::size_t k) {
    return k < first || k - first >= weights.size() ? 1.0 : weights[k - first];
  };
  for (std::size_t k = 0; k < num_levels; ++k) {
    const std::string of = k < first ? "" : question.hierarchy.level(k).name() + ", ";
    if (k <= first) {
      result.row_names.emplace_back();
      result.weights.emplace_back();
      result.units.push_back(k < first ? question.units[k] : "");
    }
    for (const std::string& row : question.row_names[k])
      result.row_names.back().push_back(of + row);
    for (const double weight : question.weights[k])
      result.weights.back().push_back(weight_of(k) * weight);
  }
  if (!question.has_reference) return result;
  append_level(question.hierarchy.level(num_levels), result.hierarchy);
  result.row_names.push_back(question.row_names.back());
  result.weights.push_back(question.weights.back());
  result.units.push_back(question.units.back());
  result.has_reference = true;
  return result;
}

void check(const NamedHierarchy& strict, std::size_t first, std::size_t num_weights,
           const std::string& place) {
  const std::size_t num_levels = num_levels_of_line(strict);
  const std::string given = "--weighted is " + std::to_string(first);
  if (first > num_levels) {
    throw FileError(place + ": " + given + "; expected 1 to " + std::to_string(num_levels) +
                    ", the line's number of levels");
  }
  if (num_weights > num_levels - first + 1) {
    throw FileError(place + ": " + given + " with " + std::to_string(num_weights) +
                    " weights; expected at most " + std::to_string(num_levels - first + 1) +
                    ", one for each level from there on");
  }
}

}  // namespace

NamedHierarchy weighted_question(const NamedHierarchy& strict, int first,
                                 const std::vector<double>& weights, const std::string& place) {
  const auto from = static_cast<std::size_t>(first);
  check(strict, from, weights.size(), place);
  return weighted(strict, from - 1, weights);
}

std::vector<double> residuals_at(const solver::Hierarchy& hierarchy, const Eigen::VectorXd& x) {
  std::vector<double> residuals;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    const solver::Level& level = hierarchy.level(k);
    const Eigen::ArrayXd value = (level.A() * x).array();
    const Eigen::ArrayXd by = (value - level.upper().array()).max(level.lower().array() - value);
    residuals.push_back(by.size() > 0 ? by.max(0.0).matrix().norm() : 0.0);
  }
  return residuals;
}

}  // namespace surefoot::config
