#pragma once

#include "surefoot/base/fields.hpp"
#include "surefoot/model/description.hpp"

#include <functional>
#include <string>
#include <vector>

namespace surefoot::config {

/// An option with all that is to be said of it, in text.
struct OptionRow {
  std::string key, value, unit, range, help;  ///< `value`: its default, or "required"
};

/// Not where it must be given, or where its number says only that none is given.
[[nodiscard]] bool has_default(const Field& field);

/// Calls `visit(path, field)` for every option that is no group: "planner.swing.apex". A name that
/// entries choose themselves stands as `<name>` or, where they have shapes, as that of the shape.
void for_each_option(const Group& group,
                     const std::function<void(const std::string&, const Field&)>& visit,
                     const std::string& prefix = "");

/// The options of a scenario whose keys begin so, with the defaults for this robot; of `tasks`
/// those that the catalog has.
[[nodiscard]] std::vector<OptionRow> list_options(const std::string& prefix,
                                                  const model::RobotDescription& robot);

}  // namespace surefoot::config
