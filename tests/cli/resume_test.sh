#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs that are killed at random moments and go on with --resume end in the same bytes as one that
# never stopped, and leave no file that cannot be read.
#   tests/cli/resume_test.sh PROGRAM CASES_FOLDER [KILLS]        4 kills unless told
set -euo pipefail
program=$1 cases=$2 kills=${3:-4} tests=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
. "$tests/expect.sh"

# Five plies; two seconds of one core.
stack=("$cases/hemisphere_five_ply" --set blanks.square.mesh_from=element_size
  --set blanks.square.element_size=26 --set solver.duration=0.02
  --set tool.0.stroke=30 --set solver.checkpoint_interval=0.05)
# A frame that shears a ply: boundaries and their reactions.
frame=("$cases/picture_frame" --set blanks.square.element_size=20 --set solver.duration=0.05
  --set solver.checkpoint_interval=0.01)
# A sheet without yarns, computed one element after the other, with viscosity.
table=("$cases/circular_table" --set blanks.sheet.element_size=25 --set solver.duration=0.05
  --set solver.checkpoint_interval=0.02)
# Springs, grippers on drives and two holders.
springs=("$cases/springs_and_grippers" --set solver.duration=0.05
  --set solver.checkpoint_interval=0.02)

# A die from a mesh, facets of some 5 mm: a hole of radius 80 with a fillet of 10 and a flat top.
awk 'BEGIN {
  n = split("80 -120 80 -60 80 -10 81.3 -5 85 -1.3 90 0 130 0 180 0 260 0 260 -120", p, " ") / 2
  m = 100
  printf "OFF\n%d %d 0\n", n * m, 2 * n * m
  for (i = 0; i < n; ++i)
    for (k = 0; k < m; ++k) {
      a = 8 * atan2(1, 1) * k / m
      printf "%.9g %.9g %.9g\n", p[2 * i + 1] * cos(a), p[2 * i + 1] * sin(a), p[2 * i + 2]
    }
  for (i = 0; i < n; ++i)
    for (k = 0; k < m; ++k) {
      j = (i + 1) % n; l = (k + 1) % m
      printf "3 %d %d %d\n3 %d %d %d\n", i * m + k, i * m + l, j * m + l, i * m + k, j * m + l, j * m + k
    }
}' >die.off
sed -e 's|"../fabrics|"'"$cases"'/fabrics|' -e '/^points = /d' -e 's|^shape = "profile"|shape = "mesh"\nfile = "die.off"|' \
  "$cases/hemisphere_0/case.toml" >mesh.toml
mesh=(mesh.toml --set blanks.square.mesh_from=element_size --set blanks.square.element_size=13.6 --set solver.duration=0.03
  --set solver.checkpoint_interval=0.02)

# Two plies whose meshes come from the scene: what goes on does not look for them again.
scene=("$cases/verify/hemisphere_small.toml" --set blanks.square.mesh_from=scene
  --set solver.duration=0.01 --set solver.checkpoint_interval=0.02)

# run FOLDER ARGUMENT...: in the background; its process in $process.
run() {
  local to=$1
  shift
  "$program" run "$@" -o "$to" >"$to.log" 2>&1 &
  process=$!
}

# readable FOLDER: every file there is whole.
readable() {
  [ ! -e "$1/results.h5" ] || "$program" export "$1" >"$1.log" 2>&1 || fail "$1: $(tail -n 1 "$1.log")"
  rm -rf "$1/export"
}

killed=0
for case in stack frame table springs mesh scene; do
  declare -n arguments=$case
  rm -rf whole again
  begin=$EPOCHREALTIME
  "$program" run "${arguments[@]}" --threads 1 -o whole >whole.log 2>&1 || { cat whole.log; exit 1; }
  seconds=$(awk "BEGIN { print $EPOCHREALTIME - $begin }")
  for ((i = 0; i < kills; ++i)); do
    run again "${arguments[@]}" --resume --threads $((1 + i % 2))
    sleep "$(awk "BEGIN { srand($RANDOM); print 1.2 * rand() * $seconds }")"
    kill -KILL $process 2>/dev/null && killed=$((killed + 1))
    wait $process 2>/dev/null || true
    readable again
    if [ -e again/summary.json ]; then
      "$program" run "${arguments[@]}" --resume -o again >again.log 2>&1 || fail "$(tail -n 1 again.log)"
      same again
      rm -rf again
    fi
  done
  "$program" run "${arguments[@]}" --resume --threads 2 -o again >again.log 2>&1 ||
    fail "$case: $(tail -n 1 again.log)"
  same again
done

# Ended by the user, by the system, by a terminal that closed: all can go on.
rm -rf whole # the summary says what the case was given
"$program" run "${stack[@]}" --set solver.checkpoint_interval=1000 --threads 1 -o whole >whole.log 2>&1
for signal in INT TERM HUP; do
  rm -rf again
  run again "${stack[@]}" --set solver.checkpoint_interval=1000
  for ((i = 0; i < 200; ++i)); do
    [ ! -e again/states/000003.h5 ] || break
    sleep 0.05
  done
  kill -$signal $process
  wait $process && fail "SIG$signal: exit code 0"
  grep -q '"status": "interrupted"' again/summary.json || fail "SIG$signal: no status interrupted"
  grep -q '"message": "interrupted at step' again/summary.json || fail "SIG$signal: no message"
  grep -q 'with --resume goes on' again.log || fail "SIG$signal: $(tail -n 1 again.log)"
  readable again
  "$program" run "${stack[@]}" --set solver.checkpoint_interval=1000 --resume -o again \
    >again.log 2>&1 || fail "SIG$signal: $(tail -n 1 again.log)"
  same again
done
"$program" run "${stack[@]}" --set solver.checkpoint_interval=1000 --resume -o again >again.log 2>&1 ||
  fail "nothing to resume is an error"
grep -q 'nothing to resume' again.log || fail "does not say that there is nothing to resume"
code=0 # with other settings it has not ended
"$program" run "${stack[@]}" --resume -o again >again.log 2>&1 || code=$?
[ "$code" = 2 ] && grep -q 'is of another case' again.log || fail "code $code: $(tail -n 1 again.log)"

# Two at once, another case, a damaged checkpoint.
rm -rf again
run again "${stack[@]}"
for ((i = 0; i < 200; ++i)); do
  [ ! -e again/checkpoint ] || break
  sleep 0.05
done
"$program" run "${stack[@]}" -o again >second.log 2>&1 && fail "a second run into one folder"
grep -q 'again: another run writes into this folder' second.log || fail "$(tail -n 1 second.log)"
kill -KILL $process
wait $process 2>/dev/null || true
"$program" run "${stack[@]}" --set contact.friction=0.3 --resume -o again >second.log 2>&1 &&
  fail "goes on with another friction"
grep -q 'again/checkpoint: is of another case' second.log || fail "$(tail -n 1 second.log)"
printf 'x' | dd of=again/checkpoint bs=1 seek=5000 conv=notrunc status=none
"$program" run "${stack[@]}" --resume -o again >second.log 2>&1 && fail "goes on from a damaged file"
grep -q 'again/checkpoint: is damaged' second.log || fail "$(tail -n 1 second.log)"

echo "$killed kills, $failures failures"
[ "$failures" -eq 0 ]
