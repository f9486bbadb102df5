#include "surefoot/config/hierarchy_json.hpp"
#include "surefoot/math/numbers.hpp"

#include <nlohmann/json.hpp>

#include <utility>

namespace surefoot::config {
namespace {

using Index = Eigen::Index;
using Json = nlohmann::ordered_json;

/// A block of a level while it is written.
struct JsonBlock {
  Json rows = Json::array(), lower = Json::array(), upper = Json::array();
  Json names = Json::array(), ids = Json::array();
  bool has_lower = false;

  void add(const solver::Level& level, Index i, const std::string& name) {
    Json numbers = Json::array();
    for (const double number : level.A().row(i)) numbers.push_back(number + 0.0);  // −0 becomes 0
    rows.push_back(std::move(numbers));
    const double low = level.lower()[i], up = level.upper()[i];
    has_lower = has_lower || low > -kInfinity;
    lower.push_back(low > -kInfinity ? Json(low) : Json());
    upper.push_back(up < kInfinity ? Json(up) : Json());
    names.push_back(name);
    ids.push_back(level.id(i));
  }
};

Json to_json(const solver::Level& level, std::size_t k, const RowName& row_name,
             const std::string& unit) {
  JsonBlock equal, between;
  for (Index i = 0; i < level.num_rows(); ++i) {
    const double lower = level.lower()[i], upper = level.upper()[i];
    if (lower == -kInfinity && upper == kInfinity) continue;  // no effect
    JsonBlock& block = lower == upper ? equal : between;
    block.add(level, i, row_name ? row_name(k, i) : "");
  }
  Json object = {{"name", level.name()}};
  if (!unit.empty()) object["unit"] = unit;
  object["A"] = std::move(equal.rows);
  object["b"] = std::move(equal.upper);
  object["D"] = std::move(between.rows);
  if (between.has_lower) object["lower"] = std::move(between.lower);
  object["f"] = std::move(between.upper);
  if (row_name) {
    object["A_names"] = std::move(equal.names);
    object["D_names"] = std::move(between.names);
  }
  object["A_ids"] = std::move(equal.ids);
  object["D_ids"] = std::move(between.ids);
  return object;
}

}  // namespace

std::string format_hierarchy(const solver::Hierarchy& hierarchy, const RowName& row_name,
                             const std::vector<std::string>& units) {
  Json levels = Json::array();
  for (std::size_t k = 0; k < hierarchy.num_levels(); ++k) {
    levels.push_back(
        to_json(hierarchy.level(k), k, row_name, k < units.size() ? units[k] : std::string()));
  }
  return Json{{"levels", std::move(levels)}}.dump();
}

}  // namespace surefoot::config
