#include "surefoot/model/inertia.hpp"

#include <Eigen/Eigenvalues>

#include <sstream>

namespace surefoot::model {
namespace {

constexpr double kPlaceholderMass = 1e-3;  // [kg]

/// m (|r|² 1 − r rᵀ), the inertia of a point mass at r.
Mat3 point_inertia(double mass, const Vec3& r) {
  return mass * (r.squaredNorm() * Mat3::Identity() - r * r.transpose());
}

}  // namespace

Inertia Inertia::placed(const Mat3& R, const Vec3& p) const {
  return {mass, R * com + p, R * about_com * R.transpose()};
}

Inertia Inertia::operator+(const Inertia& other) const {
  Inertia sum;
  sum.mass = mass + other.mass;
  if (sum.mass > 0.0) sum.com = (mass * com + other.mass * other.com) / sum.mass;
  sum.about_com = about_com + point_inertia(mass, com - sum.com) + other.about_com +
                  point_inertia(other.mass, other.com - sum.com);
  return sum;
}

Vec3 principal_moments(const Inertia& inertia) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(inertia.about_com, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

bool obeys_triangle_inequality(const Vec3& principal_moments) {
  const Vec3& moment = principal_moments;
  return moment[0] + moment[1] >= (1.0 - kInertiaRounding) * moment[2];
}

bool is_placeholder(const Inertia& inertia) {
  const Vec3 moment = principal_moments(inertia);
  const bool described = inertia.mass > 0.0 || !inertia.about_com.isZero(0.0);
  const bool positive_definite = moment[0] > kInertiaRounding * moment[2];
  return described && inertia.mass <= kPlaceholderMass &&
         (inertia.mass == 0.0 || !positive_definite);
}

std::string placeholder_note(const std::string& link, double mass) {
  std::ostringstream note;
  note << "root link \"" << link << "\": its inertia (" << mass
       << " kg, not positive definite) is a placeholder and was left out";
  return note.str();
}

}  // namespace surefoot::model
