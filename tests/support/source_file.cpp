#include "tests/support/source_file.hpp"

namespace surefoot::test {

std::string source_file(const std::string& name) { return SUREFOOT_SOURCE_DIR "/" + name; }

}  // namespace surefoot::test
