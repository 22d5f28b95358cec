#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing, configures build/PRESET if that has not been done, and builds:
#   tools/build.sh PRESET              all, with the tests
#   tools/build.sh PRESET TARGET...    some: plyform, the program, and _plyform, the Python module, need
#                                      the packages of the tests only if the folder is set up for them
# Done again, it does nothing that is not needed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
root=$(pwd -P)
cd "$root"
preset=$1
targets=("${@:2}")
[ ${#targets[@]} -gt 0 ] || targets=(all)
for_users=yes # nothing but what users run
for target in "${targets[@]}"; do
  [[ $target =~ ^_?plyform$ ]] || for_users=no
done
cache=build/$preset/CMakeCache.txt

step() { printf '== %s\n' "$*"; }

# Set up anew also when the presets have changed, or the folder was copied or moved.
fresh=yes
if grep -qsxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache" &&
  [ "build/$preset/build.ninja" -nt CMakePresets.json ]; then
  fresh=no
fi
# A folder set up for the program alone gets its tests when they are asked for first.
tests=yes options=()
if [ $for_users = yes ] && { [ $fresh = yes ] || grep -qsxF PLYFORM_TESTS:BOOL=OFF "$cache"; }; then
  tests=no options=(-D PLYFORM_TESTS=OFF)
elif [ $for_users = no ] && [ "$preset" != bench ] && grep -qsxF PLYFORM_TESTS:BOOL=OFF "$cache"; then
  fresh=add options=(-D PLYFORM_TESTS=ON)
fi

step "Packages (a minute or two where all are missing)"
groups=(build)
[ $tests = no ] || groups+=(test)
[ "$preset" != asan ] || groups+=(clang-14 libclang-rt-14-dev)
tools/install_packages.sh "${groups[@]}"

step "Build in build/$preset (two cores: program and module five minutes, with the tests twelve)"
case $fresh in
  yes) cmake --fresh --preset "$preset" "${options[@]}" ;;
  add) cmake --preset "$preset" "${options[@]}" ;;
esac
cmake --build "build/$preset" --target "${targets[@]}"
