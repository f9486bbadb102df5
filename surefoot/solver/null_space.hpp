#pragma once

#include <Eigen/Core>

namespace surefoot::solver {

/// Orthonormal basis Z of the null space N(A) = {x : A x = 0}, one direction a column (Eq. 12).
///
/// A row is independent of those before it if more than `relative_tolerance` ‖aᵢ‖ of it is left
/// after projection, so scaling a row has no effect. A trivial null space has zero columns; without
/// rows it is the identity. Allocates; for set-up and tests.
[[nodiscard]] Eigen::MatrixXd null_space(const Eigen::Ref<const Eigen::MatrixXd>& A,
                                         double relative_tolerance = 1e-8);

/// N([A₁; A₂]) = Z₁ N(A₂ Z₁) for a basis Z₁ of N(A₁) (Eq. 12). A₂ Z₁ may lose rank although A₁ and
/// A₂ have full rank: two conflicting tasks.
[[nodiscard]] Eigen::MatrixXd null_space_within(const Eigen::Ref<const Eigen::MatrixXd>& A2,
                                                const Eigen::Ref<const Eigen::MatrixXd>& Z1,
                                                double relative_tolerance = 1e-8);

}  // namespace surefoot::solver
