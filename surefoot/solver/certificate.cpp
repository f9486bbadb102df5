#include "surefoot/solver/certificate.hpp"

#include "surefoot/math/numbers.hpp"
#include "surefoot/solver/doubt.hpp"
#include "surefoot/solver/even_units.hpp"
#include "surefoot/solver/optimality_conditions.hpp"

#include <algorithm>
#include <cmath>

namespace surefoot::solver {
namespace {

double finite_or_infinity(double number) { return std::isfinite(number) ? number : kInfinity; }

/// In the units of x; `units` relates them to the given ones.
std::vector<LevelCertificate> certify_in_units(const Hierarchy& hierarchy, const Eigen::VectorXd& x,
                                               const CertificateOptions& options,
                                               const Eigen::VectorXd& units) {
  std::vector<LevelCertificate> certificates;
  const std::size_t num_levels = std::min(hierarchy.num_levels(), options.levels);
  if (!x.allFinite()) {
    certificates.assign(num_levels, {kNaN, kInfinity});
    for (std::size_t k = 1; k < num_levels; ++k) certificates[k].rests_on = 0;
    return certificates;
  }
  RowSet fixed(hierarchy.unknowns());
  RowSet touching(hierarchy.unknowns());
  int unproven = -1;  // the first unproven level
  for (std::size_t k = 0; k < num_levels; ++k) {
    LevelConditions level = optimality_conditions(hierarchy, k, x, options.tight);
    const Multipliers found = multipliers(level, fixed, touching, options.rank);
    const bool is_sound = std::isfinite(level.residual) && std::isfinite(level.rounding);
    certificates.push_back(
        {level.residual, is_sound ? finite_or_infinity(found.stationarity) : kInfinity});
    certificates.back().rests_on = unproven;
    if (is_sound)
      certificates.back().doubt =
          what_doubles_hide(hierarchy, k, x, options.tight, fixed, touching, units);
    if (unproven < 0 && verdict(certificates.back()) != Verdict::proven)
      unproven = static_cast<int>(k);
    fix_pushing(found, fixed, touching);
    fix_violated(hierarchy.level(k), x, fixed, options.rank, level);
    fixed.add(level.fixed);
    touching.add(level.touching);
  }
  return certificates;
}

}  // namespace

std::vector<LevelCertificate> certify(const Hierarchy& hierarchy, const Eigen::VectorXd& x,
                                      const CertificateOptions& options) {
  const Eigen::VectorXd units = even_units(hierarchy);
  if ((units.array() == 1.0).all()) return certify_in_units(hierarchy, x, options, units);
  return certify_in_units(in_units(hierarchy, units), x.cwiseQuotient(units), options, units);
}

std::string_view name(Verdict verdict) {
  switch (verdict) {
    case Verdict::proven:
      return "proven";
    case Verdict::not_judged:
      return "not judged";
    case Verdict::not_proven:
      return "not proven";
  }
  return "unknown";
}

Verdict verdict(const LevelCertificate& level) {
  if (!(level.stationarity <= kProvenStationarity)) return Verdict::not_proven;
  const bool is_judged = level.rests_on < 0 && level.doubt.stationarity <= kProvenStationarity &&
                         level.doubt.residual <= kSameResidual;
  return is_judged ? Verdict::proven : Verdict::not_judged;
}

Verdict verdict(const std::vector<LevelCertificate>& levels) {
  Verdict worst = Verdict::proven;
  for (const LevelCertificate& level : levels) worst = std::max(worst, verdict(level));
  return worst;
}

double worst_stationarity(const std::vector<LevelCertificate>& levels) {
  double worst = 0.0;
  for (const LevelCertificate& level : levels) {
    worst = std::max(worst, finite_or_infinity(level.stationarity));
  }
  return worst;
}

}  // namespace surefoot::solver
