#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What plyform identify says of numbers whose unit or meaning is in doubt, of laws that no case could
# use, and of curves with a stitch's pre-tension.
#   tests/cli/identify_units_test.sh PROGRAM CASES_FOLDER
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/expect.sh"
program=$1 cases=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$cases/fabrics/glass_plain_weave.toml" "$folder/glass.toml"
cp "$cases/fabrics/ncf_biaxial_pillar.toml" "$folder/ncf.toml"
cd "$folder"

# Units: known ones are turned, others refused.
frame=(--side 200 --fabric glass.toml -o out.toml --compliance 0)
"$program" theory frame --side 200 --fabric glass.toml --to 45 --points 40 -o n.csv >theory.txt
expect 0 'k1 = 0.37044' identify frame n.csv "${frame[@]}"
for unit in lb:4.4482216 kp:9.80665 kip:4448.2216 dyn:1e-5 kn:1000; do
  awk -F, -v f="${unit#*:}" -v u="${unit%:*}" 'NR == 1 { print $1 ",load (" u ")" }
    NR > 1 { printf "%s,%.12g\n", $1, $3 / f }' n.csv >unit.csv
  expect 0 'k1 = 0.3704' identify frame unit.csv "${frame[@]}"
done
awk -F, 'NR == 1 { print "extension (ft)," $3 } NR > 1 { printf "%.12g,%s\n", $1 / 304.8, $3 }' n.csv >ft.csv
expect 0 'k1 = 0.3704' identify frame ft.csv "${frame[@]}"
sed '1s/.*/extension (mm),shear_deg,load (stone)/' n.csv >stone.csv
expect 2 'load (stone) = stone: is no unit of a force that is known' identify frame stone.csv "${frame[@]}"
expect 0 'k1 = 0.3704' identify frame stone.csv "${frame[@]}" --y-unit N
sed '1s/.*/extension (mm),shear_deg,load (tonf)/' n.csv >ton.csv
expect 2 'a ton is of 1000 kgf, 2000 lbf or 2240 lbf' identify frame ton.csv "${frame[@]}"

# Measures that words of a header name.
cat >rubber.toml <<END
name = "rubber"
surface_density = 1100.0
thickness = 1.0
END
awk 'BEGIN { print "strain,true stress (MPa)"
  for (i = 0; i <= 20; ++i) { l = 1 + 0.02 * i; printf "%g,%.8g\n", l - 1, 0.4 * (l * l - 1 / l) } }' >true.csv
expect 2 'is a true stress' identify uniaxial true.csv --fabric rubber.toml -o out.toml
printf 'bending length (mm),angle (deg)\n70,41.5\n71,41.5\n69,41.5\n' >half.csv
expect 2 'is a bending length, half of the overhang' \
  identify cantilever half.csv --direction both --fabric glass.toml -o out.toml

# Messages have the file's own numbers.
printf 'stretch,stress (MPa)\n0.7,-0.5\n0.8,-0.3\n1,0\n1.1,0.1\n1.2,0.2\n1.3,0.3\n' >pressed.csv
expect 2 'stretch = 0.7: the stretch must not be below 1' \
  identify uniaxial pressed.csv --fabric rubber.toml -o out.toml
awk 'BEGIN { print "extension (in),load (N)"; for (i = 0; i <= 30; ++i) print i "," i }' >in.csv
expect 2 'extension (in) = 5: the extension must be less than' identify frame in.csv "${frame[@]}"
printf 'd,load (kN)\n0,0\n1,-0.001\n2,0.002\n3,0.004\n4,0.005\n' >kn.csv
expect 2 'load (kN) = -0.001: the load must not be below 0 by more than 2 % of its largest value, 0.005' \
  identify frame kn.csv "${frame[@]}"
awk -F, 'NR == 1 { print "shear angle,load (N)" } NR > 1 { printf "%.9g,%s\n", $2 * 0.0174532925, $3 }' n.csv >rad.csv
expect 2 'shear angle = 0.785398 degrees: the rows cover 0.79 degrees' identify frame rad.csv "${frame[@]}"
expect 2 '--angle-unit rad if it is in radians' identify frame rad.csv "${frame[@]}"

# Relaxation: rows of the ramp, and time that counts from its start.
decay() { # OFFSET: theory of two branches, by time since the stop
  awk -v off="$1" 'BEGIN { print "time (s),load (N)"; for (i = 0; i < 60; ++i) {
    t = 0.02 * 10 ^ (i / 15); printf "%.9g,%.9g\n", t + off, 5 + exp(-t / 8) + exp(-t / 120) } }'
}
hold=(--side 200 --angle 30 --ramp 2 --fabric glass.toml -o out.toml)
decay 0 >stop.csv
expect 0 'in 8 s' identify relaxation stop.csv "${hold[@]}"
! "$program" identify relaxation stop.csv "${hold[@]}" 2>&1 | grep -q warning || fail 'stop.csv: a warning'
decay 2 >start.csv
expect 0 'if the time counts from the start of the ramp, take 2 s off all times' \
  identify relaxation start.csv "${hold[@]}"
(echo 'time (s),load (N)'
 for i in 1 2 3 4 5 6 7 8 9; do echo "0.$i,$i" | sed 's/,/,0./'; done
 decay 2 | tail -n +2) >ramp.csv
expect 2 'take the rows before line 11 out, and let time 0 be the stop: take 2 s' \
  identify relaxation ramp.csv "${hold[@]}"

# Laws are held against the ranges of the keys that they are written to.
awk -F, 'NR == 1 { print } NR > 1 { printf "%.9g,%s\n", $1 * 1e12, $2 }' stop.csv >slow.csv
expect 2 'comes out of the curves and must be at least' identify relaxation slow.csv "${hold[@]}"
awk -F, 'NR == 1 { print } NR > 1 { printf "%s,%.9g\n", $1, $2 * 1e6 }' stop.csv >strong.csv
expect 0 'is unusual, usually' identify relaxation strong.csv "${hold[@]}"
for i in 0 1 2; do
  awk -v f="$((24 + 40 * i))" 'BEGIN { print "displacement (mm),load (N)"
    for (x = 0; x <= 40; ++x) print x "," f }' >"pull$i.csv"
done
pulled=(pull0.csv pull1.csv pull2.csv --speeds 0.2 1 5 --viscosity 400 --from 20 -o friction.toml)
expect 0 'written: friction.toml' identify pull-out "${pulled[@]}" --pressures 0.05 0.05 0.05 --area 4000
expect 0 'is unusual, usually 0.01 to 2; check number and unit' \
  identify pull-out "${pulled[@]}" --pressures 50 50 50 --area 4000
expect 2 'comes out of the curves and must be at least' \
  identify pull-out "${pulled[@]}" --pressures 1e-308 0.05 0.05 --area 4000

# Compaction in kPa, of a table and of the formula.
pressed() { # NAME COMPACTION: a fabric
  cat <<END
[fabrics.$1]
surface_density = 600.0
thickness = 0.6
fibre_density = 2.55
warp = { density = 0.25, stiffness = 46000.0 }
weft = { density = 0.25, stiffness = 46000.0 }
shear = { polynomial = [0.4] }
compaction = $2
END
}
packed() { # TABLE STIFFNESS: a plate on two plies, one by each law
  pressed table "{ table = $1 }"
  pressed formula "{ stiffness = $2, exponent = 8.0, densest = 0.62 }"
  cat <<END
[blanks.square]
size = [20.0, 20.0]
element_size = 5.0
[[ply]]
name = "lower"
fabric = "table"
blank = "square"
angle = 0.0
[[ply]]
name = "upper"
fabric = "formula"
blank = "square"
angle = 0.0
[[tool]]
name = "floor"
shape = "plane"
[[tool]]
name = "press"
shape = "box"
size = [40.0, 40.0, 5.0]
position = [0.0, 0.0, 3.7]
motion = "driven"
direction = [0.0, 0.0, -1.0]
stroke = 0.3
END
}
packed '[[0.6, 0.0], [0.55, 20.0], [0.5, 100.0], [0.45, 400.0]]' 20000.0 >kpa.toml
expect 0 'table.1.1 = 20.0: is unusual, usually 0 to 5 N/mm2; check number and unit; so are 2 more' \
  check kpa.toml
expect 0 'compaction.stiffness = 20000.0: packs it to densest by 425.5 N/mm2, which is unusual' check kpa.toml
packed '[[0.6, 0.0], [0.55, 0.02], [0.5, 0.1], [0.45, 0.4]]' 20.0 >right.toml
"$program" check right.toml >right.txt 2>&1 || fail "right.toml: $(cat right.txt)"
! grep -q 'compaction.*unusual' right.txt || fail 'compaction in N/mm2 is called unusual'

# Exact curves with a stitch's pre-tension.
for pull in 0.05 0.1 0.2 0.4 0.8; do
  awk -v p="$pull" '/^slack/ { next } { print } /^stiffness = 24/ { print "pretension = " p }' ncf.toml >tight.toml
  for side in '' --negative; do
    "$program" theory frame --side 200 --fabric tight.toml --to 42 $side -o "theory$side.csv" >theory.txt
  done
  expect 0 "stiffness = 24 N per stitch, pre-tension $pull" identify frame theory.csv \
    --negative theory--negative.csv --stitch stitch --side 200 --fabric tight.toml -o found.toml
done

# A row of very many cells, in a time that goes with their number.
(echo 'strain,force_N'; for i in $(seq 0 29); do echo "$i,$((23 * i))" | sed 's/^/0.00/'; done
 awk 'BEGIN { for (i = 0; i < 400000; ++i) printf "1,"; print "" }') >wide.csv
expect 2 'error' identify warp wide.csv --fabric glass.toml -o out.toml
timeout 20 "$program" identify warp wide.csv --fabric glass.toml -o out.toml >wide.txt 2>&1 || [ $? != 124 ] ||
  fail 'a row of 400 000 cells takes more than 20 s'

exit $((failures > 0))
