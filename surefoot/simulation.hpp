#pragma once

// The simulated robot, a port like that of a real one, with its true state, and how plan and
// estimate are compared with it.

#include "surefoot/evaluation/alignment.hpp"
#include "surefoot/simulation/plant.hpp"
