#include "python/own_parts.hpp"

#include <nanobind/stl/string.h>

#include <string>

namespace surefoot::python {

void check_update(nb::handle object, nb::handle base, bool asks_library, const char* takes) {
  const std::string name = text_of(object.type().attr("__name__"));
  const nb::object update = object.attr("update");
  const nb::object function = nb::getattr(update, "__func__", update);
  if (function.is(base.attr("update"))) {
    if (asks_library) return;
    throw Error(name + " has no update(self, " + takes + ")");
  }
  nb::module_::import_("surefoot._arguments").attr("check_takes")(name + ".update", update, takes);
}

}  // namespace surefoot::python
