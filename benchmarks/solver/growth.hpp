#pragma once

#include <nlohmann/json.hpp>

namespace surefoot::benchmarks {

/// Times our solver, warm and cold, against the number of unknowns, levels, rows and active rows,
/// one at a time, and on stacks the size of a humanoid's; prints them and returns them. Beside each
/// stands the number of operations of one lexicographic factorization that carries all rows along,
///
///     Σ_{i < min(n, m)} 4 m (n − i)
///
/// and the time that it would take at the speed of Eigen's matrix product in this process.
[[nodiscard]] nlohmann::ordered_json measure_growth(int passes);

}  // namespace surefoot::benchmarks
