#include "surefoot/solver/level_timer.hpp"
#include "surefoot/solver/sweep.hpp"
#include "surefoot/solver/tolerances.hpp"

#define SUREFOOT_PACK 2
#define SUREFOOT_ISA_NAME "baseline"
namespace surefoot::solver {
namespace {
namespace baseline {
#include "surefoot/solver/sweep_kernels.inl"
}  // namespace baseline
}  // namespace
}  // namespace surefoot::solver
#undef SUREFOOT_PACK
#undef SUREFOOT_ISA_NAME

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define SUREFOOT_DISPATCH
#pragma GCC push_options
#pragma GCC target("avx2,fma")
#define SUREFOOT_PACK 4
#define SUREFOOT_ISA_NAME "avx2"
namespace surefoot::solver {
namespace {
namespace avx2 {
#include "surefoot/solver/sweep_kernels.inl"
}  // namespace avx2
}  // namespace
}  // namespace surefoot::solver
#undef SUREFOOT_PACK
#undef SUREFOOT_ISA_NAME
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx512f,avx512vl,avx512dq,avx2,fma")
#define SUREFOOT_PACK 8
#define SUREFOOT_ISA_NAME "avx512"
namespace surefoot::solver {
namespace {
namespace avx512 {
#include "surefoot/solver/sweep_kernels.inl"
}  // namespace avx512
}  // namespace
}  // namespace surefoot::solver
#pragma GCC pop_options
#endif

namespace surefoot::solver {

std::vector<const SweepKernels*> all_kernels() {
  std::vector<const SweepKernels*> all{&baseline::kKernels};
#if defined(SUREFOOT_DISPATCH)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    all.push_back(&avx2::kKernels);
  }
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq")) {
    all.push_back(&avx512::kKernels);
  }
#endif
  return all;
}

const SweepKernels& fastest_kernels() { return *all_kernels().back(); }

}  // namespace surefoot::solver
