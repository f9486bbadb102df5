#pragma once

#include <Eigen/Core>

#include <string>
#include <string_view>
#include <vector>

namespace surefoot::solver {

/// Rows that a task fills in place: lower ≤ A x ≤ upper, an equality if lower = upper (Eq. 8). A
/// one-sided row has ±infinity on its open side. Rows longer than 1e150 (‖a‖) and finite bounds
/// beyond ±1e150 are `invalid_input` to the solvers: their squares overflow.
struct Rows {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<RowMajor> A;             ///< rows × unknowns
  Eigen::Map<Eigen::VectorXd> lower;  ///< in the unit of the row
  Eigen::Map<Eigen::VectorXd> upper;

  /// Makes row i the equality a x = b.
  void set_equal(Eigen::Index i, double b) { lower[i] = upper[i] = b; }

  /// Multiplies the violation of row i, which must be filled, by `weight` in its level,
  ///
  ///     lower ≤ a x ≤ upper   →   w lower ≤ w a x ≤ w upper,   w > 0
  ///
  /// From here on residuals, costs and certificates are of the weighted row. A weight changes the
  /// result only if the level can't satisfy all of its rows. Throws Error for a weight that is not
  /// above 0 and finite, and for a row beyond the last.
  void weigh(Eigen::Index i, double weight);
  /// The same for all rows.
  void weigh(double weight);
};

/// Throws Error unless a weight, which the message calls `what`, is above 0 and finite.
void check_weight(double weight, std::string_view what);

/// One priority: rows that are satisfied as well as possible, by least squares of their violation,
/// without disturbing any level before.
class Level {
 public:
  using RowMajor = Rows::RowMajor;

  /// Capacity is fixed here; nothing allocates afterwards. Throws Error for negative sizes.
  Level(std::string name, Eigen::Index max_rows, Eigen::Index unknowns);

  void clear() {
    num_rows_ = 0;
    has_overflowed_ = false;
  }

  /// Appends `count` rows, with A zeroed, for the caller to fill. `first_id` identifies the row
  /// across ticks (a friction row of leg 2 keeps its id when leg 1 lifts off); ids count up from
  /// it. Without room for them the rows belong to no level, memory is allocated for them, and the
  /// level has overflowed: solvers answer `invalid_input`. Throws Error for a negative count.
  [[nodiscard]] Rows add(Eigen::Index count, int first_id);

  /// Appends the rows of another level over the same unknowns, with its ids plus `id_offset`.
  /// Throws Error for other unknowns.
  Rows add(const Level& other, int id_offset = 0);

  /// The rows from `first` on, to change in place. Throws Error beyond the last.
  [[nodiscard]] Rows rows(Eigen::Index first = 0);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] Eigen::Index unknowns() const { return A_.cols(); }
  [[nodiscard]] Eigen::Index num_rows() const { return num_rows_; }
  /// More rows were added since the last `clear` than fit.
  [[nodiscard]] bool has_overflowed() const { return has_overflowed_; }
  [[nodiscard]] Eigen::Index max_rows() const { return A_.rows(); }
  [[nodiscard]] auto A() const { return A_.topRows(num_rows_); }
  [[nodiscard]] auto lower() const { return lower_.head(num_rows_); }
  [[nodiscard]] auto upper() const { return upper_.head(num_rows_); }
  [[nodiscard]] int id(Eigen::Index row) const { return ids_[static_cast<std::size_t>(row)]; }
  [[nodiscard]] const int* ids() const { return ids_.data(); }
  /// Equal for levels of the same name.
  [[nodiscard]] std::size_t name_hash() const { return name_hash_; }

 private:
  [[nodiscard]] Rows overflow(Eigen::Index count);

  std::string name_;
  std::size_t name_hash_;
  RowMajor A_;
  Eigen::VectorXd lower_, upper_;
  std::vector<int> ids_;
  Eigen::Index num_rows_ = 0;
  bool has_overflowed_ = false;
  RowMajor A_beyond_;  // rows without room, to be filled and ignored
  Eigen::VectorXd lower_beyond_, upper_beyond_;
};

/// Levels in strict order of priority over the same unknowns x, highest first.
class Hierarchy {
 public:
  /// Throws Error for a negative number of unknowns.
  explicit Hierarchy(Eigen::Index unknowns);

  /// At set-up only: appends a level of fixed capacity and returns its index.
  std::size_t add_level(std::string name, Eigen::Index max_rows);

  [[nodiscard]] Eigen::Index unknowns() const { return unknowns_; }
  [[nodiscard]] std::size_t num_levels() const { return levels_.size(); }
  [[nodiscard]] Level& level(std::size_t i) { return levels_[i]; }
  [[nodiscard]] const Level& level(std::size_t i) const { return levels_[i]; }

 private:
  Eigen::Index unknowns_;
  std::vector<Level> levels_;
};

}  // namespace surefoot::solver
