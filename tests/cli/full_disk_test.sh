#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A disk that is full, or fails, at each call of the system with which `run`, `run --resume` and
# `export` write: one clear message, what was written before can be read, and the same command with
# --resume ends in the same bytes as if nothing had been.
#   tests/cli/full_disk_test.sh PROGRAM FAIL_CALL CASES_FOLDER some|all
# some: of calls of one kind on files of one kind the first, each by one error from where it begins or
# goes on; all: by each error, for a moment and for good.
set -euo pipefail
program=$1 fail_call=$2 cases=$3 which=$4 tests=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
. "$tests/expect.sh"

# Three states of eight triangles, and a checkpoint at each of 17 steps.
arguments=("$cases/picture_frame" --set blanks.square.element_size=50 --set solver.duration=0.0015
  --set boundary.0.stroke=5 --set solver.outputs=2 --set solver.checkpoint_interval=0 --threads 1)
states=3

# chosen: of the calls in `log` those that are to fail, a line each.
chosen() {
  if [ "$which" = all ]; then
    cat log
  else
    awk '{ kind = $2 " " $3; gsub(/[0-9]/, "", kind) } !(kind in seen) { print; seen[kind] }' log
  fi
}

# The call that failed: none if progress.json was written less often than when calls were counted.
failed_call() {
  grep -m 1 FAILED failed || echo "$call, which did not come"
}

# one_message CODE FOLDER: what a program that failed says.
one_message() {
  local said
  said=$(grep -vE '^ *[0-9]+ %|: warning: |^goes on after ' message || true)
  if [ "$1" != 1 ] || [ "$(wc -l <<<"$said")" != 1 ] ||
    ! grep -qE "^plyform: error: $2[^ ]*: .*: ($reason)\$" <<<"$said"; then
    fail "$what: exit code $1:"$'\n'"$said"
  fi
}

# intact FOLDER COUNT: all there is is whole, and as in `whole`; at least so many states.
intact() {
  local file found=0
  [ -d "$1" ] || return 0
  [ -z "$(find "$1" -name '*.tmp')" ] || fail "$what: leaves $(find "$1" -name '*.tmp')"
  for file in "$1"/plies/*.csv; do
    [ ! -e "$file" ] || cmp -s "$file" "whole/${file#*/}" || fail "$what: $file is not whole"
  done
  for file in history.csv results.xdmf; do # those of fewer states are shorter
    [ ! -e "$1/$file" ] || [ -s "$1/$file" ] || fail "$what: $1/$file is empty"
  done
  [ ! -e "$1/history.csv" ] || cmp -s -n "$(stat -c %s "$1/history.csv")" "$1/history.csv" \
    whole/history.csv || fail "$what: $1/history.csv is not whole"
  if [ -e "$1/results.h5" ]; then
    "$program" export "$1" --frame all --format csv >exported 2>&1 ||
      fail "$what: results.h5 cannot be read: $(cat exported)"
    for file in "$1"/export/*.csv; do
      cmp -s "$file" "reference/${file##*/}" || fail "$what: $file is another state"
      found=$((found + 1))
    done
    rm -r "$1/export"
  fi
  [ "$found" -ge "$2" ] || fail "$what: $found states can be read, $2 were written"
}

# each NAME ERROR SUFFIX: fails one call after the other of `run` in the folder `again`, which
# begins as a copy of the folder NAME, if there is one.
each() {
  local call calls code before=0 written
  shopt -s nullglob
  [ ! -d "$1" ] || before=$(set -- "$1"/states/0*.h5 && echo $#)
  rm -rf again && { [ ! -d "$1" ] || cp -r "$1" again; }
  "$fail_call" again log none EIO "$program" run "${arguments[@]}" --resume -o again >/dev/null 2>&1
  same again
  mapfile -t calls < <(chosen)
  for call in "${calls[@]}"; do
    failed_before=$failures
    rm -rf again && { [ ! -d "$1" ] || cp -r "$1" again; }
    code=0
    "$fail_call" again failed "$call$3" "$2" "$program" run "${arguments[@]}" --resume -o again \
      >/dev/null 2>message || code=$?
    what="run, $2$3 at call $(failed_call)"
    count=$((count + 1))
    # A call may fail that nothing depends on.
    if [ "$code" = 0 ]; then
      ! grep -q 'unlink progress.json FAILED' failed || rm -f again/progress.json
      same again
      [ "$failures" = "$failed_before" ] || echo "  after $what: no error"
      continue
    fi
    one_message "$code" again
    written=$(sed '/FAILED/,$d' failed | grep -c 'rename results.h5' || true)
    [ "$written" -ge "$before" ] || written=$before
    intact again "$((written < states ? written : states))"
    "$program" run "${arguments[@]}" --resume -o again >message 2>&1 ||
      fail "$what: does not go on: $(tail -n 1 message)"
    same again
    [ "$failures" = "$failed_before" ] || echo "  after $what"
  done
}

count=0
"$program" run "${arguments[@]}" -o whole >message 2>&1 || { cat message; exit 1; }
"$program" export whole --frame all --format csv >/dev/null
mv whole/export reference
code=0
"$fail_call" again log none EIO "$program" run "${arguments[@]}" -o again >/dev/null 2>message || code=$?
if [ "$code" = 77 ]; then
  cat message
  exit 77
fi

reason='No space left on device'
each nothing ENOSPC +
[ "$which" = some ] || each nothing ENOSPC ''
# one that was stopped by a full disk between two states
rm -rf again
"$fail_call" again log "1 rename states/000002.h5+" ENOSPC "$program" run "${arguments[@]}" -o again >message 2>&1 || true
mv again halted
[ "$which" = some ] || each halted ENOSPC +
reason='Input/output error'
[ "$which" = some ] || each nothing EIO ''
each halted EIO ''

# Export leaves the run as it was.
"$program" export whole --format vtu,stl,csv >/dev/null
mv whole/export exports
for error in ENOSPC+ EIO; do
  [ "$error" = EIO ] || reason='No space left on device'
  [ "$error" != EIO ] || reason='Input/output error'
  rm -rf again && cp -r whole again
  "$fail_call" again log none EIO "$program" export again >/dev/null
  mapfile -t calls < <(chosen)
  for call in "${calls[@]}"; do
    rm -rf again/export
    code=0
    "$fail_call" again failed "$call${error//[A-Z]/}" "${error%+}" "$program" export again \
      >/dev/null 2>message || code=$?
    what="export, $error at call $(failed_call)"
    count=$((count + 1))
    [ "$code" = 0 ] || one_message "$code" again
    diff -r -x export whole again || fail "$what: changes the run"
    for file in again/export/*; do
      cmp -s "$file" "exports/${file##*/}" || fail "$what: $file is not whole"
    done
    "$program" export again >/dev/null && diff -r exports again/export || fail "$what: not again"
  done
done

# A file system that is mounted to be read only.
reason='Read-only file system'
for command in "run new" "run again" "resume again" "resume halted" "export again"; do
  read -r command at <<<"$command"
  words=(run "${arguments[@]}" -o "$at")
  [ "$command" != resume ] || words+=(--resume)
  [ "$command" != export ] || words=(export "$at")
  rm -rf again before && cp -r whole again
  [ ! -d "$at" ] || cp -r "$at" before
  code=0
  "$fail_call" "$at" failed every+ EROFS "$program" "${words[@]}" >/dev/null 2>message || code=$?
  what="$command into $at, which is read only"
  count=$((count + 1))
  if [ "$command $at" = "resume again" ]; then # nothing is left to do
    [ "$code" = 0 ] || fail "$what: exit code $code: $(cat message)"
  else
    one_message "$code" "$at"
  fi
  [ -d before ] && { diff -r before "$at" || fail "$what: changes it"; }
done

echo "$count calls failed, $failures failures"
[ "$failures" -eq 0 ]
