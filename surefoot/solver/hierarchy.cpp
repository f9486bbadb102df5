#include "surefoot/solver/hierarchy.hpp"

#include "surefoot/base/error.hpp"

#include <cmath>
#include <functional>
#include <sstream>
#include <utility>

namespace surefoot::solver {
namespace {

/// Returns a valid size of a level, or throws Error.
Eigen::Index checked(Eigen::Index size, const std::string& of, const std::string& level) {
  if (size >= 0) return size;
  throw Error("level \"" + level + "\" is made for " + std::to_string(size) + " " + of +
              "; expected 0 or more");
}

/// Returns a valid number of unknowns, or throws Error.
Eigen::Index checked_unknowns(Eigen::Index unknowns) {
  if (unknowns >= 0) return unknowns;
  throw Error("a hierarchy is made for " + std::to_string(unknowns) +
              " unknowns; expected 0 or more");
}

}  // namespace

void check_weight(double weight, std::string_view what) {
  if (weight > 0.0 && std::isfinite(weight)) return;
  std::ostringstream message;
  message << what << " is " << weight << "; expected a finite number > 0";
  throw Error(message.str());
}

void Rows::weigh(Eigen::Index i, double weight) {
  check_weight(weight, "the weight of a row");
  if (i < 0 || i >= A.rows()) {
    throw Error("row " + std::to_string(i) + " is weighed, counted from 0; there are " +
                std::to_string(A.rows()) + " rows");
  }
  A.row(i) *= weight;
  lower[i] *= weight;
  upper[i] *= weight;
}

void Rows::weigh(double weight) {
  check_weight(weight, "the weight of rows");
  for (Eigen::Index i = 0; i < A.rows(); ++i) weigh(i, weight);
}

Level::Level(std::string name, Eigen::Index max_rows, Eigen::Index unknowns)
    : name_(std::move(name)),
      name_hash_(std::hash<std::string>{}(name_)),
      A_(RowMajor::Zero(checked(max_rows, "rows", name_), checked(unknowns, "unknowns", name_))),
      lower_(Eigen::VectorXd::Zero(max_rows)),
      upper_(Eigen::VectorXd::Zero(max_rows)),
      ids_(static_cast<std::size_t>(max_rows), 0) {}

Rows Level::add(Eigen::Index count, int first_id) {
  if (count < 0) {
    throw Error(std::to_string(count) + " rows are added to level \"" + name_ +
                "\"; expected 0 or more");
  }
  if (count > max_rows() - num_rows_) return overflow(count);
  const Eigen::Index first = num_rows_;
  num_rows_ += count;
  for (Eigen::Index i = 0; i < count; ++i) {
    ids_[static_cast<std::size_t>(first + i)] = first_id + static_cast<int>(i);
  }
  Rows added = rows(first);
  added.A.setZero();
  return added;
}

// The caller can fill these rows as if there were room.
Rows Level::overflow(Eigen::Index count) {
  has_overflowed_ = true;
  A_beyond_.setZero(count, A_.cols());
  lower_beyond_.setZero(count);
  upper_beyond_.setZero(count);
  return {Eigen::Map<RowMajor>(A_beyond_.data(), count, A_.cols()),
          Eigen::Map<Eigen::VectorXd>(lower_beyond_.data(), count),
          Eigen::Map<Eigen::VectorXd>(upper_beyond_.data(), count)};
}

Rows Level::add(const Level& other, int id_offset) {
  if (other.unknowns() != unknowns()) {
    throw Error("level \"" + name_ + "\" has " + std::to_string(unknowns()) +
                " unknowns and can't have the rows of level \"" + other.name_ + "\", which has " +
                std::to_string(other.unknowns()));
  }
  const Eigen::Index first = num_rows_;
  Rows added = add(other.num_rows(), 0);
  has_overflowed_ = has_overflowed_ || other.has_overflowed_;
  added.A = other.A();
  added.lower = other.lower();
  added.upper = other.upper();
  for (Eigen::Index i = 0; first + i < num_rows_; ++i) {
    ids_[static_cast<std::size_t>(first + i)] = other.id(i) + id_offset;
  }
  return added;
}

Rows Level::rows(Eigen::Index first) {
  if (first < 0 || first > num_rows_) {
    throw Error("rows of level \"" + name_ + "\" are asked for from " + std::to_string(first) +
                " on; expected 0 to " + std::to_string(num_rows_));
  }
  const Eigen::Index count = num_rows_ - first;
  return {Eigen::Map<RowMajor>(A_.data() + first * A_.cols(), count, A_.cols()),
          Eigen::Map<Eigen::VectorXd>(lower_.data() + first, count),
          Eigen::Map<Eigen::VectorXd>(upper_.data() + first, count)};
}

Hierarchy::Hierarchy(Eigen::Index unknowns) : unknowns_(checked_unknowns(unknowns)) {}

std::size_t Hierarchy::add_level(std::string name, Eigen::Index max_rows) {
  levels_.emplace_back(std::move(name), max_rows, unknowns_);
  return levels_.size() - 1;
}

}  // namespace surefoot::solver
