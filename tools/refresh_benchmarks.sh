#!/usr/bin/env bash
# Measures the solver again and writes all figures of docs/benchmarks.md: goals, table and plot; those of each solver go
# into docs/results/solver.csv. Prints the line of docs/results.md about the solver. Leave the machine alone meanwhile.
#   bash tools/setup_benchmarks.sh          # once: the solvers to compare with
#   bash tools/refresh_benchmarks.sh [OPTIONS OF benchmark_solver]
set -euo pipefail
root=$(dirname "$(dirname "$(realpath "${BASH_SOURCE[0]}")")")
build=$root/build/release
ninja -C "$build" benchmark_solver
read -r load _ </proc/loadavg
[[ ${load%.*} -lt 1 ]] || echo "refresh_benchmarks: the machine is busy (load $load): read the ratios, not the times" >&2
[[ $# -gt 0 ]] || set -- --problems 100 --ticks 300 --passes 6
limit() { timeout --foreground "$@" || { echo "refresh_benchmarks: not done within $1; nothing was written" >&2; exit 1; }; }
limit 18m "$build/benchmark_solver" --json "$root/build/solver.json" "$@"
limit 6m "$build/benchmark_solver" --growth --passes 4 --json "$root/build/growth.json"
python3 "$root/tools/solver_benchmark_table.py" "$root/build/solver.json" "$root/build/growth.json" "$root/docs/benchmarks.md" \
  "$root/docs/results/solver.csv"
python3 "$root/tools/plot_solver_growth.py" "$root/build/growth.json" "$root/docs/images/solver_growth.svg"
