#pragma once

#include "surefoot/solver/hierarchy.hpp"

namespace surefoot {

/// Appends w ‖x − x_ref‖ to a level: the rows w I x = w x_ref, one for each unknown.
///
/// As the last level it chooses, among all x that the hierarchy leaves, the one closest to x_ref.
/// Without it `LexicographicSolver` chooses the shortest, x_ref = 0; of `CascadeSolver` each level
/// changes x by the least, which makes x longer. In any other level it is the classical damping
/// ‖A x − b‖² + w² ‖x − x_ref‖²; that determines every direction, so the levels below have no
/// freedom left and no effect (see `add_damping` for one that leaves it). The rows count in the
/// residual of the level. Does not allocate. Throws Error, before anything is added, for a
/// reference of another length and for a weight that is not above 0 and finite.
///
/// w: unit of the level's rows per unit of x, > 0.
void add_reference(Level& level, const Eigen::Ref<const Eigen::VectorXd>& x_ref, int first_id,
                   double weight = 1.0);

/// Damps a level near singularities: appends d E (x − x_ref) = 0, as many rows as it has, with E an
/// orthonormal basis of the space that its rows A span,
///
///     min ‖violation of A‖² + d² ‖E (x − x_ref)‖²
///
/// Along a singular vector of A with singular value σ that asks for b, an equality level now moves
/// σ b / (σ² + d²) from x_ref instead of b / σ: never more than b / (2 d), and the share
/// d² / (σ² + d²) of b is missed everywhere, also far from the singularity.
///
/// The levels below keep exactly the freedom N(A) that they have without damping; what the level
/// gives up near its singularity is not given to them, it is held at the damped value. Only where a
/// row depends on the others altogether (1e-12) its direction is none of the level's. Inequality
/// rows count as rows of A, too: a damped level determines their directions even where they are
/// satisfied; those without any bound, which ask for nothing, do not. The rows count in the
/// residual of the level. Does not allocate. Throws Error as `add_reference` does.
///
/// d: unit of the level's rows per unit of x, > 0.
void add_damping(Level& level, double damping, const Eigen::Ref<const Eigen::VectorXd>& x_ref,
                 int first_id);

}  // namespace surefoot
