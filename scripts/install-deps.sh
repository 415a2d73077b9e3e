#!/usr/bin/env bash
# Installs the Debian 12 packages of the named groups, and does nothing at all if they are there already.
# usage: install-deps.sh [build] [python] [package] [docs] [bench] [dev] [sanitizers] [clients]
set -euo pipefail

build=(g++ cmake ninja-build libeigen3-dev libtbb-dev libfmt-dev nlohmann-json3-dev libcli11-dev libtomlplusplus-dev
       libocct-data-exchange-dev libgtest-dev python3 libcpp-httplib-dev)
# The Python module and its tests; a build without them leaves it out.
python=(pybind11-dev python3-dev python3-numpy python3-pytest python3-hypothesis mypy)
package=(dpkg-dev file python3-wheel)
docs=(python3-sphinx furo python3-myst-parser python3-breathe doxygen)
bench=(libbenchmark-dev libembree-dev libfcl-dev)
dev=(clang-format clang-tidy)
# What Clang instruments compiles faster than what GCC does, and runs twice as fast.
sanitizers=(clang libclang-rt-14-dev lld llvm)
clients=(chromium freecad-python3 xvfb xauth linuxcnc-uspace slurm-wlm munge coinor-cbc)
# Node.js and npm bundle the report page; a newer one from elsewhere will do, and then the packages would get in its way.
command -v node > /dev/null || build+=(nodejs)
command -v npm > /dev/null || build+=(npm)

wanted=()
for group in "${@:-build}"; do
  case $group in
    build) wanted+=("${build[@]}") ;;
    python) wanted+=("${python[@]}") ;;
    package) wanted+=("${package[@]}") ;;
    docs) wanted+=("${docs[@]}") ;;
    bench) wanted+=("${bench[@]}") ;;
    dev) wanted+=("${dev[@]}") ;;
    sanitizers) wanted+=("${sanitizers[@]}") ;;
    clients) wanted+=("${clients[@]}") ;;
    *) echo "install-deps.sh: unknown group '$group' (build, python, package, docs, bench, dev, sanitizers, clients)" >&2; exit 2 ;;
  esac
done

if ! command -v dpkg-query > /dev/null; then
  echo "This is not Debian: install the equivalents of ${wanted[*]}; going on without."
  exit 0
fi

missing=()
for package in "${wanted[@]}"; do
  state=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2> /dev/null || true)
  [[ $state == installed ]] || missing+=("$package")
done
[[ ${#missing[@]} -eq 0 ]] && exit 0

as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo > /dev/null; then
    echo "Missing packages, and neither root nor sudo to install them: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

echo "Installing ${missing[*]}"
"${as_root[@]}" apt-get update --quiet
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install --yes --quiet --no-install-recommends "${missing[@]}"
