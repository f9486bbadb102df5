#include "surefoot/explain/explain.hpp"
#include "surefoot/solver/doubt.hpp"
#include "surefoot/solver/even_units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace surefoot::explain {
namespace {

using Eigen::Index;

/// Longest row of a level over its shortest, without zero rows; of the worst level.
double worst_ratio(const solver::Hierarchy& hierarchy) {
  double worst = 1.0;
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    double longest = 0.0, shortest = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < hierarchy.level(k).num_rows(); ++i) {
      const double length = hierarchy.level(k).A().row(i).norm();
      longest = std::max(longest, length);
      if (length > 0.0) shortest = std::min(shortest, length);
    }
    worst = std::max(worst, longest / shortest);
  }
  return worst;
}

/// Largest ratio between lengths of a level's rows for which a proof is promised. A long limit
/// gives way to short rows of its level by 1 / ratio² of its length: beyond this that looks like
/// holding.
constexpr double kMaxLengthRatio = 1e4;

std::string number_of(std::vector<solver::LevelCertificate>::const_iterator level,
                      const std::vector<solver::LevelCertificate>& levels) {
  return std::to_string(level - levels.begin() + 1);
}

auto first_that_is(solver::Verdict said, const std::vector<solver::LevelCertificate>& levels) {
  return std::ranges::find(
      levels, said, [](const solver::LevelCertificate& level) { return solver::verdict(level); });
}

std::string why_not_proven(const solver::Hierarchy& hierarchy,
                           const std::vector<solver::LevelCertificate>& levels) {
  const auto level = first_that_is(solver::Verdict::not_proven, levels);
  std::ostringstream text;
  text << "not proven: level " << number_of(level, levels) << " is " << level->stationarity
       << " from its optimality conditions, relative to its rows; at most "
       << solver::kProvenStationarity << " is rounding";
  const double ratio = worst_ratio(hierarchy);
  if (ratio > kMaxLengthRatio) {
    text << ", which is promised where rows of one level differ in length by at most "
         << kMaxLengthRatio << ", and here by " << ratio;
  } else {
    text << ". Either x is beside the optimum, or rows that hold it are so nearly dependent that "
            "it can't be told";
  }
  return text.str();
}

std::string why_not_judged(const solver::Hierarchy& hierarchy, const Eigen::VectorXd& x,
                           const std::vector<solver::LevelCertificate>& levels) {
  const auto level = first_that_is(solver::Verdict::not_judged, levels);
  std::ostringstream text;
  text << "not judged: level " << number_of(level, levels)
       << " meets its optimality conditions as far as doubles can tell, but by exact arithmetic ";
  if (!std::isfinite(level->doubt.stationarity))
    text << "it can't be computed how far it is from them";
  else if (level->doubt.residual > solver::kSameResidual)
    text << level->doubt.residual << " of its residual and bounds is in doubt";
  else
    text << "its rows are " << level->doubt.stationarity << " from them";
  // In the units that it was judged in.
  const Eigen::VectorXd units = solver::even_units(hierarchy);
  const double length = x.cwiseQuotient(units).norm();
  if (level->doubt.weakest < solver::kClearRank)
    text << ": its ranks are borderline, of a row only " << level->doubt.weakest
         << " of its length is left beside the others";
  else if (length > solver::kLargeX)
    text << ": ‖x‖ is " << length << ", so rounding of it is as much";
  else
    text << ": rows of one level differ in length by "
         << worst_ratio(solver::in_units(hierarchy, units))
         << ", and rounding of the longest hides what the shortest ask for";
  return text.str();
}

}  // namespace

std::string verdict_text(const solver::Hierarchy& hierarchy, const Eigen::VectorXd& x,
                         const std::vector<solver::LevelCertificate>& levels) {
  return solver::verdict(levels) == solver::Verdict::not_proven
             ? why_not_proven(hierarchy, levels)
             : why_not_judged(hierarchy, x, levels);
}

}  // namespace surefoot::explain
