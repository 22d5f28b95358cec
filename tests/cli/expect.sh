#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# For tests of the program, to be sourced: fail, expect and same count in $failures; $program is
# called.
failures=0

fail() {
  printf '%s\n' "$*"
  failures=$((failures + 1))
}

# expect CODE TEXT ARGUMENT...: the exit code, and a text in what is printed.
expect() {
  local code=$1 text=$2 found=0 output
  shift 2
  output=$("$program" "$@" 2>&1) || found=$?
  if [ "$found" != "$code" ] || ! grep -qF -- "$text" <<<"$output"; then
    fail "plyform $*: exit code $found, expected $code and \"$text\"; printed:"$'\n'"$output"
  fi
}

# same FOLDER: a run that went on, as one that never stopped, in the folder `whole`, times on the
# clock apart.
same() {
  local file clock
  for file in history.csv results.h5 results.xdmf $(cd whole && echo plies/*.csv); do
    cmp -s "whole/$file" "$1/$file" || fail "$1/$file is not that of a run that never stopped"
  done
  [ ! -e "$1/checkpoint" ] && [ ! -e "$1/states" ] && [ ! -e "$1/progress.json" ] || fail "$1: files of a run in progress are left"
  clock='wall_time_s|"threads"|share|"(elements|contact|search)": [0-9]'
  diff <(grep -vE "$clock" whole/summary.json) <(grep -vE "$clock" "$1/summary.json") ||
    fail "$1/summary.json is not that of a run that never stopped"
}
