#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What happens around a run and brings programs down: streams that take nothing, signals, limits,
# files without an end, keys without an end.
#   tests/cli/robust_test.sh PROGRAM CASES_FOLDER
set -euo pipefail
program=$1 cases=$2 tests=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
. "$tests/expect.sh"

# A second of one core, with progress lines; and one that goes on until it is told to stop.
case=("$cases/picture_frame" --set blanks.square.element_size=20 --set solver.duration=0.01)
long=("$cases/picture_frame" --set blanks.square.element_size=20 --set solver.duration=50
  --set solver.outputs=100000)

# done_in FOLDER WHAT CODE: the results are there and the code is 0.
done_in() {
  [ "$3" = 0 ] || fail "$2: exit code $3"
  grep -q '"status": "done"' "$1/summary.json" 2>/dev/null || fail "$2: no summary that says done"
  "$program" export "$1" >/dev/null 2>&1 || fail "$2: no results"
}

# Standard error that takes nothing: progress is dropped, the results are not.
for how in '2>/dev/full' '2>&-' '2> >(head -c 1 >/dev/null; exec sleep 0)' '</dev/null 2>&- 0<&-'; do
  [ -e /dev/full ] || continue
  rm -rf out
  code=0
  eval '"$program" run "${case[@]}" -o out '"$how"' >said' || code=$?
  done_in out "run $how" "$code"
  code=0
  eval '"$program" check "${case[@]}" '"$how"' >said' || code=$?
  [ "$code" = 0 ] && grep -q 'the case is sound' said || fail "check $how: exit code $code"
  code=0
  eval '"$program" check nosuch.toml '"$how"' >said' || code=$?
  [ "$code" = 2 ] || fail "check of a missing file $how: exit code $code"
done
# Both closed, or a pipe that nobody reads: the results are there, and the code says that something is
# missing.
for how in '>&- 2>&-' '>/dev/full 2>/dev/full' '> >(exec sleep 0) 2>&1'; do
  [ -e /dev/full ] || continue
  rm -rf out
  code=0
  eval '"$program" run "${case[@]}" -o out '"$how" || code=$?
  [ "$code" = 1 ] || fail "run $how: exit code $code"
  done_in out "run $how" 0
done

# begun FOLDER: waits until a run has written a state.
begun() {
  local i
  for ((i = 0; i < 400; ++i)); do
    [ ! -e "$1/states/000001.h5" ] || return 0
    sleep 0.05
  done
  fail "$1: no state"
}

# Each signal that would end the program: a summary that says which it was.
for signal in INT TERM HUP XCPU XFSZ USR1 USR2 ALRM VTALRM PROF IO PWR RTMIN RTMAX; do
  rm -rf out
  # a test that nohup began has a hang-up ignored, and the program would leave it so
  env --default-signal "$program" run "${long[@]}" -o out >said 2>&1 &
  process=$!
  begun out
  kill "-$signal" $process
  code=0
  wait $process || code=$?
  [ "$code" = 1 ] || fail "SIG$signal: exit code $code"
  grep -q '"status": "interrupted"' out/summary.json || fail "SIG$signal: no summary"
  number=$(kill -l "$signal")
  grep -qE "\"message\": \"interrupted at step .*, by signal (SIG$signal |$number\")" out/summary.json ||
    grep -qE 'by signal SIG(POLL|IO) ' out/summary.json ||
    fail "SIG$signal: $(grep message out/summary.json)"
  "$program" export out >/dev/null || fail "SIG$signal: no results"
done
# A run that is not to end with its terminal does not.
rm -rf out
(trap '' HUP; exec "$program" run "${long[@]}" -o out >said 2>&1) &
process=$!
begun out
kill -HUP $process
sleep 0.5
kill -0 $process 2>/dev/null || fail "a hang-up ends a run in spite of nohup"
kill -TERM $process
wait $process || true

# A limit of the size of files, in blocks of 1 KB: what fits, and a summary that says what ended it.
rm -rf out
code=0
(ulimit -f 40; exec "$program" run "${case[@]}" -o out >said 2>&1) || code=$?
[ "$code" = 1 ] || fail "ulimit -f: exit code $code"
grep -q '"status": "interrupted"' out/summary.json 2>/dev/null || fail "ulimit -f: no summary: $(cat said)"
grep -q 'by signal SIGXFSZ' out/summary.json || fail "ulimit -f: $(grep message out/summary.json)"
grep -q 'File too large' said || fail "ulimit -f: $(cat said)"

# Files without an end, and too large ones.
mkfifo pipe.toml pipe.csv
truncate -s 10G sparse.toml sparse.stl sparse.csv sparse.dxf
expect 2 'the case file is a pipe, not a file' check pipe.toml
expect 2 'the case file is too large: it has 10240 MB' check sparse.toml
expect 2 'is a device, not a file' check /dev/zero
expect 2 'the curve is a pipe, not a file' identify warp pipe.csv --yarns 1 --gauge-length 1 \
  --fabric "$cases/fabrics/glass_plain_weave.toml" -o x.toml
expect 2 'the curve is too large' identify warp sparse.csv --yarns 1 --gauge-length 1 \
  --fabric "$cases/fabrics/glass_plain_weave.toml" -o x.toml
for file in sparse.stl pipe.toml; do
  sed -e "s|^shape = \"profile\"|shape = \"mesh\"\nfile = \"$file\"|" -e '/^points = /d' \
    -e 's|"../fabrics|"'"$cases"'/fabrics|' "$cases/hemisphere_0/case.toml" >case.toml
  expect 2 'case.toml:' check case.toml
done
mkdir results_of_pipe
mkfifo results_of_pipe/results.h5
expect 1 'results.h5: is a pipe, not a file' export results_of_pipe
expect 1 'results.h5: is a pipe, not a file' difference results_of_pipe results_of_pipe
# A pipe in the way of a file that is written.
rm -rf out
mkdir out
mkfifo out/summary.json.tmp out/results.h5.tmp out/history.csv.tmp
expect 0 'results are in out' run "${case[@]}" -o out

# Keys, values and names without an end.
dots=$(head -c 40000 /dev/zero | sed 's/\x00\x00/a./g')a
printf '%s = 1\n' "$dots" >deep.toml
expect 2 'deep.toml:1:32: error: goes more than 16 levels deep' check deep.toml
printf 'x = %s\n' "$(head -c 40000 /dev/zero | tr '\0' '[')" >deep.toml
expect 2 'deep.toml:1:21: error: goes more than 16 levels deep' check deep.toml
expect 2 'unknown key' check "${case[@]}" --set "$dots=1"
expect 2 'levels deep' check "${case[@]}" --set "title=$(head -c 40000 /dev/zero | tr '\0' '[')"
expect 2 'must not be longer than 100 bytes, and has 10000' check "${case[@]}" \
  --set "ply.0.name=$(head -c 10000 /dev/zero | tr '\0' 'x')"

# Nothing that a terminal obeys is printed, wherever it comes from.
printf 'solid \033[2J facet\n\033]0;x\007\n' >bad.stl
printf '"\033]0;x\007" = 1\n' >escape.toml
"$program" check escape.toml >said 2>&1 || true
"$program" check "$(printf 'no\033[2Jsuch')" >>said 2>&1 || true
"$program" "$(printf 'no\033[2Jsuch')" >>said 2>&1 || true
"$program" export "$(printf 'no\033[2Jsuch')" >>said 2>&1 || true
"$program" check "${case[@]}" --set 'title="\u001b[2J"' >>said 2>&1 || true
"$program" check "${case[@]}" --set "$(printf 'title\033[2J=1')" >>said 2>&1 || true
[ "$(wc -l <said)" -ge 5 ] || fail "says too little: $(cat -v said)"
LC_ALL=C grep -q $'[\x01-\x08\x0b-\x1f\x7f]' said && fail "a terminal would obey: $(cat -v said)"

[ "$failures" -eq 0 ] && echo "nothing brings it down"
