#pragma once

// Files: scenarios, robots and stacks, read and checked.

#include "surefoot/config/robot_file.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/config/stack_file.hpp"
