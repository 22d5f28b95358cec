#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing, configures build/PRESET if that has not been done, and builds:
#   tools/build.sh PRESET [TARGET]
# Done again, it does nothing that is not needed.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
root=$(pwd -P)
cd "$root"
preset=$1

tools/install_packages.sh

# Configure anew also when the presets have changed, or the folder was copied or moved.
if ! grep -qsxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "build/$preset/CMakeCache.txt" ||
  ! [ "build/$preset/build.ninja" -nt CMakePresets.json ]; then
  cmake --fresh --preset "$preset"
fi
cmake --build "build/$preset" --target "${2:-all}"
