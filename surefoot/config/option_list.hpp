#pragma once

#include "surefoot/base/fields.hpp"
#include "surefoot/model/description.hpp"
#include "surefoot/tasks/task_definition.hpp"

#include <functional>
#include <string>
#include <vector>

namespace surefoot::config {

/// An option and its description, as text.
struct OptionRow {
  std::string key, value, unit, range, help;  ///< `value`: its default, or "required"
};

/// False for a required option, and if the default number only means "not given".
[[nodiscard]] bool has_default(const Field& field);

/// Calls `visit(path, field)` for every option that is no group: "planner.swing.apex". A name that
/// entries choose themselves appears as `<name>` or, where they have shapes, as that of the shape.
void for_each_option(const Group& group,
                     const std::function<void(const std::string&, const Field&)>& visit,
                     const std::string& prefix = "");

/// The options of a scenario whose keys begin with `prefix`, with the defaults for this robot; for
/// `tasks` those of the catalog and of the user's `own` tasks.
[[nodiscard]] std::vector<OptionRow> list_options(const std::string& prefix,
                                                  const model::RobotDescription& robot,
                                                  const tasks::OwnTasks& own = {});

}  // namespace surefoot::config
