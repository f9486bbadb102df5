#include "python/in_python.hpp"

#include <nanobind/stl/string.h>

#include <exception>
#include <string>

namespace surefoot::python {

std::string text_of(const nb::object& object) {
  return nb::cast<std::string>(nb::str(nb::handle(object)));
}

namespace {

/// Also of an exception whose own text fails.
std::string what(const nb::python_error& error) {
  try {
    return text_of(nb::borrow<nb::object>(error.value()));
  } catch (const std::exception&) {
    return "its text can't be read";
  }
}

}  // namespace

std::string one_line(const nb::python_error& error) {
  const std::string name = text_of(error.type().attr("__name__"));
  const std::string what = python::what(error);
  if (!error.traceback().is_valid()) return name + ": " + what;  // raised by C
  const nb::object frames = nb::module_::import_("traceback").attr("extract_tb")(error.traceback());
  if (nb::len(frames) == 0) return name + ": " + what;
  // The innermost one in the user's file: where a library raised helps less.
  const std::string file = text_of(nb::object(frames[0]).attr("filename"));
  nb::object last = frames[0];
  for (const nb::handle frame : frames)
    if (text_of(frame.attr("filename")) == file) last = nb::borrow(frame);
  return name + ": " + what + " (" + file.substr(file.rfind('/') + 1) + ", line " +
         text_of(last.attr("lineno")) + ")";
}

std::string wrong_result(nb::handle object, const char* method, nb::handle result,
                         const std::string& valid) {
  return text_of(object.type().attr("__name__")) + "." + method + " returned " +
         text_of(nb::repr(result)) + "; " + valid + " would be valid";
}

}  // namespace surefoot::python
