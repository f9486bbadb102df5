#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace surefoot::report {

/// How a metric came out; nothing where it could not be measured.
struct Metric {
  std::string name;  ///< of a distribution its member: "tick_us.median"
  std::variant<std::monostate, bool, double, std::string> value;
};

/// A criterion of the run.
struct Requirement {
  std::string metric;
  std::optional<double> min, max;
  std::optional<bool> equals;
  std::optional<bool> passed;  ///< nothing where the run was not judged
};

/// What a log says of how its run came out.
struct Outcome {
  bool known = false;        ///< the log has a summary that can be read; else nothing is judged
  bool interrupted = false;  ///< from outside, or begun again; nothing is judged either
  bool succeeded = false;
  std::string reason;  ///< why it ended
  std::string goal;    ///< what the scenario is for, in words; empty: it names none
  bool goal_reached = false;
  std::vector<Metric> metrics;
  std::vector<Requirement> criteria;
  std::vector<std::pair<std::string, std::string>> paper;  ///< what the paper says of a metric

  [[nodiscard]] const Metric* metric(const std::string& name) const;
  [[nodiscard]] const Requirement* criterion(const std::string& name) const;
  [[nodiscard]] const std::string* figure_of_paper(const std::string& name) const;
};

/// From the log's summary and from the options of its header, both JSON; what is not there, or of
/// another shape, is left out.
[[nodiscard]] Outcome read_outcome(const std::string& summary, const std::string& options);

}  // namespace surefoot::report
