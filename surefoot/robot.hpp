#pragma once

// The port that a driver implements: sensor readings in, joint torques out.

#include "surefoot/robot/robot_port.hpp"
