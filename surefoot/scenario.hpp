#pragma once

// Files: scenarios, robots and stacks, read and checked; their options, as a list and as a schema.

#include "surefoot/config/json_schema.hpp"
#include "surefoot/config/option_list.hpp"
#include "surefoot/config/robot_file.hpp"
#include "surefoot/config/scenario_file.hpp"
#include "surefoot/config/stack_file.hpp"
