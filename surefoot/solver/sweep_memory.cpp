#include "surefoot/solver/sweep_memory.hpp"

#include "surefoot/solver/capacity.hpp"

#include <algorithm>
#include <cstdint>

namespace surefoot::solver {
namespace {

constexpr std::size_t kAlignment = SweepMemory::kWidestPack;

std::size_t padded(std::size_t size) { return (size + kAlignment - 1) / kAlignment * kAlignment; }

/// Hands out aligned pieces of a buffer; without a buffer it only counts.
class Pieces {
 public:
  explicit Pieces(double* begin) : next_(begin) {}
  double* take(std::size_t size) {
    double* piece = next_ == nullptr ? nullptr : next_ + used_;
    used_ += padded(size);
    return piece;
  }
  [[nodiscard]] std::size_t used() const { return used_; }

 private:
  double* next_;
  std::size_t used_ = 0;
};

std::size_t assign(Sweep& s, double* begin, std::size_t n, std::size_t rows) {
  const std::size_t stride = padded(n + 1);
  Pieces pieces(begin);
  for (double** by_row :
       {&s.lower, &s.upper, &s.scale, &s.base_value, &s.residual, &s.force, &s.value,
        &s.square_violation, &s.motion, &s.limit_lower, &s.limit_upper}) {
    *by_row = pieces.take(rows);
  }
  for (double** by_column : {&s.beta, &s.inverse_pivot, &s.q, &s.y, &s.x}) {
    *by_column = pieces.take(stride);
  }
  s.gradient = pieces.take(std::max(stride, padded(rows)));
  s.basis = pieces.take(n * stride);
  s.base = pieces.take(rows * stride);
  s.rows = pieces.take(rows * stride);
  s.row_stride = static_cast<int>(padded(rows));
  s.tableau = pieces.take(n * padded(rows));
  s.reflectors = pieces.take(n * stride);
  s.tall = pieces.take((n + 1) * padded(rows));
  return pieces.used();
}

}  // namespace

SweepMemory::SweepMemory(const Hierarchy& capacity, std::size_t more_rows) {
  const auto n = static_cast<std::size_t>(capacity.unknowns());
  const std::size_t levels = capacity.num_levels() + 1;
  const std::size_t rows = static_cast<std::size_t>(max_rows(capacity)) + more_rows;

  doubles_.assign(assign(sweep, nullptr, n, rows) + kAlignment, 0.0);
  const auto misplaced = reinterpret_cast<std::uintptr_t>(doubles_.data()) / sizeof(double);
  assign(sweep, doubles_.data() + (kAlignment - misplaced % kAlignment) % kAlignment, n, rows);

  ints_.assign(2 * rows + 3 * (levels + 1) + 2 * n + 2 * (n + 1), 0);
  int* next = ints_.data();
  const auto take = [&next](std::size_t size) {
    int* piece = next;
    next += size;
    return piece;
  };
  sweep.order = take(rows);
  sweep.list = take(rows);
  sweep.level_begin = take(levels + 1);
  sweep.order_begin = take(levels + 1);
  sweep.first_column = take(levels + 1);
  sweep.pivot = take(n);
  sweep.reach = take(n);
  sweep.tall_order = take(2 * (n + 1));
  const auto num_sides = static_cast<std::size_t>(padded(static_cast<int>(rows) + 1));
  sides_.assign(2 * num_sides, 0);
  sweep.side = sides_.data();
  sweep.state = sides_.data() + num_sides;
  pointers_.assign(rows + 1, nullptr);
  sweep.a = pointers_.data();
}

void append_level(Sweep& s, const Level& level) {
  const int rows = static_cast<int>(level.num_rows());
  const double* lower = level.lower().data();
  const double* upper = level.upper().data();
  const double* a = level.A().data();
  for (int i = 0; i < rows; ++i) {
    s.lower[s.num_rows] = lower[i];
    s.upper[s.num_rows] = upper[i];
    s.a[s.num_rows++] = a + i * static_cast<Eigen::Index>(s.unknowns);
  }
}

}  // namespace surefoot::solver
