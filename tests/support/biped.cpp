#include "tests/support/biped.hpp"

#include "surefoot/config/robot_file.hpp"

namespace surefoot::test {

model::RobotDescription biped() { return config::load_robot("g1"); }

}  // namespace surefoot::test
