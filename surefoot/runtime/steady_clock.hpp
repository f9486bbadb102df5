#pragma once

namespace surefoot {

/// The machine's steady clock [s], handed to solvers, which read no clock themselves.
[[nodiscard]] double steady_seconds() noexcept;

}  // namespace surefoot
