#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing, builds everything and runs the tests; ctest's closing lines come last.
#   tools/test.sh [--all | --preset PRESET] [ARGUMENT OF ctest]...   e.g. tools/test.sh -R Membrane
# Tests labelled `long`, whole cases and pages clicked through, run with --all only. PRESET: a test
# preset of CMakePresets.json, release unless told.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=release
tests=release
if [ "${1:-}" = --all ]; then
  tests=release_all
  shift
elif [ "${1:-}" = --preset ]; then
  preset=${2:?--preset needs the name of a preset}
  tests=$preset
  shift 2
fi

# What the tests need only when they run is installed while they are being built. A failed build
# waits for it too: apt must not be cut short.
printf '== %s\n' "Packages to build with (what the tests run with follows during the build)"
tools/install_packages.sh build test
log=$(mktemp)
trap 'rm -f "$log"' EXIT
tools/install_packages.sh test-run >"$log" 2>&1 &
built=yes
tools/build.sh "$preset" || built=no
wait $! || { cat "$log" >&2 && exit 1; }
[ $built = yes ] || exit 1
printf '== %s\n' "Tests (two cores: fifteen minutes; with --all forty)"
ctest --preset "$tests" --parallel "$(nproc)" --no-label-summary "$@"
