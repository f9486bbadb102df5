#include "surefoot/config/nearest_name.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace surefoot::config {
namespace {

/// Number of insertions, deletions, replacements and swaps of neighbours between two words.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), row(b.size() + 1), next(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    next[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = row[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      next[j] = std::min({replaced, row[j] + 1, next[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        next[j] = std::min(next[j], before[j - 2] + 1);
      }
    }
    before.swap(row);
    row.swap(next);
  }
  return row[b.size()];
}

std::string lower_case(std::string_view name) {
  std::string result(name);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

}  // namespace

std::string valid_names(std::string_view given, const std::vector<std::string>& valid) {
  std::string list;
  std::string_view nearest;
  std::size_t smallest = std::max<std::size_t>(1, given.size() / 3) + 1;
  for (const std::string& name : valid) {
    list += (list.empty() ? "" : ", ") + name;
    const std::size_t distance = edit_distance(lower_case(given), lower_case(name));
    if (distance >= smallest) continue;
    smallest = distance;
    nearest = name;
  }
  const std::string hint = nearest.empty() ? "" : "did you mean \"" + std::string(nearest) + "\"? ";
  return hint + (list.empty() ? "none are valid here" : "valid are: " + list);
}

}  // namespace surefoot::config
