#pragma once

#include "surefoot/signals/leg.hpp"

#include <bit>
#include <cstdint>

namespace surefoot::evaluation {

/// Hash of a run's commanded torques, tick by tick (FNV-1a of their bits, low byte first). Two runs
/// with the same hash commanded the same torques to the bit.
class TorqueHash {
 public:
  void add(const JointVector& torque) {
    for (const double value : torque) {
      const auto bits = std::bit_cast<std::uint64_t>(value);
      for (int shift = 0; shift < 64; shift += 8)
        hash_ = (hash_ ^ ((bits >> shift) & 0xffU)) * 0x100000001b3U;
    }
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325U;
};

}  // namespace surefoot::evaluation
