// All kernels, for packs of SUREFOOT_PACK doubles. Included once for each instruction set, in its
// own namespace.

#include "surefoot/solver/kernel_packs.inl"
//
#include "surefoot/solver/kernel_basis.inl"
#include "surefoot/solver/kernel_factorization.inl"
#include "surefoot/solver/kernel_rows.inl"
#include "surefoot/solver/kernel_tableau.inl"

constexpr SweepKernels kKernels{.name = SUREFOOT_ISA_NAME,
                                .pack = kPack,
                                .measure = measure,
                                .read_sides = read_sides,
                                .has_violated = has_violated,
                                .judge_rows = judge_rows,
                                .start = start,
                                .start_leading = start_leading,
                                .run_together = run_together,
                                .run = run,
                                .fix = fix,
                                .fill_tableau = fill_tableau,
                                .turn = turn,
                                .rotate = rotate,
                                .gather = gather,
                                .move = move,
                                .longest_step = longest_step,
                                .advance = advance,
                                .reduce = reduce,
                                .project = project,
                                .turn_back = turn_back,
                                .recover = recover,
                                .evaluate = evaluate,
                                .factorize_last = factorize_last,
                                .balance = balance,
                                .balance_norm = balance_norm};

#undef SUREFOOT_INLINE
