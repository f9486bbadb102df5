#pragma once

#include "surefoot/evaluation/metrics.hpp"

#include <vector>

namespace surefoot::evaluation {

/// Which values are better.
enum class Sense { none, smaller, larger };

/// How a value goes on while the run does. One that has grown beyond its limit stays there.
enum class Course { varies, grows, falls };

/// Where a metric belongs.
enum class Place { with_all, among_the_first, in_the_title };

/// The unit that people read a metric in.
struct ShownUnit {
  std::string_view name;
  double scale = 1.0;  ///< from the value, whose unit stands at the end of the metric's name
};

/// A metric, declared once: JSON, criteria, tables, reports, campaigns and pages go by this.
/// All are measured on the simulator's truth, except commanded and planned values. Comparisons
/// with the controller's plan or estimate end when it stops for safety.
struct Metric {
  using Member = std::variant<bool Metrics::*, std::optional<bool> Metrics::*, int Metrics::*,
                              double Metrics::*, std::uint64_t Metrics::*, std::string Metrics::*,
                              Quantiles Metrics::*>;
  std::string_view name;
  Member member;
  ShownUnit unit;
  Sense sense;
  Course course;
  std::string_view help;  ///< what it is
  Place place = Place::with_all;
  bool is_by_clock = false;  ///< by the machine's clock, so that no two runs have the same
};

/// All metrics, in the order in which they are told.
[[nodiscard]] const std::vector<Metric>& metric_table();

/// A metric by its name, or a member of it: "tick_us.p99". Null: there is none.
[[nodiscard]] const Metric* find_metric(std::string_view name);

}  // namespace surefoot::evaluation
