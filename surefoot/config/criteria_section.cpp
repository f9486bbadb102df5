#include "surefoot/config/criteria_section.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/nearest_name.hpp"

#include <algorithm>

namespace surefoot::config {
namespace {

void read_limits(Section& limits, evaluation::Criterion& criterion) {
  double value = 0.0;
  for (auto [key, limit] : {std::pair{"min", &criterion.min}, std::pair{"max", &criterion.max}}) {
    if (limits.node(key) == nullptr) continue;
    limits.number(key, value);
    *limit = value;
  }
  if (criterion.min && criterion.max) {
    limits.require_order("min", *criterion.min, "max", *criterion.max);
  }
}

evaluation::Criterion read_criterion(Section& section, const std::string& metric) {
  evaluation::Criterion criterion;
  criterion.metric = metric;
  if (section.node(metric.c_str())->kind == ConfigNode::Kind::map) {
    section.section(metric.c_str(), [&](Section& limits) { read_limits(limits, criterion); });
  } else {
    bool expected = false;
    section.flag(metric.c_str(), expected);
    criterion.equals = expected;
  }
  return criterion;
}

bool is_metric(const std::string& name) {
  const std::vector<std::string> names = metric_names();
  return std::ranges::find(names, name.substr(0, name.find('.'))) != names.end();
}

}  // namespace

std::vector<std::string> metric_names() {
  std::vector<std::string> names;
  for (const auto& [name, value] : evaluation::values(evaluation::Metrics()))
    names.emplace_back(name);
  return names;
}

void read_criteria(Section& section, bool has_goal, std::vector<evaluation::Criterion>& criteria) {
  const auto by_default = [&](const char* metric, bool expected) {
    if (section.node(metric) != nullptr) return;
    criteria.push_back({.metric = metric, .min = {}, .max = {}, .equals = expected});
  };
  by_default("fell", false);
  if (has_goal) by_default("goal_reached", true);
  for (const std::string& metric : section.keys()) {
    if (!is_metric(metric)) {
      section.fail(metric, "unknown metric; " + valid_names(metric, metric_names()));
    }
    // An empty value removes a default criterion.
    if (section.node(metric.c_str())->kind == ConfigNode::Kind::null) continue;
    if (metric == "goal_reached" && !has_goal) {
      section.fail(metric, "the scenario has no goal; goal.feet_beyond_x gives it one");
    }
    criteria.push_back(read_criterion(section, metric));
    try {
      evaluation::check(criteria.back());
    } catch (const Error& error) {
      section.fail(metric, error.what());
    }
  }
}

}  // namespace surefoot::config
