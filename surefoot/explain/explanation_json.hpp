#pragma once

#include "surefoot/explain/explain.hpp"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace surefoot::explain {

/// A whole explanation, as its `json()` describes.
[[nodiscard]] nlohmann::ordered_json explanation_json(const TickExplanation& explanation);
[[nodiscard]] nlohmann::ordered_json explanation_json(const SolutionExplanation& explanation);

/// What gave way to what: `time`, `sentence`, `gave_way`, `costs_are_exact` and `why_estimates`;
/// each level also has `told`, see LevelThatGaveWay::num_shown.
[[nodiscard]] nlohmann::ordered_json gave_way_json(const TickExplanation& explanation);

/// Each with `time`, `text`, `leg` (null: none) and `by`.
[[nodiscard]] nlohmann::ordered_json events_json(const std::vector<NearbyEvent>& events);

/// On one line; bytes that are no UTF-8 are replaced.
[[nodiscard]] std::string text_of(const nlohmann::ordered_json& json);

}  // namespace surefoot::explain
