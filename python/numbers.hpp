#pragma once

#include "surefoot/base/error.hpp"
#include "surefoot/base/formatted.hpp"
#include "surefoot/signals/leg.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace surefoot::python {

namespace nb = nanobind;

/// A NumPy array that looks into a struct; it keeps the struct's Python object alive.
template <long... kSizes>
using View = nb::ndarray<nb::numpy, double, nb::shape<kSizes...>>;

/// Throws Error on a NaN or an infinity in a command.
inline void check_finite(double value, const std::string& name) {
  if (!std::isfinite(value)) {
    throw Error(name + " is " + std::to_string(value) + "; a finite number would be valid");
  }
}

/// Writes numbers over a vector of the same length. `finite`: refuses others.
template <typename Vector>
void assign(Vector& values, const std::vector<double>& numbers, const std::string& name,
            bool finite) {
  if (static_cast<Eigen::Index>(numbers.size()) != values.size()) {
    throw Error(name + " has " + std::to_string(values.size()) + " numbers; " +
                std::to_string(numbers.size()) + " were given");
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (finite) check_finite(numbers[i], name + "[" + std::to_string(i) + "]");
  }
  std::ranges::copy(numbers, values.data());
}

/// Of w, x, y, z, which must have length 1.
inline Quat quaternion(const std::vector<double>& numbers, const std::string& name) {
  Eigen::Vector4d wxyz;
  assign(wxyz, numbers, name, true);
  if (std::abs(wxyz.norm() - 1.0) > 1e-3) {
    throw Error(name + formatted(" has the length %g", wxyz.norm()) +
                "; a quaternion w, x, y, z of length 1 would be valid");
  }
  return Quat(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized();
}

/// A read-write array over a matrix of the object `self`.
template <typename Matrix>
auto view(Matrix& values, nb::handle self) {
  if constexpr (Matrix::ColsAtCompileTime == 1) {
    return View<-1>(values.data(), {static_cast<std::size_t>(values.size())}, self);
  } else {
    const auto rows = static_cast<std::size_t>(values.rows());
    return View<-1, -1>(values.data(), {rows, static_cast<std::size_t>(values.cols())}, self,
                        {1, static_cast<std::int64_t>(rows)});
  }
}

/// A property that looks at a member of a struct.
template <typename Struct, typename Matrix>
void def_view(nb::class_<Struct>& type, const char* name, Matrix Struct::* member,
              const char* doc) {
  type.def_prop_ro(
      name,
      [member](nb::handle_t<Struct> self) {
        return view(nb::inst_ptr<Struct>(self)->*member, self);
      },
      doc);
}

}  // namespace surefoot::python
