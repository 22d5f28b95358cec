#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# From a bare Debian 12 to five formed plies: installs what is missing, builds in release mode plyform
# and its Python module, which the workbench stands on, runs cases/hemisphere_five_ply into
# results/hemisphere_five_ply and makes a report of it, whose path is printed last. Nine minutes on two
# idle cores where nothing is there.
#   tools/form.sh [ARGUMENT OF plyform run]...      e.g. tools/form.sh --accuracy draft
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
printf '== %s\n' "Packages (a minute or two where all are missing)"
tools/install_packages.sh build report studio
tools/build.sh release plyform _plyform
echo "== Five plies, a quarter of them modelled (results in results/hemisphere_five_ply, report in report.html)"
exec build/release/tools/plyform run cases/hemisphere_five_ply -o results/hemisphere_five_ply \
  --set symmetry=alike --report "$@"
