#pragma once

#include "app/live_run.hpp"

#include <CLI/CLI.hpp>

#include <limits>

namespace surefoot {

inline constexpr int kNoMax = std::numeric_limits<int>::max();

/// Digits only, and not too many of them; CLI11 would take -1 for a large number.
[[nodiscard]] CLI::Validator whole_number(int min, int max = kNoMax);

/// Options of a command that serves the viewer's page.
void add_server(CLI::App& command, ViewArguments& view);

/// The same, with `--view`, which asks for the page.
void add_view(CLI::App& command, ViewArguments& view);

}  // namespace surefoot
