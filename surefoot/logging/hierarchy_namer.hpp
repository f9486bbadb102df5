#pragma once

#include "surefoot/logging/log_header.hpp"
#include "surefoot/logging/message_fields.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace surefoot::logging {

/// Names of a hierarchy's levels, highest first, and of their rows.
struct LevelNames {
  std::vector<std::string> levels;
  RowNamer row_name;

  /// "level 3" and "row 17" without a name.
  [[nodiscard]] std::string level(int number) const;
  [[nodiscard]] std::string row(int level, std::int32_t id) const;
};

/// Adds the log's names to a HierarchyReport.
class HierarchyNamer {
 public:
  explicit HierarchyNamer(LevelNames names) : names_(std::move(names)) {}

  /// The reference stays valid until the next call.
  const logged::Hierarchy& name(const HierarchyReport& report);

 private:
  void name_rows(const HierarchyReport& report);
  void name_switch(const LevelSwitchReport& change);

  LevelNames names_;
  logged::Hierarchy named_;
};

}  // namespace surefoot::logging
