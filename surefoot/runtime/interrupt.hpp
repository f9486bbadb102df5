#pragma once

namespace surefoot::runtime {

/// From now on ^C (SIGINT) and SIGTERM only set a flag.
void watch_for_interrupt();

/// True once one of them came.
[[nodiscard]] bool interrupted();

}  // namespace surefoot::runtime
