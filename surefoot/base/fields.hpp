#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace surefoot {

/// Numbers that make sense for an option, and how to say so.
struct NumberRange {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_included = true;
  const char* words = "a finite number";
  /// In C++ it stands for "not given", and is valid as well.
  double none = std::numeric_limits<double>::quiet_NaN();

  /// Is this a finite number in the range?
  [[nodiscard]] bool holds(double value) const;
};

inline constexpr NumberRange kAnyNumber{};
inline constexpr NumberRange kPositive{
    .min = 0.0, .min_included = false, .words = "a number above 0"};
inline constexpr NumberRange kNotNegative{.min = 0.0, .words = "a number of at least 0"};
inline constexpr NumberRange kShare{.min = 0.0, .max = 1.0, .words = "a number from 0 to 1"};
/// Of a low-pass: some periods of control at least, or it is none and may be unstable.
inline constexpr NumberRange kTimeConstant{.min = 0.01, .max = 10.0, .words = "from 0.01 to 10 s"};

/// What a rule over several options asks and says. Keys are dotted paths below its group.
class Given {
 public:
  Given() = default;
  Given(const Given&) = delete;
  Given& operator=(const Given&) = delete;
  virtual ~Given() = default;

  /// Is the key written?
  [[nodiscard]] virtual bool has(const std::string& key) const = 0;
  /// Throws Error about a key.
  [[noreturn]] virtual void fail(const std::string& key, const std::string& message) const = 0;

  /// Of two numbers: fails, with both, where the high one is below the low one.
  void require_order(const char* low_key, double low, const char* high_key, double high) const;
};
using Rule = std::function<void(const Given&)>;

struct Field;

/// The options of a map, in order, and what must hold between them.
struct Group {
  Group() = default;
  Group(std::initializer_list<Field> rows);
  [[nodiscard]] Group with(Rule what) &&;
  [[nodiscard]] Group and_also(Group more) &&;

  std::vector<Field> fields;
  Rule rule;
};

/// One of the named values of an enumeration.
struct Choice {
  std::vector<std::string> names;
  std::function<void(std::size_t)> set;
  std::size_t given;  ///< names.size(): none
  const char* what = "choice";
};
/// `names` in the order of the enumerators.
template <typename Enum>
[[nodiscard]] Choice choice(Enum& value, std::vector<std::string> names) {
  return {.names = std::move(names),
          .set = [&value](std::size_t i) { value = static_cast<Enum>(i); },
          .given = static_cast<std::size_t>(value)};
}
/// The place of a name in a list; -1: none.
[[nodiscard]] Choice place(int& value, std::vector<std::string> names, const char* what);

/// As many numbers as there are names: a list of all, or a map with some of them by name.
struct Numbers {
  double* data;
  std::vector<std::string> names;
  bool or_one = false;  ///< or one number that holds for all
};
/// Each of these names once.
struct Order {
  std::vector<std::string> names;
  std::function<void(const std::vector<std::size_t>&)> set;
  std::vector<std::size_t> given;
  const char* what;
};
/// A list of texts; `size` 0: of any length above 0.
struct Names {
  std::vector<std::string>* values;
  std::size_t size;
  const char* what;
};
/// Groups of which there may be many: a map from names of their own, or a list. They may be of
/// several shapes.
struct Entries {
  struct Shape {
    const char* name;
    std::function<Group()> add;
  };
  std::vector<Shape> shapes;      ///< with more than one each entry has its `shape`
  const char* of_list = nullptr;  ///< what must stand there if not a list; null: a map
};
/// Read by code of its own; `schema` names its form.
struct Other {
  const char* schema;
};

/// How the number of an option goes with the size of the robot.
enum class Sizing {
  by_unit,      ///< as its unit says
  none,         ///< of sensors, drives and clocks
  half_length,  ///< with the distance of front and hind hips
  half_width,   ///< with the distance of left and right feet
  base_height,  ///< with the legs' length, less the hips' height over the base
  stride,       ///< with speed, less where the hips are close to each other
  walk,         ///< with time, more there: the same way at the speed of these strides
};

/// An option, as files have it: where it is kept (with its default) and what is to be said of it.
struct Field {
  using Value =
      std::variant<double*, int*, std::uint64_t*, bool*, std::string*, std::vector<double>*, Choice,
                   Numbers, Order, Names, Group, Entries, Other>;

  Field(std::string its_key, Value its_value, std::string its_help)
      : key(std::move(its_key)), value(std::move(its_value)), help(std::move(its_help)) {}
  Field(std::string its_key, Value its_value, const NumberRange& its_range, std::string its_unit,
        std::string its_help, Sizing its_sizing = Sizing::by_unit)
      : key(std::move(its_key)),
        value(std::move(its_value)),
        range(its_range),
        unit(std::move(its_unit)),
        help(std::move(its_help)),
        sizing(its_sizing) {}
  /// Must be there where its map is.
  [[nodiscard]] Field required() && {
    is_required = true;
    return std::move(*this);
  }

  std::string key;
  Value value;
  NumberRange range{};
  std::string unit{};
  std::string help;
  bool is_required = false;
  Sizing sizing = Sizing::by_unit;
};

/// Entries of a type with `fields(T&)`. `finish(T&, const Given&)` gets each when it is read;
/// `initial`: one that nothing is given of.
template <typename T, typename Finish>
[[nodiscard]] Entries::Shape shape_of(const char* name, Finish finish, const T& initial = {}) {
  return {name, [finish, initial] {
            const auto entry = std::make_shared<T>(initial);
            Group group = fields(*entry);
            group.rule = [entry, finish, rule = group.rule](const Given& given) {
              if (rule) rule(given);
              finish(*entry, given);
            };
            return group;
          }};
}

/// "> 0", "0 … 1", "≥ 0.01" …; empty where every number is valid.
[[nodiscard]] std::string text_of(const NumberRange& range);

/// For options that were not read from a file. Throws Error on the first that makes no sense: its
/// name, what was given, what would be valid.
void check_fields(const std::string& name, const Group& group);

}  // namespace surefoot
