#pragma once

namespace surefoot::runtime {

/// The machine's steady clock [s], handed to solvers, which read no clock themselves.
[[nodiscard]] double steady_seconds() noexcept;

}  // namespace surefoot::runtime
