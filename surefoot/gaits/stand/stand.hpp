#pragma once

#include "surefoot/gaits/gait.hpp"
#include "surefoot/gaits/reactions/situation.hpp"

namespace surefoot {

/// All feet stay, the COM comes to rest over their centre. It hands over when the command is to
/// walk, or when a push asks for a step.
class Stand final : public Gait {
 public:
  void begin(const GaitTick& tick, Body& body,
             const std::optional<Action>& first) noexcept override;
  void observe(const GaitTick& tick, Body& body) noexcept override;
  GaitOutcome advance(const GaitTick& tick, Body& body) noexcept override;
  [[nodiscard]] bool waits(const Body&) const override { return true; }

 private:
  static void act(const std::optional<Action>& action, const GaitTick& tick, Body& body);
  static void plan_com(const GaitTick& tick, Body& body);
};

}  // namespace surefoot
