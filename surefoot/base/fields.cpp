#include "surefoot/base/fields.hpp"

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"

#include <cmath>

namespace surefoot {
namespace {

/// What would be valid, in words for who writes C++.
std::string valid(const NumberRange& range, const std::string& unit) {
  const std::string with_unit = unit.empty() ? "" : " " + unit;
  const std::string at_most =
      std::isfinite(range.max) ? formatted(", at most %g", range.max) + with_unit : "";
  if (!range.min_included) return formatted("a finite number above %g", range.min) + at_most;
  if (!at_most.empty()) return formatted("between %g and %g", range.min, range.max) + with_unit;
  if (range.min == 0.0) return "0 or a finite number above";
  return std::isfinite(range.min) ? formatted("at least %g", range.min) + with_unit
                                  : "a finite number";
}

/// Holds the options of a group against their ranges.
class Check final : public Given {
 public:
  explicit Check(std::string name) : name_(std::move(name)) {}

  void group(const Group& group) const {
    for (const Field& field : group.fields) {
      std::visit([&](const auto& value) { check(field, value); }, field.value);
    }
    if (group.rule) group.rule(*this);
  }

  [[nodiscard]] bool has(const std::string& /*key*/) const override { return true; }
  [[noreturn]] void fail(const std::string& key, const std::string& message) const override {
    throw Error(path_of(key) + ": " + message);
  }

 private:
  [[nodiscard]] std::string path_of(const std::string& key) const {
    return name_.empty() ? key : name_ + "." + key;
  }

  static void number(const std::string& path, double value, const Field& field,
                     const std::string& unit) {
    if (field.range.holds(value) || value == field.range.none) return;
    throw Error(path + formatted(" is %g; it must be ", value) + valid(field.range, unit));
  }

  void check(const Field& field, double* value) const {
    number(path_of(field.key), *value, field, field.unit);
  }
  void check(const Field& field, int* value) const {
    if (field.range.min == 1.0 && field.range.max == 2.0 && !field.range.holds(*value))
      throw Error(path_of(field.key) + formatted(" is %d; it must be 1 or 2", *value));
    number(path_of(field.key), *value, field, "");
  }
  void check(const Field& field, std::vector<double>* values) const {
    for (std::size_t i = 0; i < values->size(); ++i) element(field, i, (*values)[i]);
  }
  void check(const Field& field, const Numbers& numbers) const {
    for (std::size_t i = 0; i < numbers.names.size(); ++i) element(field, i, numbers.data[i]);
  }
  void check(const Field& field, const Group& group) const {
    Check(path_of(field.key)).group(group);
  }
  /// Of any value, or of a type that has no others.
  template <typename Value>
  void check(const Field& /*field*/, const Value& /*value*/) const {}

  void element(const Field& field, std::size_t i, double value) const {
    number(path_of(field.key) + "[" + std::to_string(i) + "]", value, field, field.unit);
  }

  std::string name_;
};

}  // namespace

bool NumberRange::holds(double value) const {
  return std::isfinite(value) && value <= max && (min_included ? value >= min : value > min);
}

void Given::require_order(const char* low_key, double low, const char* high_key,
                          double high) const {
  if (!(high < low)) return;
  const auto said = [](const char* side, const char* key, double value) {
    return formatted(" must not be %s %s, which is %g", side, key, value);
  };
  if (has(high_key)) fail(high_key, formatted("%g", high) + said("below", low_key, low));
  fail(low_key, formatted("%g", low) + said("above", high_key, high));
}

Group::Group(std::initializer_list<Field> rows) : fields(rows) {}

Group Group::with(Rule what) && {
  if (rule) {
    rule = [first = std::move(rule), then = std::move(what)](const Given& given) {
      first(given);
      then(given);
    };
  } else {
    rule = std::move(what);
  }
  return std::move(*this);
}

Group Group::and_also(Group more) && {
  for (Field& field : more.fields) fields.push_back(std::move(field));
  return more.rule ? std::move(*this).with(std::move(more.rule)) : std::move(*this);
}

Choice place(int& value, std::vector<std::string> names, const char* what) {
  const std::size_t none = names.size();
  return {.names = std::move(names),
          .set = [&value](std::size_t i) { value = static_cast<int>(i); },
          .given = value < 0 ? none : static_cast<std::size_t>(value),
          .what = what};
}

std::string text_of(const NumberRange& range) {
  const bool above = std::isfinite(range.min), below = std::isfinite(range.max);
  if (!above && !below) return "";
  if (!below) return formatted(range.min_included ? "≥ %g" : "> %g", range.min);
  if (!range.min_included) return formatted("> %g, ≤ %g", range.min, range.max);
  return formatted("%g … %g", range.min, range.max);
}

void check_fields(const std::string& name, const Group& group) { Check(name).group(group); }

}  // namespace surefoot
