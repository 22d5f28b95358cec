#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# For tests of the program, to be sourced: fail and expect count in $failures; $program is called.
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
