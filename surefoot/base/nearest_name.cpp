#include "surefoot/base/nearest_name.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace surefoot {
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

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

/// Empty where no name is similar.
std::string hint(std::string_view given, const std::vector<std::string>& valid) {
  std::string_view nearest;
  std::size_t smallest = std::max<std::size_t>(1, given.size() / 3) + 1;
  for (const std::string& name : valid) {
    const std::size_t distance = edit_distance(lower_case(given), lower_case(name));
    if (distance >= smallest) continue;
    smallest = distance;
    nearest = name;
  }
  return nearest.empty() ? "" : "did you mean \"" + std::string(nearest) + "\"? ";
}

}  // namespace

std::string valid_names(std::string_view given, const std::vector<std::string>& valid) {
  return hint(given, valid) +
         (valid.empty() ? "none are valid here" : "valid are: " + listed(valid));
}

std::string near_names(std::string_view given, const std::vector<std::string>& valid) {
  constexpr std::ptrdiff_t kMost = 6;
  std::vector<std::string> nearest;
  for (const std::string& name : valid)
    if (std::ranges::find(nearest, name) == nearest.end()) nearest.push_back(name);
  std::ranges::stable_sort(nearest, {}, [&](const std::string& name) {
    const bool is_part = lower_case(name).find(lower_case(given)) != std::string::npos;
    return edit_distance(lower_case(given), lower_case(name)) / (is_part ? 4 : 1);
  });
  nearest.resize(static_cast<std::size_t>(std::min(kMost, std::ssize(nearest))));
  return hint(given, valid) + "closest: " + listed(nearest);
}

}  // namespace surefoot
