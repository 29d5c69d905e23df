# Sourced by the other tools: installs the Debian packages of a purpose, and builds what it needs.
# Purposes: program (with the viewer), python, mpi, bench, comparisons (bench beside other libraries), tests.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
purposes=(program python mpi bench comparisons tests)

expect_purposes() {
  local purpose
  for purpose in "$@"; do
    [[ " ${purposes[*]} " == *" $purpose "* ]] || { echo "error: there is no purpose \"$purpose\"; purposes: ${purposes[*]}" >&2; exit 2; }
  done
}

# packages_of PURPOSE...: those of the program, which every purpose needs, and their own. Benchmarks need no others.
packages_of() {
  local purpose
  for purpose in program "$@"; do
    if [ -f "tools/packages/$purpose.txt" ]; then cat "tools/packages/$purpose.txt"; fi
  done | sort -u
}

missing_packages() {
  comm -23 <(packages_of "$@") <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' | sed -n 's/^installed //p' | sort -u)
}

as_root() {
  if [ "$(id -u)" -eq 0 ]; then "$@"
  elif command -v sudo > /dev/null; then sudo "$@"
  else
    echo "error: installing packages needs root, and there is no sudo; as root, run: apt-get install $missing" >&2
    exit 1
  fi
}

install_packages() {
  if ! command -v apt-get > /dev/null; then
    echo "warning: this is no Debian system; install what tools/packages names by hand: $(packages_of "$@" | tr '\n' ' ')" >&2
    return
  fi
  missing=$(missing_packages "$@" | tr '\n' ' ')
  [ -z "$missing" ] && return
  echo "Installing $missing"
  as_root apt-get update || echo "warning: the package lists could not be renewed" >&2
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends $missing
}

# build PRESET PURPOSE...: builds them in build/PRESET. What an earlier call built there stays part of the build.
build() {
  local preset=$1 wanted=" ${*:2} " options=()
  if [ ! -f "build/$preset/build.ninja" ]; then options=(-DPLIANT_BUILD_BENCH=OFF -DPLIANT_BUILD_TESTS=OFF); fi
  if [[ $wanted =~ \ (bench|comparisons|tests)\  ]]; then options+=(-DPLIANT_BUILD_BENCH=ON); fi
  if [[ $wanted == *" tests "* ]]; then options+=(-DPLIANT_BUILD_TESTS=ON); fi
  if [[ $wanted == *" python "* ]]; then options+=(-DPLIANT_PYTHON=ON); fi
  if [[ $wanted == *" mpi "* ]]; then options+=(-DPLIANT_MPI=ON); fi
  cmake --preset "$preset" "${options[@]}"
  cmake --build --preset "$preset"
}
