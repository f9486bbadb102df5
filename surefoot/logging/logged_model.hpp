#pragma once

#include "surefoot/logging/message_fields.hpp"
#include "surefoot/signals/tick_record.hpp"

namespace surefoot::logged {

/// ModelRecord, and results from it and the estimated state.
struct Model {
  ModelRecord record;
  Vec2 zmp = Vec2::Constant(kNaN);  ///< see `measured_zmp`
};

/// `least_load`: see LogRobot.
[[nodiscard]] Model model_of(const TickRecord& tick, double least_load);

/// Measured zero-moment point: a single force there replaces the estimated ground forces f on the
/// feet F, without a horizontal moment, at their mean height:
///
///     x = Σ (p_WF,xy f_z − (p_WF,z − z) f_xy) / Σ f_z,   z = Σ p_WF,z f_z / Σ f_z
///
/// In W [m]; NaN while the feet carry no more than `least_load`, or without an estimate.
[[nodiscard]] Vec2 measured_zmp(const PerLeg<Vec3>& p_WF, const PerLeg<Vec3>& force,
                                double least_load);

template <typename Archive, Is<Model> T>
void fields(Archive& field, T& model) {
  fields(field, model.record);
  field("zmp", model.zmp,
        "measured zero-moment point, of the estimated foot forces of /state, in W [m]");
}

}  // namespace surefoot::logged
