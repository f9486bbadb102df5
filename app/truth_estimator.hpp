#pragma once

#include "surefoot/simulation/truth_estimator.hpp"
