#pragma once

#include "python/in_python.hpp"
#include "python/parts.hpp"

#include <functional>
#include <memory>

namespace surefoot::python {

/// A base class in Python that can ask the library's part, which is made anew with each controller.
template <typename Part>
struct BoundPart {
  std::function<std::unique_ptr<Part>()> make;
  std::unique_ptr<Part> library = make ? make() : nullptr;
};

/// Throws Error if the object has no update() of its own, and no library's to ask, or one that
/// takes other arguments. `takes`: what is valid.
void check_update(nb::handle object, nb::handle base, bool asks_library, const char* takes);

/// Before a controller takes it: what it remembers of another run is gone.
template <typename Bound>
void begin_anew(const SharedObject& object, const char* takes) {
  const nb::gil_scoped_acquire python;
  if (nb::inst_check(*object) && !nb::inst_ready(*object))
    throw Error(text_of((*object).type().attr("__name__")) +
                ".__init__ must call super().__init__() first");
  Bound* base = nullptr;
  (void)nb::try_cast<Bound*>(*object, base);
  check_update(*object, nb::type<Bound>(), base != nullptr && base->make, takes);
  (*object).attr("restart")();
  if (base != nullptr && base->make) base->library = base->make();
}

}  // namespace surefoot::python
