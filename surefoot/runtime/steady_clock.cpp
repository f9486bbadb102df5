#include "surefoot/runtime/steady_clock.hpp"

#include <chrono>

namespace surefoot::runtime {

double steady_seconds() noexcept {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace surefoot::runtime
