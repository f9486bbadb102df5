#pragma once

// Strict hierarchies of linear rows: their optimum, its proof, and what each level costs the
// others. Needs Eigen alone.

#include "surefoot/solver/certificate.hpp"
#include "surefoot/solver/explanation.hpp"
#include "surefoot/solver/lexicographic_solver.hpp"
