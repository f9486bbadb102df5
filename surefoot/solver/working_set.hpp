#pragma once

#include "surefoot/solver/tableau.hpp"
#include "surefoot/solver/turning_least_squares.hpp"

#include <Eigen/Core>

#include <vector>

namespace surefoot::solver {

/// Constraints of higher levels that are held at a bound while solving a level.
///
/// The tableau's basis is turned so that the held rows are lower triangular in the first free
/// columns: T(held, first_free …) = [L 0]. Later columns move no held row.
class WorkingSet {
 public:
  explicit WorkingSet(Eigen::Index unknowns);

  struct Held {
    Eigen::Index row = 0;
    int side = 0;        ///< +1 at its upper bound, −1 at its lower bound
    double force = 0.0;  ///< multiplier times side times ‖a‖; ≥ 0 if the bound is needed
  };

  void clear(Tableau& tableau);
  /// `least_squares` follows the turns of the basis while it is running.
  void add(Tableau& tableau, Eigen::Index row, int side, TurningLeastSquares& least_squares);
  void remove(Tableau& tableau, Eigen::Index position, TurningLeastSquares& least_squares);

  /// Forces μ that balance the gradient: Lᵀ μ = −gradient, gradient of size `size()`. Overwrites
  /// `gradient`.
  void set_forces(const Tableau& tableau, Eigen::Ref<Eigen::VectorXd> gradient);

  /// Smallest |Lᵢᵢ| / ‖aᵢ‖.
  [[nodiscard]] double smallest_pivot(const Tableau& tableau) const;

  [[nodiscard]] Eigen::Index size() const { return size_; }
  [[nodiscard]] const Held& operator[](Eigen::Index i) const {
    return held_[static_cast<std::size_t>(i)];
  }

 private:
  void reflect_into_place(Tableau& tableau, Eigen::Index row);
  void rotate_into_place(Tableau& tableau, Eigen::Index row, TurningLeastSquares& least_squares);
  [[nodiscard]] Held& at(Eigen::Index i) { return held_[static_cast<std::size_t>(i)]; }

  std::vector<Held> held_;
  Eigen::Index size_ = 0;
  Eigen::VectorXd v_;
  std::vector<Rotation> rotations_;
};

}  // namespace surefoot::solver
