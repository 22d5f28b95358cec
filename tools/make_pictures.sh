#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes every picture of the texts anew: builds plyform, runs the cases that have no finished
# results in results/CASE, and draws:
#   tools/make_pictures.sh [--run always] [PICTURE]...     e.g. tools/make_pictures.sh docs/users/five_ply.png
# --run always runs every case that a picture needs, once.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# PICTURE | CASES it shows, of cases/ (folders, or files in them) | ARGUMENTS of tools/plot.py, without -o, or
# of `plyform`, if they begin with `report`. A line each.
pictures=(
  "docs/users/setup.png | | setup cases/hemisphere_0/case.toml --dpi 90"
  "docs/users/five_ply.png | hemisphere_five_ply | plies results/hemisphere_five_ply --tools --gap 45 --limit 50 --dpi 75"
  "docs/users/report.png | hemisphere_five_ply | report results/hemisphere_five_ply"
  "docs/verification/bias_extension.png | bias_extension | load results/bias_extension --curve results/bias_theory.csv --against shear --limit 5 --dpi 75"
  "docs/verification/picture_frame.png | picture_frame | load results/picture_frame --curve results/frame_theory.csv --against shear --limit 5 --dpi 75"
  "docs/verification/hemisphere_ud.png | hemisphere_ud | plies results/hemisphere_ud --field tow-opening --only above --dpi 80"
  "docs/verification/ud_tape_stack.png | ud_tape_stack | plies results/ud_tape_stack --field tow-opening --only above --dpi 60"
  "docs/verification/hemisphere_ncf.png | hemisphere_ncf | plies results/hemisphere_ncf --field shear --ply ply1 --dpi 80"
  "docs/verification/hemisphere_ncf_five_ply.png | hemisphere_ncf_five_ply | plies results/hemisphere_ncf_five_ply --field shear --only above --dpi 70"
  "docs/verification/circular_table.png | circular_table circular_table/circular_table_no_shear.toml circular_table/circular_table_isotropic.toml | plies results/circular_table results/circular_table_no_shear results/circular_table_isotropic --only 3d --dpi 60"
)

always=
if [ "${1:-}" = --run ]; then
  [ "${2:-}" = always ] || { echo "make_pictures.sh: error: --run takes: always" >&2; exit 2; }
  always=1
  shift 2
fi
for wanted in "$@"; do
  printf '%s\n' "${pictures[@]}" | grep -q "^$wanted |" || {
    echo "make_pictures.sh: error: $wanted is no picture of this script; it makes:" >&2
    printf '  %s\n' "${pictures[@]%% *}" >&2
    exit 2
  }
done

# run CASE: unless its results are there; with --run always once in this call.
declare -A fresh
run() {
  local results
  results=results/$(basename "$1" .toml)
  if [ -z "$always" ]; then
    ! grep -qsE '"status": "(done|doubtful)"' "$results/summary.json" || return 0
  elif [ -n "${fresh[$1]:-}" ]; then
    return 0
  fi
  build/release/tools/plyform run "cases/$1" -o "$results"
  fresh[$1]=1
}

tools/build.sh release plyform
mkdir -p results
build/release/tools/plyform theory bias --length 300 --width 100 --to 45 \
  --fabric cases/fabrics/glass_plain_weave.toml -o results/bias_theory.csv
build/release/tools/plyform theory frame --side 100 --to 50 \
  --fabric cases/fabrics/glass_plain_weave.toml -o results/frame_theory.csv
for line in "${pictures[@]}"; do
  IFS='|' read -r picture cases arguments <<<"$line"
  picture=${picture// /}
  [ $# -eq 0 ] || [[ " $* " == *" $picture "* ]] || continue
  for case in $cases; do
    run "$case"
  done
  read -ra arguments <<<"$arguments"
  if [ "${arguments[0]}" = report ]; then
    build/release/tools/plyform "${arguments[@]}" -o results/report.html
    /usr/bin/python3 tests/python/report_browser.py results/report.html "$picture"
  else
    tools/plot.py "${arguments[@]}" -o "$picture"
  fi
  echo "$picture"
done
