#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The command line as a user meets it: exit codes, messages, where results go.
#   tests/cli/cli_test.sh PROGRAM CASES_FOLDER
set -euo pipefail
program=$1 cases=$2 tests=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
. "$tests/expect.sh"
cd "$folder"

cp -r "$cases" cases
short=(--set blanks.square.mesh_from=element_size --set blanks.square.element_size=34 --set solver.duration=0.002 --set tool.0.stroke=0.5)
expect 0 plyform version
expect 0 "$("$program" version)" --version
expect 0 'tool[].radius' keys
expect 0 'weft_strain,weft-strain,weft strain,1,triangle,1' columns
expect 0 'stitch_tension_N,stitch-tension' columns stitch
expect 2 'two columns would be called x: give a family another name' columns x
expect 2 'subcommand is required'
expect 2 'subcommand is required' frob
expect 2 'threads' run cases/hemisphere_0 --threads 0
# A standard output that takes nothing is told, by every command that prints there.
if [ -e /dev/full ]; then
  "$program" export results_of_nothing >/dev/null 2>&1 || true
  full=("version" "columns" "keys" "keys --markdown" "--help" "run --help" "check cases/hemisphere_0 ${short[*]}"
    "run cases/hemisphere_0 -o full ${short[*]}" "export full" "difference full full"
    "theory frame --side 200 --fabric cases/fabrics/glass_plain_weave.toml --to 50 -o frame.csv")
  for arguments in "${full[@]}"; do
    found=0
    # shellcheck disable=SC2086
    "$program" $arguments >/dev/full 2>message || found=$?
    if [ "$found" != 1 ] || ! grep -qF 'standard output cannot be written' message; then
      fail "plyform $arguments >/dev/full: exit code $found"$'\n'"$(cat message)"
    fi
  done
  [ -s full/summary.json ] || fail "a run whose standard output is full has left no results"
  "$program" run cases/hemisphere_0 -o closed "${short[@]}" >&- 2>message &&
    fail "a run without standard output says 0"
  "$program" export closed >exported || fail "a run without standard output has spoilt its results"
fi
# Forces are printed of all that holds or pulls, as they are in summary.json.
"$program" run cases/springs_and_grippers -o pulled --set blanks.strip.element_size=25 \
  --set solver.duration=0.01 >said 2>&1 || fail "a strip on springs says: $(cat said)"
for name in spring_south spring_north gripper_south gripper_north holder_west; do
  printed=$(sed -nE "s/^ +$name +force +([^ ]+) N, displacement .* mm$/\\1/p" said)
  written=$(grep -A1 "\"name\": \"$name\"" pulled/summary.json | sed -nE 's/.*"force_N": ([^,]*).*/\1/p')
  awk -v a="$printed" -v b="$written" 'BEGIN { d = a - b; exit !(a != "" && b != "" && d * d < 0.003) }' ||
    fail "$name: force '$printed' printed, '$written' in summary.json"
done
# A folder that another run has is left alone, by --resume too.
mkdir taken
for resume in "" --resume; do
  # shellcheck disable=SC2086
  flock taken "$program" run cases/hemisphere_0 -o taken "${short[@]}" $resume >said 2>&1 &&
    fail "a second run into one folder $resume"
  grep -q 'taken: another run writes into this folder; wait for it, or give another one with -o' \
    said || fail "a second run says: $(cat said)"
done
[ ! -e taken/results.h5 ] || fail "a second run has written"
expect 2 'nosuch:1:1' run nosuch
expect 2 'did you mean angle' run cases/hemisphere_0 --set ply.0.angel=3
expect 2 'KEY=VALUE' run cases/hemisphere_0 --set angle
[ ! -e results ] || { echo "a wrong case has written results"; failures=$((failures + 1)); }
expect 0 'the case is sound' check cases/hemisphere_0 "${short[@]}"
expect 0 'tool punch: driven 35 mm, smallest radius 10 mm' check cases/square_box
expect 0 'boundary frame: frame, holds 40 nodes of ply square, moves 46.5 mm' check cases/picture_frame
expect 0 'boundary lower_grip: grip, holds 9 nodes of ply strip, stays' check cases/bias_extension
cat >cases/half.toml <<'END'
[fabrics]
glass = "fabrics/glass_plain_weave.toml"
[blanks.half]
size = [50.0, 100.0]
centre = [25.0, 0.0]
element_size = 10.0
[[ply]]
name = "half"
fabric = "glass"
blank = "half"
angle = 0.0
[[boundary]]
name = "middle"
kind = "symmetry"
normal = [1.0, 0.0]
END
expect 0 'boundary middle: plane of symmetry, holds 11 nodes of ply half' check cases/half.toml
expect 0 'symmetry: forces and energies' check cases/half.toml
expect 0 'results/hemisphere_0' run cases/hemisphere_0/ "${short[@]}"
expect 0 'results/hemisphere_45' run cases/hemisphere_45/case.toml "${short[@]}"
expect 0 'ply.vtu' export results/hemisphere_0
expect 1 'results.h5' export nosuch
for frame in -5 -2 1.5 last; do
  expect 2 "--frame $frame: a number from 0, -1 for the last, or all" export results/hemisphere_0 "--frame=$frame"
  expect 2 frame map results/hemisphere_0 "--frame=$frame"
done
for options in "--from abc" "--direction x" "--no-such-option" "--frame"; do
  # shellcheck disable=SC2086
  expect 2 "${options%% *}" identify warp curve.csv --fabric glass.toml -o new.toml $options
done
# Numbers that no double or 64 bits hold are values that are too large: all mistakes are told.
for number in 1e400 -1e400 +1_0e4_00 100000.5e999 99999999999999999999 -99999999999999999999; do
  sed "s/^stroke = .*/stroke = $number  # mm/; s/^duration = .*/duration = -1.0/" cases/hemisphere_0/case.toml \
    >cases/hemisphere_0/reach.toml
  expect 2 ":26:10: error: tool.0.stroke = $number: must be at" check cases/hemisphere_0/reach.toml
  expect 2 'solver.duration = -1.0: must be' check cases/hemisphere_0/reach.toml
done
expect 2 'tool.0.stroke = 1e400: must be at' check cases/hemisphere_0 --set tool.0.stroke=1e400
sed 's/^stroke = .*/stroke = 1e400x/' cases/hemisphere_0/case.toml >cases/hemisphere_0/reach.toml
expect 2 "is no TOML: Error while parsing floating-point: expected decimal digit, saw 'x'" \
  check cases/hemisphere_0/reach.toml
expect 0 'shear_angle_deg,0,0,0,0,0' difference results/hemisphere_0 results/hemisphere_0
expect 0 'warp_strain,0' difference results/hemisphere_0 results/hemisphere_0 --field warp_strain
expect 2 'shear is no field of triangles; there are shear_angle_deg' \
  difference results/hemisphere_0 results/hemisphere_0 --field shear
expect 1 'nosuch/results.h5' difference results/hemisphere_0 nosuch
for name in hemisphere_0 hemisphere_45; do
  [ -s "results/$name/summary.json" ] || { echo "no results/$name"; failures=$((failures + 1)); }
done
expect 3 'last good state' run cases/hemisphere_0 -o stopped --set solver.max_balance_error=1e-9
[ -s stopped/summary.json ] || { echo "a stopped run left nothing"; failures=$((failures + 1)); }
# Large elements on a fillet of 10 mm: it ends, and says what not to trust.
expect 0 'die cuts into it between nodes' \
  run cases/hemisphere_0 --accuracy draft --set blanks.square.mesh_from=element_size \
  --set blanks.square.element_size=9 -o doubtful
if ! grep -q '"status": "doubtful"' doubtful/summary.json; then
  echo "the summary of a doubtful run does not say so"
  failures=$((failures + 1))
fi

# Each ply alone; a quarter in the place of the whole, with a note of it.
expect 0 'instant: each ply was formed alone' run cases/hemisphere_two_ply --accuracy instant -o first
expect 0 'shear_angle_deg' difference first first
expect 2 'forms each ply alone, which says nothing of this case' run cases/circular_table --accuracy instant \
  -o none
expect 0 'a quarter is modelled, cut at x = 0 and y = 0' run cases/hemisphere_0 --set symmetry=scene \
  --set solver.duration=0.005 --set blanks.square.element_size=20 --set blanks.square.mesh_from=element_size \
  -o quarter

# A shipped case checks without warnings, at the accuracy that it has.
for name in hemisphere_0 hemisphere_45 hemisphere_two_ply hemisphere_five_ply square_box circular_table \
  bias_extension picture_frame; do
  "$program" check "cases/$name" >said 2>&1 || fail "plyform check cases/$name fails"
  grep -q 'warning: ' said && fail "plyform check cases/$name warns: $(grep 'warning: ' said)"
done
# What a scout has found is kept, by case; --quick has none.
export XDG_CACHE_HOME=$PWD/cache
expect 0 'are told without --quick' check cases/hemisphere_0 --quick
expect 0 'found with' check cases/hemisphere_0 --set title='"another"'
expect 0 'found before, and kept' check cases/hemisphere_0 --set title='"another"'
expect 0 'mesh from the scene: 7914 triangles' check cases/hemisphere_0 --quick --set title='"another"'
expect 0 'with the mesh from the scene:' check cases/hemisphere_0
# Where it cannot be kept it is no error.
touch no_folder
XDG_CACHE_HOME=$PWD/no_folder expect 0 'found with' check cases/hemisphere_0
# A small pocket in a large blank: the scout finds its fillets of 4 mm from elements of 49 mm on.
expect 0 'triangles, elements of 2.19 to 35 mm' check cases/pocket
expect 0 'touches ply ply; 600 x 600 x 10 mm, from (-300, -300, 0.6) to (300, 300, 10.6)' \
  check cases/hemisphere_0
expect 0 '20 mm from ply ply, first contact with ply ply after 20 mm' check cases/hemisphere_0 \
  --set 'tool.0.position=[0,0,95.6]'
expect 0 'it does nothing, since nothing is driven' check cases/circular_table --accuracy draft \
  --set blanks.sheet.element_size=20
expect 2 'or go on with --yes-large' check cases/hemisphere_0 --set blanks.square.element_size=0.15
endless=(--set blanks.square.element_size=4 --set solver.duration=1e4) # weeks, on any machine
expect 2 'or go on with --yes-large' check cases/hemisphere_0 "${endless[@]}"
expect 0 'the case is sound' check cases/hemisphere_0 "${endless[@]}" --yes-large
# One triangle used to be "done", with a balance of energies off by all of it.
expect 0 'doubtful: do not trust ply where punch cuts into it' run "$tests/../data/cannot_work/press.toml" -o triangle \
  --set 'blanks.square={mesh="file",file="one_triangle.off"}' --set solver.duration=0.05 \
  --set 'tool=[{name="punch",shape="sphere",radius=20,position=[0,0,20.6],motion="driven",stroke=5}]'
ln -s "$PWD/cases/hemisphere_0/case.toml" linked.toml
expect 0 'the case is sound' check linked.toml "${short[@]}"

# An accuracy that was missed: the second run is in the folder, the first one in first_run, whole.
small=(cases/verify/hemisphere.toml --threads 1 --set accuracy.shear_deg=1.4
  --set 'ply=[{name="ply1",fabric="glass",blank="square",angle=20}]'
  --set tool.0.position=[0,0,45.6] --set tool.2.position=[0,0,0.6])
expect 0 'the first run is in corrected/first_run' run "${small[@]}" -o corrected --verify
grep -q '"outcome": "corrected"' corrected/summary.json || fail "no outcome in corrected"
grep -q '"outcome": "missed"' corrected/first_run/summary.json || fail "no outcome in first_run"
expect 0 shear_angle_deg difference corrected corrected/first_run
[ ! -e corrected/second_run ] || fail "second_run is left"
for file in history.csv results.xdmf plies/ply1.csv; do
  [ -s "corrected/$file" ] && [ -s "corrected/first_run/$file" ] || fail "corrected lacks a $file"
done
expect 0 'missed, not corrected: what stays as it is leaves too much: elements, duration, softening' \
  run "${small[@]}" -o by_hand --verify --set blanks.square.element_size=6.8 \
  --set solver.duration=0.01 --set solver.fibre_softening=100
[ ! -e by_hand/first_run ] || fail "by_hand has a second run"

# The page of keys is what the program says.
page=$tests/../../docs/users/keys.md
if ! "$program" keys --markdown | cmp -s - "$page"; then
  echo "docs/users/keys.md is stale: make it anew with plyform keys --markdown"
  failures=$((failures + 1))
fi

# Ctrl-C: the state reached is written.
"$program" run cases/hemisphere_0 -o broken_off >log 2>&1 &
for _ in $(seq 600); do # until the first state is written: then the program listens
  [ -e broken_off/results.h5 ] && break
  sleep 0.1
done
kill -INT $!
wait $! && code=0 || code=$?
if [ "$code" != 1 ] || ! grep -q interrupted log || [ ! -s broken_off/summary.json ]; then
  echo "Ctrl-C: exit code $code"; cat log; failures=$((failures + 1))
fi
echo "$failures failed"
[ "$failures" = 0 ]
