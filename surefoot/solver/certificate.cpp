#include "surefoot/solver/certificate.hpp"

#include "surefoot/solver/optimality_conditions.hpp"

#include <algorithm>

namespace surefoot {

std::vector<LevelCertificate> certify(const Hierarchy& hierarchy, const Eigen::VectorXd& x,
                                      const CertificateOptions& options) {
  std::vector<LevelCertificate> certificates;
  RowSet fixed(hierarchy.unknowns());
  RowSet touching(hierarchy.unknowns());
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    const LevelConditions level = optimality_conditions(hierarchy, k, x, options.tight);
    const double distance = multipliers(level.gradient, fixed, touching, options.rank).distance;
    certificates.push_back({level.residual, distance / level.scale});
    fixed.add(level.fixed);
    touching.add(level.touching);
  }
  return certificates;
}

double worst_stationarity(const std::vector<LevelCertificate>& levels) {
  double worst = 0.0;
  for (const LevelCertificate& level : levels) worst = std::max(worst, level.stationarity);
  return worst;
}

}  // namespace surefoot
