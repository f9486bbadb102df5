#pragma once

#include "surefoot/gaits/planner_options.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace surefoot::gaits {

/// The user's own gaits, which scenarios can name besides the library's.
class OwnGaits {
 public:
  /// Throws Error for a gait without name or factory, and for a name that is taken.
  void add(const std::string& name, GaitFactory make);

  /// Null if there is none of this name.
  [[nodiscard]] const GaitFactory* find(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  std::map<std::string, GaitFactory> gaits_;
};

}  // namespace surefoot::gaits
