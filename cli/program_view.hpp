#pragma once

#include "server/live_run.hpp"
#include "surefoot/config/scenario_file.hpp"

#include <CLI/CLI.hpp>

namespace surefoot::cli {

inline constexpr int kNoMax = 999'999'999;

/// Digits only, as CLI11 would take -1 for a large number. `largest` names kNoMax in the error for
/// a larger number.
[[nodiscard]] CLI::Validator whole_number(int min, int max = kNoMax,
                                          const char* largest = "the largest that is valid");
/// The same for seeds, from 0 to kLargestSeed.
[[nodiscard]] CLI::Validator seed_number();

/// Options of a command that serves the viewer's page.
void add_server(CLI::App& command, server::ViewArguments& view);

/// The same, with `--view`, which asks for the page.
void add_view(CLI::App& command, server::ViewArguments& view);

}  // namespace surefoot::cli
