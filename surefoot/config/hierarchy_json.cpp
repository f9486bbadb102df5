#include "surefoot/config/hierarchy_json.hpp"

#include "surefoot/config/hierarchy_blocks.hpp"
#include "surefoot/config/json_line.hpp"
#include "surefoot/config/number_range.hpp"
#include "surefoot/solver/extra_rows.hpp"

#include <algorithm>

namespace surefoot::config {
namespace {

using hierarchy_file::Block;
using hierarchy_file::check_keys;
using hierarchy_file::count;
using hierarchy_file::Json;
using hierarchy_file::LevelIds;
using hierarchy_file::Place;
using hierarchy_file::quoted;
using hierarchy_file::read_equalities;
using hierarchy_file::read_inequalities;
using hierarchy_file::read_numbers;
using hierarchy_file::read_positive;
using hierarchy_file::Vector;
using Index = Eigen::Index;

constexpr const char* kForm = R"({"levels":[{"A":[[…]],"b":[…],"D":[[…]],"f":[…]},…]})";

struct LevelBlocks {
  std::string name, unit;
  Block equal, between;
  double damping = 0.0;      ///< 0: none
  int first_damping_id = 0;  ///< of its rows, one per row of the level

  [[nodiscard]] Index num_rows() const {
    return static_cast<Index>(equal.rows.size() + between.rows.size());
  }
};

std::string read_text(const Json& level, const char* key, const std::string& otherwise,
                      const Place& place) {
  const auto given = level.find(key);
  if (given == level.end()) return otherwise;
  if (!given->is_string()) {
    place.fail(std::string(key) + " is " + quoted(*given) + "; expected a text");
  }
  return given->get<std::string>();
}

/// Throws FileError for bounds on A, with the valid form.
void check_bounds(const Json& level, const Place& place) {
  const bool has_bounds = level.contains("lower") || level.contains("f");
  const bool is_of_A = level.contains("A") && !level.contains("b") && !level.contains("D");
  if (level.contains("upper") || (has_bounds && is_of_A)) place.fail(kRowsWithBounds);
}

LevelBlocks read_level(const Json& level, const std::string& name, std::size_t& unknowns,
                       const Place& place) {
  static const std::vector<std::string> kKeys{"name",  "unit",      "A",         "b",       "D",
                                              "f",     "lower",     "A_names",   "D_names", "A_ids",
                                              "D_ids", "A_weights", "D_weights", "damping"};
  if (!level.is_object())
    place.fail("is " + quoted(level) + "; expected an object with A, b, D and f");
  check_bounds(level, place);
  check_keys(level, kKeys, place);
  LevelBlocks result{.name = read_text(level, "name", name, place),
                     .unit = read_text(level, "unit", "", place),
                     .equal = read_equalities(level, unknowns, place),
                     .between = read_inequalities(level, unknowns, place)};
  Block &equal = result.equal, &between = result.between;
  LevelIds ids(level, place);
  ids.read("A_ids", equal.rows.size(), equal.ids);
  ids.read("D_ids", between.rows.size(), between.ids);
  ids.fill_up(equal.rows.size(), equal.ids);
  ids.fill_up(between.rows.size(), between.ids);
  if (const auto damping = level.find("damping"); damping != level.end()) {
    result.damping = read_positive(*damping, place.at("damping"));
    result.first_damping_id = ids.first_of(result.num_rows());
  }
  return result;
}

std::vector<LevelBlocks> read_levels(const Json& line, std::size_t& unknowns, const Place& place) {
  if (!line.is_object()) {
    place.fail("is " + quoted(line) + ", which has no array \"levels\"; expected " + kForm);
  }
  check_keys(line, {"levels", "x_ref"}, place);
  if (!line.contains("levels")) {
    place.fail("has no array \"levels\"; expected " + std::string(kForm));
  }
  if (!line["levels"].is_array()) {
    place.fail("has no array \"levels\" but " + quoted(line["levels"]) + "; expected " + kForm);
  }
  std::vector<LevelBlocks> levels;
  for (const Json& level : line["levels"]) {
    const std::string name = "level " + std::to_string(levels.size() + 1);
    const bool is_named = level.is_object() && level.contains("name") && level["name"].is_string();
    const std::string called = is_named ? " (" + level["name"].get<std::string>() + ")" : "";
    levels.push_back(read_level(level, name, unknowns, place.at(name + called)));
  }
  return levels;
}

void append(const Block& block, solver::Level& level) {
  for (std::size_t i = 0; i < block.rows.size(); ++i) {
    solver::Rows row = level.add(1, block.ids[i]);
    row.A = Eigen::Map<const Eigen::RowVectorXd>(block.rows[i].data(), row.A.cols());
    row.lower[0] = block.lower[i];
    row.upper[0] = block.upper[i];
    row.weigh(0, block.weights[i]);
  }
}

/// Appends "what 1", "what 2", …
void append_names(const std::string& what, Index count, std::vector<std::string>& names) {
  for (Index i = 1; i <= count; ++i) names.push_back(what + " " + std::to_string(i));
}

void append_level(const LevelBlocks& level, const Eigen::VectorXd& x_ref, NamedHierarchy& result) {
  const Index rows = level.num_rows();
  const std::size_t k =
      result.hierarchy.add_level(level.name, level.damping > 0.0 ? 2 * rows : rows);
  append(level.equal, result.hierarchy.level(k));
  append(level.between, result.hierarchy.level(k));
  result.units.push_back(level.unit);
  result.row_names.push_back(level.equal.names);
  std::vector<std::string>& names = result.row_names.back();
  names.insert(names.end(), level.between.names.begin(), level.between.names.end());
  std::vector<double>& weights = result.weights.emplace_back(level.equal.weights);
  weights.insert(weights.end(), level.between.weights.begin(), level.between.weights.end());
  weights.resize(static_cast<std::size_t>(level.damping > 0.0 ? 2 * rows : rows), 1.0);
  if (level.damping == 0.0) return;
  solver::add_damping(result.hierarchy.level(k), level.damping, x_ref, level.first_damping_id);
  append_names("damping", result.hierarchy.level(k).num_rows() - rows, names);
}

/// `x_ref` of the line; empty if there is none.
Vector read_reference(const Json& line, std::size_t unknowns, const Place& place) {
  const auto found = line.find("x_ref");
  if (found == line.end()) return {};
  if (!found->is_array()) place.fail("x_ref is " + quoted(*found) + "; expected an array");
  const Vector x_ref = read_numbers(*found, place.at("x_ref"));
  if (x_ref.size() == unknowns) return x_ref;
  place.fail("x_ref has " + count(x_ref.size(), "element") + "; expected " +
             std::to_string(unknowns) + ", one for each unknown");
}

/// Throws FileError if no level has a row, so that the number of unknowns is undefined.
void check_unknowns(std::size_t num_levels, std::size_t unknowns, const Place& place) {
  if (unknowns > 0) return;
  const std::string expected = "; expected at least one row in A or D of a level";
  if (num_levels == 0) place.fail("levels is empty, so there are no unknowns" + expected);
  const std::string last = std::to_string(num_levels);
  if (num_levels == 1)
    place.at("level 1").fail("has no row in A or D, so there are no unknowns" + expected);
  place.at("levels 1 to " + last)
      .fail("have no row in A or D, so there are no unknowns" + expected);
}

}  // namespace

NamedHierarchy parse_hierarchy(std::string_view line, const std::string& place_name) {
  const Place place(place_name);
  std::size_t unknowns = 0;
  const Json object = parse_json_line(line, place_name, kForm);
  const std::vector<LevelBlocks> levels = read_levels(object, unknowns, place);
  check_unknowns(levels.size(), unknowns, place);
  const Vector x_ref = read_reference(object, unknowns, place);
  NamedHierarchy result{solver::Hierarchy(static_cast<Index>(unknowns)), {}, {}};
  Eigen::VectorXd reference = Eigen::VectorXd::Zero(static_cast<Index>(unknowns));
  std::ranges::copy(x_ref, reference.begin());
  for (const LevelBlocks& level : levels) append_level(level, reference, result);
  if (x_ref.empty()) return result;
  result.has_reference = true;
  const std::size_t last = result.hierarchy.add_level("x_ref", reference.size());
  solver::add_reference(result.hierarchy.level(last), reference, 0);
  result.units.emplace_back();
  result.weights.emplace_back(x_ref.size(), 1.0);
  append_names("x", reference.size(), result.row_names.emplace_back());
  return result;
}

}  // namespace surefoot::config
