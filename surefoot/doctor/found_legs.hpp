#pragma once

#include "surefoot/doctor/anatomy.hpp"

namespace surefoot::doctor {

class FootFinder;

/// A limb that three joints place, with its foot and its lengths; the others are held at 0.
[[nodiscard]] FoundLeg measured_leg(const Limb& limb,
                                    const std::map<std::string, model::Weld>& welds,
                                    const FootFinder& feet);

/// Adds those of the other limbs, of another number of joints than the legs so far, that reach as
/// low and make them four or six. Takes them out of `anatomy.others`.
void add_unequal(const std::vector<FoundLeg>& others, std::vector<FoundLeg>& legs,
                 Anatomy& anatomy);

/// Of more than four the ones with the lowest tips stay; the others go to `anatomy.others`.
void keep_lowest(std::vector<FoundLeg>& legs, Anatomy& anatomy);

/// Tells LF, RF, LH and RH apart by the hips' places, x forward and y left. Fewer than four, or
/// four that are not in the four quadrants, are an error.
void name_legs(const std::vector<FoundLeg>& legs, const model::Urdf& urdf, Anatomy& anatomy,
               Findings& findings);

/// Tells which HFE and KFE have no <axis>, so that they turn about x, as a cause. Returns whether
/// any has none.
bool tell_missing_axes(const std::vector<FoundLeg>& legs, const model::Urdf& urdf,
                       Findings& findings);

}  // namespace surefoot::doctor
