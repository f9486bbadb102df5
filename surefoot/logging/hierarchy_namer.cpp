#include "surefoot/logging/hierarchy_namer.hpp"

#include <algorithm>

namespace surefoot::logging {
namespace {

/// The claimed number of entries, limited to the possible one.
std::size_t count(std::int32_t claimed, std::size_t most) {
  return std::min(static_cast<std::size_t>(std::max(claimed, 0)), most);
}

}  // namespace

std::string LevelNames::level(int number) const { return level_name(levels, number); }

std::string LevelNames::row(int level, std::int32_t id) const {
  return row_name ? row_name(level, id) : "row " + std::to_string(id);
}

const logged::Hierarchy& HierarchyNamer::name(const HierarchyReport& report) {
  named_.status = report.status;
  named_.failed_level = report.failed_level;
  named_.borderline = report.borderline;
  named_.levels.resize(count(report.num_levels, kMaxLevels));
  for (std::size_t i = 0; i < named_.levels.size(); ++i) {
    named_.levels[i].name = names_.level(static_cast<int>(i));
    named_.levels[i].status = level_status(report, i);
    named_.levels[i].report = report.levels[i];
  }
  named_.blocking_is_known = report.blocking_is_known;
  named_.transition_share = report.transition_share;
  name_rows(report);
  name_switch(report.level_switch);
  return named_;
}

void HierarchyNamer::name_rows(const HierarchyReport& report) {
  named_.active.resize(count(report.num_active, kMaxReportedRows));
  for (std::size_t i = 0; i < named_.active.size(); ++i) {
    const ActiveRow& row = report.active[i];
    named_.active[i] = {names_.level(row.level), names_.row(row.level, row.id), row.id, row.state,
                        row.by};
  }
  named_.missed.resize(count(report.num_missed, kMaxReportedMisses));
  for (std::size_t i = 0; i < named_.missed.size(); ++i) {
    const MissedEquality& row = report.missed[i];
    named_.missed[i] = {names_.level(row.level), names_.row(row.level, row.id), row.id, row.by};
  }
  named_.blocked_by.resize(count(report.num_blocking, kMaxReportedBlockers));
  for (std::size_t i = 0; i < named_.blocked_by.size(); ++i) {
    const BlockingRow& row = report.blocking[i];
    named_.blocked_by[i] = {names_.level(row.level), names_.level(row.by_level),
                            names_.row(row.by_level, row.id), row};
  }
}

void HierarchyNamer::name_switch(const LevelSwitchReport& change) {
  named_.level_switches.clear();
  if (!change.begins) return;
  logged::LevelSwitch& named = named_.level_switches.emplace_back();
  named.duration = change.duration;
  for (std::size_t k = 0; k < change.change.size(); ++k) {
    const std::string level = names_.level(static_cast<int>(k));
    if (change.change[k] == LevelChange::comes) named.add.push_back(level);
    if (change.change[k] == LevelChange::goes) named.remove.push_back(level);
  }
}

}  // namespace surefoot::logging
