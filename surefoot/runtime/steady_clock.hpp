#pragma once

namespace surefoot {

/// The machine's steady clock [s], for solvers, which have none of their own.
[[nodiscard]] double steady_seconds() noexcept;

}  // namespace surefoot
