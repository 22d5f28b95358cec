#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes every picture of the texts anew: builds plyform, runs the cases that have no finished
# results in results/CASE, and draws:
#   tools/make_pictures.sh [--run always] [PICTURE]...     e.g. tools/make_pictures.sh docs/five_ply.png
# --run always runs every case that a picture needs, once.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# PICTURE | CASES it shows, of cases/ | ARGUMENTS of tools/plot.py, without -o. A line each.
pictures=(
  "docs/five_ply.png | hemisphere_five_ply | plies results/hemisphere_five_ply --tools --gap 45 --limit 25 --dpi 75"
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
  if [ -z "$always" ]; then
    ! grep -qs '"status": "done"' "results/$1/summary.json" || return 0
  elif [ -n "${fresh[$1]:-}" ]; then
    return 0
  fi
  build/release/tools/plyform run "cases/$1" -o "results/$1"
  fresh[$1]=1
}

tools/build.sh release plyform
for line in "${pictures[@]}"; do
  IFS='|' read -r picture cases arguments <<<"$line"
  picture=${picture// /}
  [ $# -eq 0 ] || [[ " $* " == *" $picture "* ]] || continue
  for case in $cases; do
    run "$case"
  done
  read -ra arguments <<<"$arguments"
  tools/plot.py "${arguments[@]}" -o "$picture"
  echo "$picture"
done
