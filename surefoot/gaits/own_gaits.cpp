#include "surefoot/gaits/own_gaits.hpp"

#include "surefoot/base/error.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace surefoot::gaits {
namespace {

/// What a scenario means by these is fixed.
constexpr std::array kReserved{"", "auto", "none"};

}  // namespace

void OwnGaits::add(const std::string& name, GaitFactory make) {
  if (std::ranges::find(kReserved, name) != kReserved.end())
    throw Error("\"" + name + "\" is no name for a gait of your own");
  if (make == nullptr) throw Error("gait \"" + name + "\" needs a factory that makes it");
  if (!gaits_.emplace(name, std::move(make)).second)
    throw Error("there is a gait \"" + name + "\" already; give yours another name");
}

const GaitFactory* OwnGaits::find(const std::string& name) const {
  const auto found = gaits_.find(name);
  return found == gaits_.end() ? nullptr : &found->second;
}

std::vector<std::string> OwnGaits::names() const {
  std::vector<std::string> names;
  for (const auto& [name, make] : gaits_) names.push_back(name);
  return names;
}

}  // namespace surefoot::gaits
