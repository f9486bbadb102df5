#pragma once

#include "surefoot/solver/hierarchy.hpp"

namespace surefoot::solver {

/// Appends w ‖x − x_ref‖ to a level: the rows w I x = w x_ref, one for each unknown.
///
/// As the last level it chooses, among all x that the hierarchy leaves, the one closest to x_ref.
/// Otherwise `LexicographicSolver` chooses the shortest, x_ref = 0; in `CascadeSolver` each level
/// changes x by the least, which makes x longer. In any other level it is the classical damping
/// ‖A x − b‖² + w² ‖x − x_ref‖²; that determines every direction, so the levels below have no
/// freedom and no effect (`add_damping` leaves them some). The rows count in the level's residual.
/// Does not allocate. Throws Error, before anything is added, for a reference of another length or
/// a weight that is not above 0 and finite.
void add_reference(Level& level, const Eigen::Ref<const Eigen::VectorXd>& x_ref, int first_id,
                   double weight = 1.0);

/// Damps a level near singularities: appends d E (x − x_ref) = 0, as many rows as it has, with E an
/// orthonormal basis of the space that its rows A span,
///
///     min ‖violation of A‖² + d² ‖E (x − x_ref)‖²
///
/// Along a singular vector of A with singular value σ and target b, an equality level moves
/// σ b / (σ² + d²) from x_ref instead of b / σ: never more than b / (2 d). The share d² / (σ² + d²)
/// of b is missed everywhere, also far from the singularity.
///
/// The levels below keep exactly the freedom N(A) that they have without damping; what the level
/// gives up near its singularity is held at the damped value, not given to them. Only a fully
/// dependent row (1e-12) adds no direction. Inequality rows count as rows of A, too: a damped level
/// determines their directions even if they are satisfied; rows without any bound do not count. The
/// rows count in the level's residual. Does not allocate. Throws Error as `add_reference` does.
///
/// d: unit of the level's rows per unit of x, > 0.
void add_damping(Level& level, double damping, const Eigen::Ref<const Eigen::VectorXd>& x_ref,
                 int first_id);

}  // namespace surefoot::solver
