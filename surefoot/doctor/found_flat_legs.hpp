#pragma once

#include "surefoot/doctor/anatomy.hpp"

namespace surefoot::doctor {

/// Two chains of four to eight hinges that mirror each other and reach lowest: legs with flat feet.
/// Takes them out of `anatomy.others`. `shorter`: limbs of three hinges.
void find_flat_legs(const model::Urdf& urdf, const std::vector<FoundLeg>& shorter,
                    Anatomy& anatomy);

}  // namespace surefoot::doctor
