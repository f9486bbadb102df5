#include "surefoot/control/unsolved_tick.hpp"

#include "surefoot/math/numbers.hpp"
#include "surefoot/solver/solution.hpp"

#include <cstdint>

namespace surefoot::control {
namespace {

ModelRecord unknown_model(int num_legs) {
  const Vec3 unknown = Vec3::Constant(kNaN);
  ModelRecord model{
      .p_WCom = unknown, .v_WCom = unknown, .load = {.mass = kNaN, .first_moment = unknown}};
  for (PerLeg<Vec3>* vectors : {&model.p_WF, &model.p_WH, &model.force})
    *vectors = per_leg(unknown, num_legs);
  return model;
}

}  // namespace

void describe_unsolved(TickRecord& record, std::array<double, kMaxLevels>& level_times) {
  level_times.fill(0.0);
  record.model = unknown_model(static_cast<int>(record.plan.feet.size()));
  const std::int32_t num_levels = record.hierarchy.num_levels;
  record.hierarchy = HierarchyReport{};
  record.hierarchy.num_levels = num_levels;
  for (LevelReport& level : record.hierarchy.levels) level.residual = kNaN;
  record.hierarchy.status = static_cast<std::int32_t>(solver::SolveStatus::invalid_input);
}

}  // namespace surefoot::control
