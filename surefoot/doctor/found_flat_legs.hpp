#pragma once

#include "surefoot/doctor/anatomy.hpp"

namespace surefoot::doctor {

/// Two chains of four to eight hinges that mirror each other and reach lowest: legs with flat feet.
/// Takes them out of `anatomy.others`.
void find_flat_legs(const model::Urdf& urdf, Anatomy& anatomy);

}  // namespace surefoot::doctor
