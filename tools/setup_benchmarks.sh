#!/usr/bin/env bash
# Brings the solvers of dependencies/benchmark.txt into build/peers and configures the build again,
# so that benchmarks/solver measures them beside ours. Neither ./test nor ./demo needs any of it.
#   bash tools/setup_benchmarks.sh && ninja -C build/release benchmark_solver
source "$(dirname "$(realpath "${BASH_SOURCE[0]}")")/setup.sh"
peers=$root/build/peers

install_peers() {
  local stamp=$peers/dependencies.stamp state name kind
  state=$(sha256sum <"$root/dependencies/benchmark.txt")
  [[ -f $stamp && $(<"$stamp") == "$state" ]] && return 0
  start_log
  echo "setup: installing the solvers to compare with into build/peers"
  rm -rf "$peers"
  mkdir -p "$peers/sources"
  local -a pip=("$venv/bin/python" -m pip --disable-pip-version-check --no-input)
  while read -r name kind; do
    if [[ $kind == source ]]; then
      "${pip[@]}" download --no-deps --no-binary "${name%%=*}" --dest "$peers/sources" "$name" >>"$log" 2>&1 &&
        tar -xzf "$peers/sources/${name/==/-}.tar.gz" -C "$peers/sources"
    else
      "${pip[@]}" download --no-deps --only-binary :all: --dest "$peers/wheels" "$name" >>"$log" 2>&1
    fi || echo "setup: $name could not be downloaded and is left out (the reason is in $log)"
  done < <(listed benchmark.txt)
  local wheel
  for wheel in "$peers"/wheels/*.whl; do
    [[ -f $wheel ]] && "$venv/bin/python" -m zipfile -e "$wheel" "$peers/site"
  done
  echo "$state" >"$stamp"
}

set_up
install_peers
cmake -S "$root" --preset release | grep -i "peers" || true
