#pragma once

#include "python/bindings.hpp"
#include "python/numbers.hpp"
#include "surefoot/evaluation/alignment_fields.hpp"  // fields() must be known where signal() calls it
#include "surefoot/evaluation/truth_fields.hpp"
#include "surefoot/logging/message_decoder.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace surefoot::python {

/// An event, with what names its leg.
struct NamedEvent : GaitEvent {
  int num_legs = kNumLegs;
};

/// "joint positions [rad]" → "joint positions [rad], shape (number of joints,)"
inline std::string with_shape(std::string_view description, const std::string& shape) {
  return std::string(description) + ", shape (" + shape + ")";
}

/// "time of the tick [s]" → "s"
inline std::string unit_in(std::string_view description) {
  const std::size_t begin = description.rfind('[');
  if (begin == std::string_view::npos) return {};
  return std::string(description.substr(begin + 1, description.rfind(']') - begin - 1));
}

inline void append(FrameList& list, const FramePlan& frame) {
  if (list.count == FrameList::kMost)
    throw Error("a plan has at most " + std::to_string(FrameList::kMost) + " frames");
  list.add(frame);
}

/// Gives a class one property for each field of its struct, by the functions `fields` that also
/// define the log: the same names, units and frames, written down once.
///
/// Vectors and matrices become arrays that look into the struct, without a copy; what belongs to
/// legs has a first axis, or is a dict, over the robot's legs.
template <typename T>
class FieldProperties {
 public:
  FieldProperties(nb::class_<T>& type, const T& example) : type_(type), example_(example) {}

  template <typename Member>
  void operator()(std::string_view name, const Member& member, std::string_view description) {
    const auto offset =
        reinterpret_cast<const char*>(&member) - reinterpret_cast<const char*>(&example_);
    add(name.data(), Place<Member>{offset}, std::string(description));
    names_.push_back(name.data());
    units_.push_back(unit_in(description));
  }

  /// "UserCommand(walk=True, velocity=[0.1 0. ], …)"; of times "TickTiming(time=1.5 s, …)".
  void add_text(const std::string& type_name) {
    constexpr bool kHasUnits = std::is_same_v<T, TickTiming>;
    type_.def("__repr__", [type_name, names = names_, units = units_](nb::handle self) {
      std::string text;
      for (std::size_t i = 0; i < names.size(); ++i) {
        const nb::object value = self.attr(names[i]);
        const bool is_array = nb::hasattr(value, "shape");
        text += (text.empty() ? "" : ", ") + std::string(names[i]) + "=";
        text += nb::cast<std::string>(is_array ? nb::str(value) : nb::repr(value));
        if (kHasUnits) text += " " + units[i];
      }
      return type_name + "(" + text + ")";
    });
  }

 private:
  using Self = nb::handle_t<T>;

  /// Where a member lies in the struct.
  template <typename Member>
  struct Place {
    std::ptrdiff_t offset;
    Member& in(nb::handle self) const {
      return *reinterpret_cast<Member*>(reinterpret_cast<char*>(nb::inst_ptr<T>(self)) + offset);
    }
  };

  static constexpr bool kIsCommand =
      std::is_base_of_v<UserCommand, T> || std::is_same_v<T, JointCommand>;

  /// Lets `command.velocity = [0.1, 0]` write into the vector.
  template <typename Vector>
  static auto setter(const char* name, Place<Vector> place) {
    return [name, place](Self self, const std::vector<double>& numbers) {
      assign(place.in(self), numbers, name, kIsCommand);
    };
  }

  template <typename Member>
    requires logged::Number<Member>
  void add(const char* name, Place<Member> place, const std::string& doc) {
    const auto set = [place, name](Self self, Member value) {
      if constexpr (kIsCommand && std::is_floating_point_v<Member>) check_finite(value, name);
      place.in(self) = value;
    };
    type_.def_prop_rw(name, [place](Self self) { return place.in(self); }, set, doc.c_str());
  }

  template <typename Member>
    requires logged::Name<Member>
  void add(const char* name, Place<Member> place, const std::string& doc) {
    const auto get = [place](Self self) {
      const Member value = place.in(self);
      return logged::names(value)[static_cast<std::size_t>(value)];
    };
    std::string valid;
    for (const std::string_view text : logged::names(Member())) {
      valid += (valid.empty() ? "" : ", ") + std::string(text);
    }
    const auto set = [place, name, valid](Self self, const std::string& word) {
      const auto names = logged::names(Member());
      const auto found = std::ranges::find(names, std::string_view(word));
      if (found == names.end())
        throw UnknownNameError(std::string(name) + " is \"" + word + "\"; valid are: " + valid);
      place.in(self) = static_cast<Member>(found - names.begin());
    };
    type_.def_prop_rw(name, get, set, (doc + (doc.empty() ? "" : ": ") + valid).c_str());
  }

  void add(const char* name, Place<PlanEvent> place, const std::string& doc) {
    const auto get = [place](Self self) { return static_cast<int>(place.in(self)); };
    type_.def_prop_ro(name, get, doc.c_str());
  }

  void add(const char* name, Place<std::optional<Leg>> place, const std::string& doc) {
    const auto get = [place](Self self) -> std::optional<std::string_view> {
      const std::optional<Leg> leg = place.in(self);
      if (!leg) return {};
      return leg_name(*leg, nb::inst_ptr<T>(self)->num_legs);
    };
    type_.def_prop_ro(name, get, doc.c_str());
  }

  void add(const char* name, Place<EventList> place, const std::string& doc) {
    const auto get = [place](Self self) {
      std::vector<NamedEvent> events;
      for (const GaitEvent& event : place.in(self))
        events.push_back({event, static_cast<int>(nb::inst_ptr<T>(self)->feet.size())});
      return events;
    };
    type_.def_prop_ro(name, get, doc.c_str());
  }

  void add(const char* name, Place<FrameList> place, const std::string& doc) {
    const auto get = [place](Self self) -> FrameList& { return place.in(self); };
    const auto set = [place](Self self, const std::vector<FramePlan>& frames) {
      FrameList list;
      for (const FramePlan& frame : frames) append(list, frame);
      place.in(self) = list;
    };
    type_.def_prop_rw(name, get, set, nb::for_getter(nb::rv_policy::reference_internal),
                      doc.c_str());
  }

  /// A copy, because the order in memory is x, y, z, w; read-only, so that nobody writes into it.
  void add(const char* name, Place<Quat> place, const std::string& doc) {
    const auto get = [place](Self self) {
      const Quat& q = place.in(self);
      auto* copy = new double[4]{q.w(), q.x(), q.y(), q.z()};
      const nb::capsule owner(copy,
                              [](void* data) noexcept { delete[] static_cast<double*>(data); });
      return nb::ndarray<nb::numpy, const double, nb::shape<4>>(copy, {4}, owner);
    };
    const auto set = [place, name](Self self, const std::vector<double>& numbers) {
      place.in(self) = quaternion(numbers, name);
    };
    type_.def_prop_rw(name, get, set, nb::for_getter(nb::rv_policy::automatic),
                      with_shape(doc, "4,").c_str());
  }

  template <int kRows>
  void add(const char* name, Place<Eigen::Matrix<double, kRows, 1>> place, const std::string& doc) {
    const auto get = [place](Self self) {
      return View<kRows>(place.in(self).data(), {kRows}, self);
    };
    type_.def_prop_rw(name, get, setter(name, place),
                      with_shape(doc, std::to_string(kRows) + ",").c_str());
  }

  void add(const char* name, Place<JointVector> place, const std::string& doc) {
    const auto get = [place](Self self) {
      JointVector& values = place.in(self);
      return View<-1>(values.data(), {static_cast<std::size_t>(values.size())}, self);
    };
    const auto set = [name, place](Self self, const std::vector<double>& numbers) {
      JointVector& values = place.in(self);
      if (values.size() == 0 && numbers.size() <= kMaxJoints)
        values.resize(static_cast<Eigen::Index>(numbers.size()));
      assign(values, numbers, name, kIsCommand);
    };
    type_.def_prop_rw(name, get, set, with_shape(doc, "number of joints,").c_str());
  }

  void add(const char* name, Place<Mat3> place, const std::string& doc) {
    const auto get = [place](Self self) {
      return View<3, 3>(place.in(self).data(), {3, 3}, self, {1, 3});
    };
    type_.def_prop_ro(name, get, with_shape(doc, "3, 3").c_str());
  }

  void add(const char* name, Place<PerLeg<double>> place, const std::string& doc) {
    const auto get = [place](Self self) {
      PerLeg<double>& values = place.in(self);
      return View<-1>(values.data(), {values.size()}, self);
    };
    const auto set = [place, name](Self self, const std::vector<double>& numbers) {
      PerLeg<double>& values = place.in(self);
      Eigen::Map<Eigen::VectorXd> legs(values.data(), static_cast<Eigen::Index>(values.size()));
      assign(legs, numbers, name, false);
    };
    type_.def_prop_rw(name, get, set, with_shape(doc, "number of legs,").c_str());
  }

  void add(const char* name, Place<PerLeg<Vec3>> place, const std::string& doc) {
    const auto get = [place](Self self) {
      PerLeg<Vec3>& values = place.in(self);
      return View<-1, 3>(values[0].data(), {values.size(), 3}, self);
    };
    type_.def_prop_ro(name, get, with_shape(doc, "number of legs, 3").c_str());
  }

  void add(const char* name, Place<std::vector<double>> place, const std::string& doc) {
    const auto get = [place](Self self) {
      std::vector<double>& values = place.in(self);
      return View<-1>(values.data(), {values.size()}, self);
    };
    type_.def_prop_ro(name, get, doc.c_str());
  }

  template <typename Struct>
  void add(const char* name, Place<PerLeg<Struct>> place, const std::string& doc) {
    const auto get = [place](Self self) {
      nb::typed<nb::dict, std::string, Struct> legs;
      PerLeg<Struct>& values = place.in(self);
      for (const Leg leg : values.legs()) {
        legs[nb::cast(leg_name(leg, static_cast<int>(values.size())))] =
            nb::cast(&values[index(leg)], nb::rv_policy::reference_internal, self);
      }
      return legs;
    };
    type_.def_prop_ro(name, get, doc.c_str());
  }

  template <typename Struct>
    requires std::is_class_v<Struct>
  void add(const char* name, Place<Struct> place, const std::string& doc) {
    const auto get = [place](Self self) -> Struct& { return place.in(self); };
    const auto set = [place](Self self, const Struct& value) { place.in(self) = value; };
    type_.def_prop_rw(name, get, set, nb::for_getter(nb::rv_policy::reference_internal),
                      doc.c_str());
  }

  nb::class_<T>& type_;
  const T& example_;
  std::vector<const char*> names_;
  std::vector<std::string> units_;
};

/// Of a signal whose members include lists per leg.
struct LegCounter {
  int num_legs = kNumLegs;
  template <typename Member>
  void operator()(std::string_view, const Member& member, std::string_view) {
    if constexpr (logged::kIsPerLeg<Member>) num_legs = static_cast<int>(member.size());
  }
};

/// Lets `copy` copy it, and `pickle` send it to another process, as the message of a log.
template <typename T, typename Described>
void add_copies(nb::class_<T>& type) {
  type.def("__copy__", [](const T& self) { return self; })
      .def("__deepcopy__", [](const T& self, nb::handle) { return self; });
  if constexpr (std::is_same_v<T, Described>) {
    type.def("__getstate__", [](const T& self) {
      LegCounter counter;
      logged::fields(counter, self);
      std::string message;
      logged::encode(self, message);
      return std::make_pair(counter.num_legs, message);
    });
    type.def("__setstate__", [](T& self, const std::pair<int, std::string>& state) {
      T made{};
      logged::Decoder::decode(state.second, made, state.first);
      new (&self) T(std::move(made));
    });
  }
}

/// A class for a signal, with all fields of what the log describes.
template <typename T, typename Described = T>
nb::class_<T> signal(nb::module_& module, const char* name, const char* doc) {
  nb::class_<T> type(module, name, doc, nb::type_slots(kNoVectorcall));
  const T example{};
  FieldProperties<T> properties(type, example);
  logged::fields(properties, static_cast<const Described&>(example));
  properties.add_text(name);
  add_copies<T, Described>(type);
  return type;
}

}  // namespace surefoot::python
