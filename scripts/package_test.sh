#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the Debian packages, checks them with lintian, installs them in a clean Debian 12 made by debootstrap, and uses
# them there: no compiler, no source. Then a small project is built against the development package. Needs root.
#   scripts/package_test.sh [BUILD_FOLDER]      default: build/release, which is configured and built as needed
# The mirror is the one that apt uses.
set -euo pipefail
cd "$(dirname "$0")/.."
build=${1:-build/release}
work=out/package_test
root=$work/root

scripts/install_dependencies.sh
export DEBIAN_FRONTEND=noninteractive
apt-get install -y -q --no-install-recommends debootstrap lintian dpkg-dev man-db >/dev/null

echo "== packages"
[ -f "$build/CMakeCache.txt" ] || cmake --preset release >/dev/null
rm -rf "$build/packages"
cmake --build "$build" --parallel "$(nproc)" --target packages
mkdir -p "$work"
ls -l "$build"/packages/*.deb

echo "== every public header by itself"
[ -n "${HOCTOMAP_SKIP_HEADERS:-}" ] || cmake --build "$build" --parallel "$(nproc)" --target all_verify_interface_header_sets

echo "== lintian"
lintian --allow-root --fail-on error "$build"/packages/*.deb

echo "== a clean Debian 12"
rm -rf "$root"
mirror=$(apt-get indextargets --format '$(REPO_URI)' 'Created-By: Packages' 'Codename: bookworm' | head -n 1)
debootstrap --variant=minbase bookworm "$root" "$mirror" >"$work/debootstrap.log"

# What apt would install there is fetched from here, so that the root needs no network, and installed by its own apt.
install_in_root() {
  apt-get -y -q --no-install-recommends --download-only -o Dir::State::status="$PWD/$root/var/lib/dpkg/status" \
    -o Dir::Cache::archives="$PWD/$root/var/cache/apt/archives" install "$@" >"$work/fetch.log"
  for file in "$@"; do
    [ ! -f "$file" ] || cp "$file" "$root/var/cache/apt/archives/"
  done
  in_root 'apt-get install -y -q --no-install-recommends /var/cache/apt/archives/*.deb && rm /var/cache/apt/archives/*.deb' \
    >"$work/install.log" 2>&1
}
in_root() {
  unshare --mount --fork bash -c 'mount -t proc proc "$1/proc" && exec chroot "$1" bash -euo pipefail -c "$2"' - "$root" "$1"
}

echo "== install and use"
install_in_root ./"$build"/packages/hoctomap_*.deb ./"$build"/packages/python3-hoctomap_*.deb
in_root '
for tool in cc g++ cmake make ninja; do
  if command -v $tool; then echo "a build tool is there"; exit 1; fi
done
cd /tmp
hoctomap simulate -q -c /usr/share/hoctomap/configs/scenes/demo.ini -o demo.rawlog
hoctomap build -q -i demo.rawlog -o map
hoctomap info map
hoctomap verify map
hoctomap info demo.rawlog >/dev/null
hoctomap export map --format 3dscene -o map.3Dscene
time hoctomap info map >/dev/null
python3 -c "import hoctomap; world = hoctomap.load(\"map\"); print(repr(world), hoctomap.__version__)
assert (hoctomap.Query(world).points(world.nodes[-1].world_voxels())[0] == hoctomap.OCCUPIED).all()"
ls /usr/share/man/man1/hoctomap*.1.gz /usr/share/bash-completion/completions/hoctomap
'

echo "== build against the development package"
install_in_root ./"$build"/packages/libhoctomap-dev_*.deb g++ cmake ninja-build
cp -r tests/install/downstream "$root/tmp/downstream"
version=$(sed -n 's/^project(hoctomap VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
in_root "cd /tmp && cmake -S downstream -B built -G Ninja -DWANTED=$version >/dev/null && cmake --build built && built/downstream"
echo "packages are good"
