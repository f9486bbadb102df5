#include "surefoot/explain/explanation_json.hpp"

namespace surefoot::explain {
namespace {

using Json = nlohmann::ordered_json;

Json rows_and_levels(const std::vector<NamedRow>& rows) {
  Json list = Json::array();
  for (const NamedRow& row : rows) list.push_back({{"level", row.level + 1}, {"row", row.name}});
  return list;
}

Json blocking_levels(const std::vector<LevelAccount>& levels, const LevelAccount& level) {
  Json list = Json::array();
  for (const BlockingLevelAccount& by : level.blocked_by) {
    Json rows = Json::array();
    for (const BlockingRowAccount& row : by.rows) {
      rows.push_back({{"row", row.name},
                      {"state", row.state},
                      {"cost", row.cost},
                      {"multiplier", row.multiplier},
                      {"independence", row.independence}});
      const std::string unit = multiplier_unit(level, levels[by.level]);
      if (!unit.empty()) rows.back()["multiplier_unit"] = unit;
      if (row.would_gain) rows.back()["would_gain"] = true;
      if (!row.same.empty()) rows.back()["same"] = rows_and_levels(row.same);
    }
    list.push_back({{"level", by.level + 1},
                    {"name", levels[by.level].name},
                    {"cost", by.cost},
                    {"rows", std::move(rows)}});
  }
  return list;
}

Json level_json(const std::vector<LevelAccount>& levels, const LevelAccount& level, bool is_swept) {
  Json json = {{"name", level.name}};
  if (!level.unit.empty()) json["unit"] = level.unit;
  json["status"] = level.status;
  if (level.status != kNotReached) json["residual"] = level.residual;
  json["rows"] = level.num_rows;
  if (level.status == kNotReached) return json;
  if (level.status != kCutOff) json["freedom_left"] = level.freedom_left;
  if (!is_swept) json["iterations"] = level.iterations;
  if (level.time > 0.0) json["time_s"] = level.time;
  json["missed"] = Json::array();
  for (const MissedRow& row : level.missed) {
    json["missed"].push_back({{"row", row.name}, {"by", row.by}});
    if (row.weight != 1.0) json["missed"].back()["weight"] = row.weight;
  }
  json["at_bound"] = Json::array();
  for (const HeldRow& row : level.held)
    json["at_bound"].push_back({{"row", row.name}, {"bound", row.at_upper ? "upper" : "lower"}});
  if (level.status != kCutOff) json["blocked_by"] = blocking_levels(levels, level);
  return json;
}

}  // namespace

Json explanation_json(const SolutionExplanation& explanation) {
  const std::vector<LevelAccount>& levels = explanation.levels;
  const solver::Solution& solution = explanation.solution;
  Json list = Json::array();
  for (std::size_t k = 0; k < levels.size(); ++k) {
    list.push_back(level_json(levels, levels[k], solution.is_swept));
    if (k >= explanation.certificates.size()) continue;
    const solver::LevelCertificate& certificate = explanation.certificates[k];
    list.back()["certificate"] = certificate.stationarity;
    list.back()["verdict"] = name(solver::verdict(certificate));
    if (certificate.rests_on >= 0) list.back()["rests_on"] = certificate.rests_on + 1;
  }
  Json json = {{"x", std::vector<double>(solution.x.begin(), solution.x.end())},
               {"status", name(solution.status)}};
  if (num_finished(solution, levels.size()) < levels.size())
    json["failed_level"] = solution.failed_level + 1;
  json[solution.is_swept ? "sweeps" : "iterations"] = num_iterations(solution);
  json["time_s"] = solution.time;
  json["levels"] = std::move(list);
  return json;
}

std::string SolutionExplanation::json() const { return text_of(explanation_json(*this)); }

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace surefoot::explain
