#pragma once

#include "surefoot/logging/json_text.hpp"
#include "surefoot/logging/message_fields.hpp"

#include <concepts>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Converts signals to JSON messages and to their JSON schemas, by `fields`.
namespace surefoot::logged {

template <typename T>
concept Number = std::same_as<T, bool> || std::integral<T> || std::floating_point<T>;
template <typename T>
concept Matrix = requires { T::RowsAtCompileTime; };
template <typename T>
concept Name = std::same_as<T, LegPhase> || std::same_as<T, CommandMode> ||
               std::same_as<T, StopCause> || std::same_as<T, SampleFault> ||
               std::same_as<T, CalibrationStage> || std::same_as<T, logging::LevelStatus>;

template <typename T>
inline constexpr bool kIsPerLeg = false;
template <typename T>
inline constexpr bool kIsPerLeg<PerLeg<T>> = true;
template <typename T>
inline constexpr bool kIsList = false;
template <typename T>
inline constexpr bool kIsList<std::vector<T>> = true;
template <typename T>
  requires requires { T::kMost; }
inline constexpr bool kIsList<T> = true;
template <typename T>
concept OptionalLeg = std::same_as<T, std::optional<Leg>>;

/// The names of an enumeration's values.
inline const auto& names(LegPhase) { return kPhaseNames; }
inline const auto& names(CommandMode) { return kModeNames; }
inline const auto& names(StopCause) { return kCauseNames; }
inline const auto& names(SampleFault) { return kFaultNames; }
inline const auto& names(CalibrationStage) { return kCalibrationNames; }
inline const auto& names(logging::LevelStatus) { return logging::kLevelStatusNames; }

/// Writes a value as JSON: vectors as arrays, matrices row by row, quaternions as w, x, y, z,
/// per-leg values as an object by the legs' names, enumerations as names, events as numbers.
class Encoder {
 public:
  explicit Encoder(std::string& out) : json_(out) {}

  template <typename T>
  void value(const T& content) {
    if constexpr (Number<T>) {
      json_.value(content);
    } else if constexpr (std::same_as<T, std::string>) {
      json_.value(std::string_view(content));
    } else if constexpr (Name<T>) {
      json_.value(names(content)[static_cast<std::size_t>(content)]);
    } else if constexpr (std::same_as<T, PlanEvent>) {
      json_.value(static_cast<int>(content));
    } else if constexpr (OptionalLeg<T>) {
      content ? json_.value(leg_name(*content, num_legs_)) : json_.null();
    } else if constexpr (std::same_as<T, Quat>) {
      json_.array().value(content.w()).value(content.x()).value(content.y()).value(content.z());
      json_.end_array();
    } else if constexpr (Matrix<T>) {
      matrix(content);
    } else if constexpr (kIsPerLeg<T>) {
      json_.object();
      num_legs_ = static_cast<int>(content.size());
      for (const Leg leg : content.legs()) {
        json_.key(leg_name(leg, num_legs_));
        value(content[index(leg)]);
      }
      json_.end_object();
    } else if constexpr (kIsList<T>) {
      json_.array();
      for (const auto& element : content) value(element);
      json_.end_array();
    } else {
      json_.object();
      fields(*this, content);
      json_.end_object();
    }
  }

  template <typename T>
  void operator()(std::string_view name, const T& content, std::string_view) {
    json_.key(name);
    value(content);
  }

 private:
  template <typename T>
  void matrix(const T& content) {
    json_.array();
    for (Eigen::Index i = 0; i < content.rows(); ++i) {
      if constexpr (T::ColsAtCompileTime == 1) {
        json_.value(content[i]);
      } else {
        json_.array();
        for (Eigen::Index j = 0; j < content.cols(); ++j) json_.value(content(i, j));
        json_.end_array();
      }
    }
    json_.end_array();
  }

  logging::JsonText json_;
  int num_legs_ = kNumLegs;  // of the last list: a plan's events follow its feet
};

/// Writes the JSON schema (draft 2020-12) of a value's type.
class SchemaWriter {
 public:
  SchemaWriter(std::string& out, int num_legs) : json_(out), num_legs_(num_legs) {}

  template <typename T>
  void schema(const T& example, std::string_view title, std::string_view description) {
    json_.object();
    if (!title.empty()) json_.member("title", title);
    if (!description.empty()) json_.member("description", description);
    type(example);
    json_.end_object();
  }

  template <typename T>
  void operator()(std::string_view name, const T& example, std::string_view description) {
    json_.key(name);
    schema(example, "", description);
  }

 private:
  template <typename T>
  void type(const T& example) {
    if constexpr (std::same_as<T, bool>) {
      json_.member("type", "boolean");
    } else if constexpr (std::integral<T> || std::same_as<T, PlanEvent>) {
      json_.member("type", "integer");
    } else if constexpr (std::floating_point<T>) {
      json_.key("type").array().value("number").value("null").end_array();
    } else if constexpr (std::same_as<T, std::string>) {
      json_.member("type", "string");
    } else if constexpr (Name<T>) {
      json_.member("type", "string").key("enum").array();
      for (const std::string_view name : names(example)) json_.value(name);
      json_.end_array();
    } else if constexpr (OptionalLeg<T>) {
      json_.key("type").array().value("string").value("null").end_array();
    } else if constexpr (std::same_as<T, Quat>) {
      array(0.0, 4);
    } else if constexpr (Matrix<T>) {
      if constexpr (T::ColsAtCompileTime == 1) {
        array(0.0, T::RowsAtCompileTime);  // Dynamic, −1: the robot says how many
      } else {
        array(Eigen::Vector<double, T::ColsAtCompileTime>(), T::RowsAtCompileTime);
      }
    } else if constexpr (kIsPerLeg<T>) {
      json_.member("type", "object").key("properties").object();
      for (const std::string_view leg : leg_names(num_legs_)) (*this)(leg, example[0], "");
      json_.end_object();
    } else if constexpr (kIsList<T>) {
      array(typename T::value_type(), -1);
    } else {
      json_.member("type", "object").key("properties").object();
      fields(*this, example);
      json_.end_object();
    }
  }

  template <typename T>
  void array(const T& element, int count) {
    json_.member("type", "array").key("items");
    schema(element, "", "");
    if (count >= 0) json_.member("minItems", count).member("maxItems", count);
  }

  logging::JsonText json_;
  int num_legs_;
};

/// Appends a signal's JSON message.
template <typename T>
void encode(const T& signal, std::string& out) {
  Encoder(out).value(signal);
}

/// JSON schema of a signal's messages.
template <typename T>
[[nodiscard]] std::string schema(std::string_view title, std::string_view description = "",
                                 int num_legs = kNumLegs) {
  std::string out;
  SchemaWriter(out, num_legs).schema(T(), title, description);
  return out;
}

}  // namespace surefoot::logged
