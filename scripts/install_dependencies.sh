#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the Debian 12 packages that are missing. Uses sudo only when not root.
#   --workflows   also Snakemake and Slurm, for workflows/ and its tests; without them those tests are skipped
#   --developer   also clang, its tools, and gcovr: sanitizers, fuzzers, coverage, format
set -euo pipefail

packages=(
  # tools
  g++ cmake ninja-build pkg-config
  # geometry, poses, logs, scenes
  libeigen3-dev libmrpt-poses-dev libmrpt-system-dev libmrpt-containers-dev
  libmrpt-obs-dev libmrpt-maps-dev libmrpt-opengl-dev
  # maps and search
  liboctomap-dev libnanoflann-dev libboost-dev libtbb-dev libmimalloc-dev
  # command line, configuration, files
  libcli11-dev libsimpleini-dev libyaml-cpp-dev nlohmann-json3-dev libssl-dev libpng-dev zlib1g-dev
  # the simulated sensor
  libembree-dev libassimp-dev
  # point clouds of other formats
  libopen3d-dev
  # the Python package, and its tests and example
  pybind11-dev python3-dev python3-numpy python3-pytest python3-matplotlib
  # pictures without a display
  libegl1 libgl1-mesa-dri
  # manual pages are tried with man
  man-db
  # tests; octomap-tools, mrpt-apps, pcl-tools, python3-yaml and chromium open our results
  libgtest-dev octomap-tools mrpt-apps pcl-tools xvfb python3-yaml python3-pil chromium
  # the reference of the libraries
  doxygen
  # benchmarks, and plots of the experiments
  libbenchmark-dev gnuplot-nox
)
# The page of reports is bundled from packages of npm, and tests use some; it brings many packages where it is not there in some other way.
command -v npm >/dev/null || packages+=(nodejs npm)

for option in "$@"; do
  case $option in
    --workflows) packages+=(snakemake slurm-wlm munge) ;;
    --developer) packages+=(clang clang-format clang-tidy gcovr) ;;
    *) echo "install_dependencies.sh: unknown option $option" >&2; exit 2 ;;
  esac
done

missing=()
for package in "${packages[@]}"; do
  dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null | grep -qx installed ||
    missing+=("$package")
done
if [ "${#missing[@]}" -eq 0 ]; then
  echo "all packages are installed"
else
  as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(sudo)
  echo "installing: ${missing[*]}"
  export DEBIAN_FRONTEND=noninteractive
  "${as_root[@]}" apt-get update -q
  "${as_root[@]}" apt-get install -y -q --no-install-recommends "${missing[@]}"
fi

# Anew only when the lock file is newer than what was installed by it.
npm_packages() {  # FOLDER, and what is missing without them
  [ ! "$1/node_modules/.package-lock.json" -nt "$1/package-lock.json" ] || return 0
  npm ci --prefix "$1" --no-audit --no-fund || echo "install_dependencies.sh: npm ci failed: $2" >&2
}
root=$(dirname "$0")/..
npm_packages "$root/libs/report/web" "hoctomap report will say that it is missing"
npm_packages "$root/tests/gltf" "the test that validates glTF files will be skipped"
npm_packages "$root/tests/report" "the tests of reports in a browser will be skipped"
