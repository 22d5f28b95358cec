#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs what is missing, builds everything and runs all tests; ctest's closing lines come last.
#   tools/test.sh [--preset PRESET] [ARGUMENT OF ctest]...      e.g. tools/test.sh -R Membrane
# PRESET is one of CMakePresets.json, release unless told. The preset of a sanitizer leaves the
# tests labelled `long` out.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
preset=release
if [ "${1:-}" = --preset ]; then
  preset=${2:?--preset needs the name of a preset}
  shift 2
fi
tools/build.sh "$preset"
exec ctest --preset "$preset" --parallel "$(nproc)" --no-label-summary "$@"
