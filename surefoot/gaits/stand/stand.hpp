#pragma once

#include "surefoot/gaits/gait.hpp"

namespace surefoot::gaits {

/// All feet stay, and the COM comes to rest over their centre. Hands over on a command to walk, or
/// when a push requires a step.
class Stand final : public Gait {
 public:
  void begin(Situation& now, Body& body, const std::optional<Action>& first) override;
  [[nodiscard]] bool waits(const Body&) const override { return true; }

 private:
  void plan_com(const Situation& now, Body& body) override;
  GaitOutcome go_on(Situation& now, Body& body) override;
};

}  // namespace surefoot::gaits
