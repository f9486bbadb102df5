#pragma once

#include "surefoot/doctor/anatomy.hpp"

namespace surefoot::doctor {

/// Two chains of four to eight hinges that mirror each other and reach lowest: legs with flat feet.
/// Takes them out of `anatomy.others`.
void find_flat_legs(const model::Urdf& urdf, Anatomy& anatomy);

/// Parts a limb that branches into chains of hinges, each from the base or a chain before it. Empty
/// if a joint of it is no hinge.
[[nodiscard]] std::vector<Limb> chains_of(const Limb& limb,
                                          const std::map<std::string, model::Weld>& welds);

}  // namespace surefoot::doctor
