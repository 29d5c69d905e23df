# Sourced by tools/demo and tools/test: installs the Debian packages that are missing, and builds a preset.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

missing_packages() {
  comm -23 <(sort tools/packages.txt) \
           <(dpkg-query -W -f '${db:Status-Status} ${Package}\n' | sed -n 's/^installed //p' | sort -u)
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
    echo "warning: this is no Debian system; install what tools/packages.txt names by hand" >&2
    return
  fi
  missing=$(missing_packages | tr '\n' ' ')
  [ -z "$missing" ] && return
  echo "Installing $missing"
  as_root apt-get update || echo "warning: the package lists could not be renewed" >&2
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install --yes --no-install-recommends $missing
}

# build PRESET [CMAKE --BUILD ARGS]: configures and builds it in build/PRESET.
build() {
  if [ ! -f "build/$1/build.ninja" ]; then cmake --preset "$1"; fi
  cmake --build --preset "$@"
}
