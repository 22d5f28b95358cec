#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# plyform identify and theory as a user meets them: laws found again, exit codes, messages.
#   tests/cli/identify_test.sh PROGRAM CASES_FOLDER
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/expect.sh"
program=$1 cases=$2 fabric=$2/fabrics/glass_plain_weave.toml
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$fabric" "$folder/glass.toml"
cp -r "$2/hemisphere_0" "$folder/case"
cd "$folder"
# expect_law FILE KEY VALUE TOLERANCE: the first number of a key, within a relative tolerance.
expect_law() {
  local found
  found=$(sed -n "s/^$2 = \[*\([-+.0-9e]*\).*/\1/p" "$1" | head -n 1)
  awk -v a="$found" -v b="$3" -v t="$4" 'BEGIN { d = a / b - 1; exit !(d * d <= t * t) }' ||
    fail "$1: $2 starts with $found, expected $3"
}

bias=(--length 300 --width 100 --fabric glass.toml)
stiff=(--compliance 0) # the curves are of theory: no machine gives way

# There and back, and the written file in a case.
expect 0 'bias.csv, 61 rows' theory bias "${bias[@]}" --to 55 --points 60 -o bias.csv
expect 0 'k1 = 0.37044, k3 = 0.84105, k5 = 1.0311' \
  identify bias bias.csv "${bias[@]}" -o found.toml
expect_law found.toml polynomial 0.37044 1e-6
[ "$(head -n 1 found_fit.csv)" = displacement_mm,shear_deg,measured_N,fitted_N ] ||
  fail 'found_fit.csv: header'
[ "$(wc -l <found_fit.csv)" = 62 ] || fail 'found_fit.csv: rows'
grep -q '^# .*from bias.csv' found.toml || fail 'found.toml does not say where its law is from'
grep -q 'Hamila' found.toml || fail 'found.toml has lost the comment of its base'
sed -i 's|^glass = .*|glass = "../found.toml"|' case/case.toml
grep -q found.toml case/case.toml || fail 'the case does not use the fabric found'
expect 0 'the case is sound' check case --set blanks.square.element_size=34
expect 0 'frame.csv' theory frame --side 200 --fabric glass.toml --to 50 -o frame.csv
expect 0 'plot: tools/plot.py fit fit.csv -o fit.png' identify frame frame.csv \
  --side 200 --fabric glass.toml --coefficients 3 --to 45 -o found.toml --fit fit.csv
expect_law found.toml polynomial 0.37044 1e-6

# For programs: the law with its limits, or why there is none.
# expect_json FILE PYTHON: an expression of the report j.
expect_json() {
  python3 -c 'import json, sys; j = json.load(open(sys.argv[1])); sys.exit(not eval(sys.argv[2]))' "$1" "$2" ||
    fail "$1: not $2"
}
expect 0 'written: found.toml' identify bias bias.csv "${bias[@]}" -o found.toml --report found.json
expect_json found.json 'j["status"] == "done" and j["test"] == "bias" and j["output"] == "found.toml"'
expect_json found.json '[n["name"] for n in j["numbers"][:3]] == ["k1", "k3", "k5"]'
expect_json found.json 'abs(j["numbers"][0]["value"] / 0.37044 - 1) < 1e-6'
expect_json found.json '0 <= j["numbers"][0]["limits"] < 1e-5 and j["numbers"][0]["unit"] == "N mm"'
expect_json found.json '{"name": "rows", "unit": "", "value": 61.0, "limits": None} in j["numbers"]'
awk -F, 'NR == 1 { print } NR > 1 { print $1 "," -$3 }' bias.csv >below.csv
expect 2 'error' identify bias below.csv "${bias[@]}" -o never.toml --report found.json
expect_json found.json 'j["status"] == "refused" and j["errors"][0]["file"] == "below.csv"'
expect_json found.json 'j["errors"][0]["rule"] and j["errors"][0]["remedy"] and "numbers" not in j'
cp bias.csv kept.csv
expect 2 'report = ./bias.csv: would overwrite' identify bias bias.csv "${bias[@]}" -o never.toml \
  --report ./bias.csv
cmp -s bias.csv kept.csv || fail 'bias.csv: the report of its refusal stands in its place'

# A law of both signs: its other side in the test the other way round, and a law identified in its
# place is the same both ways.
sed 's|^polynomial = .*|&\nnegative_polynomial = [0.037044, 0.084105, 0.103113]|' glass.toml >two.toml
expect 0 'negative.csv' theory frame --side 200 --fabric two.toml --to 50 --negative -o negative.csv
paste -d, frame.csv negative.csv |
  awk -F, 'NR > 2 && (0.1 * $3 - $6) ^ 2 > 1e-12 * $6 ^ 2 || NR > 2 && $2 != -$5 { bad = 1 }
           END { exit bad }' || fail 'negative.csv: not a tenth of frame.csv at negative angles'
expect 0 'its law of shear is one of both signs' \
  identify frame frame.csv --side 200 --fabric two.toml --to 45 -o one.toml
expect_law one.toml polynomial 0.37044 1e-6
! grep -q negative_polynomial one.toml || fail 'one.toml: half of the law before is left'

# A curve 2 % below theory gives a law 2 % low: that is what reading (40) backwards does.
awk -F, -v OFS=';' 'NR > 1 { print $1, 0.98 * $3 }' bias.csv >low.csv
expect 0 'shear angle 0 to 55 degrees' identify bias low.csv "${bias[@]}" -o low.toml
expect_law low.toml polynomial 0.3630312 1e-6

# A fabric without any law gets all three, one after the other.
printf 'surface_density = 600\nthickness = 0.6\n[warp]\ndensity = 0.25\n[weft]\ndensity = 0.25\n' \
  >bare.toml
expect 2 'shear: is missing' theory bias --length 300 --width 100 --fabric bare.toml --to 30 -o x.csv
awk 'BEGIN { for (i = 0; i <= 20; i++) print i / 10 "\t" i * 11500 * 25 / 1000 / 10 }' >strip.csv
expect 0 'still without a law: weft' \
  identify warp strip.csv --yarns 25 --gauge-length 250 --fabric bare.toml -o warp.toml --compliance 0
expect_law warp.toml stiffness 2875 1e-6
awk 'BEGIN { for (i = 0; i <= 50; i++) print i / 5000 "," 4e6 * (i / 5000) ^ 2 }' >yarn.csv
expect 0 'table of 20 rows' identify weft yarn.csv --fabric warp.toml -o both.toml
expect 0 'strain 0 to 0.01' identify weft yarn.csv --fabric warp.toml -o both.toml
expect 0 'bias-extension' identify bias bias.csv --length 300 --width 100 \
  --fabric both.toml -o all.toml
sed -i 's|^glass = .*|glass = "../all.toml"|' case/case.toml
expect 0 'the case is sound' check case --set blanks.square.element_size=34
[ "$(grep -c '^# Identified' all.toml)" = 3 ] || fail 'all.toml does not name three tests'

# What is wrong with the curve.
go() { expect 2 "$1" identify bias "$2" "${bias[@]}" -o never.toml "${@:3}"; }
go 'nosuch.csv:1:1: error: the curve cannot be opened' nosuch.csv
go 'y-column = 4: the rows have 3 columns' bias.csv --y-column 4
go 'did you mean force_N?' bias.csv --y-column force
go 'shear_deg = deg: is an angle, the load must be a force; take --y-column force_N' bias.csv \
  --y-column shear_deg
(cat low.csv; sed '1!G;h;$!d' low.csv) >unloaded.csv
go 'if the test was unloaded there, take out the rows from line 63 on' unloaded.csv
awk -F';' -v OFS=';' '{ print $1, -$2 }' low.csv >negative.csv
go 'turn the sign of the column round' negative.csv
awk -F';' -v OFS=';' '{ print -$1, -$2 }' low.csv >turned.csv
go 'the extension falls from the first row on' turned.csv
head -n 6 low.csv >short.csv
go '5 rows with a shear angle above 0 within the range, 3 coefficients need at least 6' short.csv
go 'degrees of shear angle, there must be at least 5' short.csv --coefficients 2
awk -F';' -v OFS=';' '{ print 10 * $1, $2 }' low.csv >far.csv
go 'the extension must be less than 82.84 mm' far.csv
awk -F';' -v OFS=';' '{ print $1, $2 * (NR % 2 ? 0.5 : 1.5) }' low.csv >scattered.csv
go 'they must be less than 20 %' scattered.csv
printf '1;2\n3,5;4\n' >comma.csv
go 'comma.csv:2:1: error: column 1 = 3,5: must be a number; write a decimal point' comma.csv
awk -F';' -v OFS=';' '{ print $1, $2 * (NR % 2 ? 0.95 : 1.05) }' low.csv >rough.csv
expect 0 'warning: noise' identify bias rough.csv "${bias[@]}" -o rough.toml

# What a machine adds: told, refused, taken off.
grep -q 'compliance of machine' <("$program" identify bias bias.csv "${bias[@]}" -o x.toml 2>&1) ||
  fail 'nothing on a compliance that is not given'
if "$program" identify bias bias.csv "${bias[@]}" "${stiff[@]}" -o x.toml 2>&1 | grep warning; then
  fail 'a warning for the curve of theory'
fi
rm x.toml x_fit.csv
awk -F, -v OFS=, 'NR > 1 { $3 += 0.9 } { print $1, $3 }' bias.csv >zero.csv
go 'the rows show a load zero off by 0.9 N' zero.csv "${stiff[@]}"
expect 0 'taken off zero.csv: load zero 0.9 N' identify bias zero.csv "${bias[@]}" --zero fit \
  "${stiff[@]}" -o found.toml
expect_law found.toml polynomial 0.37044 1e-4
expect 0 'load zero 0.9 N' identify bias zero.csv "${bias[@]}" --zero 0.9 "${stiff[@]}" -o found.toml
expect_law found.toml polynomial 0.37044 1e-5
expect 0 'residuals 7' identify bias zero.csv "${bias[@]}" --yes-doubtful "${stiff[@]}" -o found.toml
awk -F, -v OFS=, 'NR > 1 { $1 += 0.02 * $3 } { print $1, $3 }' bias.csv >soft.csv
expect 0 'compliance 0.02 mm/N' identify bias soft.csv "${bias[@]}" --compliance 0.02 -o found.toml
expect_law found.toml polynomial 0.37044 1e-6
awk -F, -v OFS=, 'NR > 1 { $1 += (NR > 30 ? 5 : 0) } { print }' bias.csv >slip.csv
go 'a slip of 5 mm' slip.csv "${stiff[@]}" --angle-column none
expect 0 'slip 5 mm' identify bias slip.csv "${bias[@]}" --slip fit "${stiff[@]}" -o found.toml
expect_law found.toml polynomial 0.37044 1e-3
expect 0 'the measured shear angle (shear_deg) is up to' identify bias slip.csv "${bias[@]}" \
  --angle-column none --yes-doubtful -o found.toml
for column in '' '--angle-column shear_deg'; do # a column of measured angles counts
  expect 0 'the law is of the measured angle' identify bias slip.csv "${bias[@]}" $column \
    -o found.toml
done
expect_law found.toml polynomial 0.37044 1e-5
awk -F, -v OFS=, 'NR > 1 { print $1, $3 / 1000 }' bias.csv >kilo.csv
go 'is no fabric' kilo.csv
expect 0 'k1 = 0.37044' identify bias kilo.csv "${bias[@]}" --y-unit kN -o found.toml
go 'zero = none: must be a number or fit' zero.csv --zero none
go 'compliance = -1: must be at least 0' zero.csv --compliance -1
go 'nothing to correct: the angle is measured' slip.csv --angle-column shear_deg --compliance 0.01

# Slip: the formula beside measured angles, angles of a second file, and what is told without.
awk -F, -v OFS=, 'NR > 1 { $1 *= 1.05 } { print }' bias.csv >slide.csv
expect 0 '4.8 % of the work of the load goes into what slips' identify bias slide.csv "${bias[@]}" \
  -o found.toml
expect_law found.toml polynomial 0.37044 1e-5
expect 0 'the formula without slip would say 10.5 degrees for 10' identify bias slide.csv \
  "${bias[@]}" -o found.toml
awk -F, 'NR == 1 || NR > 5 { print $1 "," $2 "," $2 * 2 }' slide.csv >angles.csv
sed -i '1s/.*/d (mm),image (deg),photo (deg)/' angles.csv
cut -d, -f1,3 slide.csv >loads.csv
expect 0 '4 rows beyond' identify bias loads.csv "${bias[@]}" --angle-file angles.csv:2 \
  -o found.toml
expect 0 'formula without slip' identify bias loads.csv "${bias[@]}" --angle-file angles.csv \
  --angle-column 'image (deg)' -o found.toml
expect_law found.toml polynomial 0.37044 1e-3
go '2 columns may be the shear angle: image (deg)' loads.csv --angle-file angles.csv
go 'has the angles of one specimen, but 2 curves are given' loads.csv bias.csv \
  --angle-file angles.csv:2
go 'has the angles of one specimen, but 2 curves are given' loads.csv --negative bias.csv \
  --angle-file angles.csv:2
go 'would overwrite angles.csv' loads.csv --angle-file angles.csv:2 --fit angles.csv
expect 0 'yarns slip in such tests from about 30 degrees on' identify bias bias.csv "${bias[@]}" \
  "${stiff[@]}" -o found.toml
if "$program" identify bias bias.csv "${bias[@]}" --to 30 "${stiff[@]}" -o found.toml |
  grep -q 'yarns slip'; then
  fail 'slip is told of a test that ends at 30 degrees'
fi

# A normalised shear force over a measured angle, a column a laboratory: any frame.
awk -F, 'BEGIN { print "shear_angle_deg,A,B,C" }
         NR > 1 { g = $2 * atan2(0, -1) / 180; c = 400 * cos(atan2(1, 1) - g / 2)
                  printf "%s,%.12g,%s,%.12g\n", $2, $3 / c, (NR > 5 ? "" : 1), 2 * $3 / c }' \
  frame.csv >norm.csv
frame=(--y-unit N/mm --fabric glass.toml -o found.toml)
expect 0 'normalised shear force' identify frame norm.csv:A "${frame[@]}"
expect_law found.toml polynomial 0.37044 1e-6
grep -q 'from norm.csv:A:' found.toml || fail 'found.toml does not name the column'
grep -q 'loads are of one of 200 mm' found.toml || fail 'found.toml does not say its frame'
expect 0 'loads are of one of 50 mm' identify frame norm.csv:C "${frame[@]}" --side 50
expect_law found.toml polynomial 0.74088 1e-6
cp norm.csv nor:m.csv
expect 0 'from nor:m.csv:A, norm.csv:C' identify frame nor:m.csv:A norm.csv:C "${frame[@]}" \
  --yes-doubtful
expect 2 'y-column = D: is no column of the header' identify frame norm.csv:D "${frame[@]}"
expect 2 'side: must be given' identify frame norm.csv:A --fabric glass.toml -o never.toml
expect 2 'angle-column = none: the curve has no extension' identify frame norm.csv:A "${frame[@]}" \
  --angle-column none
go 'y-unit = N/mm: is a force per length, the load must be a force' norm.csv:A --y-unit N/mm
# Laws that are no polynomials: curves that others measured.
measured=$(dirname "$fabric")/../measured
printf 'surface_density = 743\nthickness = 1.2\n[warp]\ndensity = 0.193\n[weft]\ndensity = 0.193\n' \
  >weave.toml
expect 0 'static torque and polynomial of 3: cross-validated' identify bias \
  "$measured/bias_plain_150x450.csv" --length 450 --width 150 --fabric weave.toml -o stuck.toml
grep -q '^# static torque and polynomial of 3: cross-validated' stuck.toml ||
  fail 'stuck.toml does not say why its law was chosen'
grep -q '^table = \[' stuck.toml || fail 'stuck.toml has no table'
expect 0 'table of 6 points: as asked for' identify bias "$measured/bias_plain_150x450.csv" \
  --length 450 --width 150 --fabric weave.toml --points 6 -o stuck.toml
expect 2 'the torque of the rows falls from' identify bias "$measured/bias_plain_115x230.csv" \
  --length 230 --width 115 --fabric weave.toml -o never.toml
expect 0 'misfit of the torque over the range' identify bias "$measured/bias_plain_115x230.csv" \
  --length 230 --width 115 --fabric weave.toml --to 50 -o stuck.toml
awk -F, -v OFS=, 'BEGIN { print "angle (deg),force (N)" } NR > 1 && $4 != "" {
  p = atan2(0, -1) / 4 * (1 - $1 / 90); print $1, 400 * cos(p) * $4 }' \
  "$measured/picture_frame_plain.csv" >stuck.csv
expect 0 'the curve does not show whether they are a static torque' identify \
  frame stuck.csv --angle-column 1 --side 200 --fabric weave.toml -o stuck.toml
go 'points = 30: must be 1 to 20' bias.csv --points 30
go 'coefficients = 3: is of a polynomial, but a table is asked for' bias.csv --points 3 \
  --coefficients 3
go 'points = 3: is of a table, but --law static is asked for' bias.csv --law static --points 3

# Laboratories: A and B have 1 and 3 times the law, C of two curves twice, so that the mean is twice the law and the
# deviation once.
awk -F, -v OFS=, 'NR == 1 { print $1, "A", "B", "C1", "C2" }
                  NR > 1 { print $1, $2, 3 * $2, 1.5 * $2, (NR < 98 ? 2.5 * $2 : "") }' \
  norm.csv >labs.csv
laboratories=(--y-unit N/mm --fabric glass.toml -o labs.toml)
expect 0 'laboratories differ by 50 % of the torque at 10, 50 % at 20, 50 % at 30, 50 % at 40' \
  identify frame A=labs.csv:A B=labs.csv:B C=labs.csv:C1 C=labs.csv:C2 "${laboratories[@]}"
for part in "_minus 1" " 2" "_plus 3"; do
  read -r ending factor <<<"$part"
  [ -n "$factor" ] || { factor=$ending ending=; }
  expect 0 'l.csv, 10 rows' theory frame --side 200 --fabric "labs$ending.toml" --to 45 \
    --points 9 -o l.csv
  expect 0 'g.csv, 10 rows' theory frame --side 200 --fabric glass.toml --to 45 --points 9 -o g.csv
  paste -d, l.csv g.csv | awk -F, -v f="$factor" \
    'NR > 5 { d = $3 / $6 / f - 1; if (d * d > 0.02 ^ 2) bad = 1 } END { exit bad }' ||
    fail "labs$ending.toml: not $factor times the law"
done
grep -q '^# the mean less one standard deviation' labs_minus.toml || fail 'labs_minus.toml: which?'
[ "$(head -n 1 labs_laboratories.csv)" = \
  shear_deg,mean_Nmm,between_Nmm,within_Nmm,laboratories,A,B,C ] || fail 'labs_laboratories.csv'
expect 0 'from 4 laboratories, 4 curves' identify frame labs.csv:A labs.csv:B labs.csv:C1 \
  labs.csv:C2 --laboratories "${laboratories[@]}"
awk -F, -v OFS=, 'NR == 1 { print $1, "A", "B" }
                  NR > 1 { print $1, ($1 < 25 ? $2 : ""), 1.02 * $2 }' norm.csv >close.csv
expect 0 'laboratories agree within 5 %: they differ by 1.4 % of the torque at 10, 1.4 % at 20 degrees' \
  identify frame close.csv:A close.csv:B --laboratories "${laboratories[@]}"
sed 's|,B,|,bad,|' labs.csv | awk -F, -v OFS=, 'NR > 1 { $3 = -$3 } { print }' >turn.csv
expect 2 'bad: the load must not be below 0' identify frame labs.csv:A turn.csv:bad labs.csv:C1 \
  --laboratories "${laboratories[@]}"
expect 2 '--skip-refused goes on without the curve' identify frame labs.csv:A turn.csv:bad \
  labs.csv:C1 --laboratories "${laboratories[@]}"
expect 0 'bad is left out: the load must not be below 0' identify frame labs.csv:A turn.csv:bad \
  labs.csv:C1 --laboratories --skip-refused "${laboratories[@]}"
expect 2 'leaves less than two laboratories' identify frame labs.csv:A turn.csv:bad \
  --laboratories --skip-refused "${laboratories[@]}"
expect 2 'has no laboratory, but others have' identify frame A=labs.csv:A labs.csv:B \
  "${laboratories[@]}"
expect 2 'is the only one' identify frame A=labs.csv:A A=labs.csv:B "${laboratories[@]}"
expect 2 'would overwrite labs_minus.toml' identify frame A=labs.csv:A B=labs.csv:B \
  --y-unit N/mm --fabric labs_minus.toml -o labs.toml
expect 2 'names a laboratory, as only bias and frame take them' identify warp A=strip.csv \
  B=strip.csv --fabric glass.toml -o never.toml

# Several specimens.
for n in 1 2 3; do
  awk -F, -v OFS=, -v f="0.9$n" 'NR > 1 { $3 *= f } { print $1, $3 }' bias.csv >"part$n.csv"
done
expect 0 '3 specimens, standard deviation of the torque between them 1.1 %' identify bias \
  part1.csv part2.csv part3.csv "${bias[@]}" "${stiff[@]}" -o found.toml
expect_law found.toml polynomial 0.3408 1e-3
[ "$(head -n 1 found_fit.csv)" = displacement_mm,shear_deg,measured_N,fitted_N,specimen ] ||
  fail 'found_fit.csv: header of several specimens'
grep -q '^# Identified by plyform .* from part1.csv, part2.csv, part3.csv:' found.toml ||
  fail 'found.toml does not name its specimens'
expect 0 'part1.csv:1:1: warning: curve 3 has the same numbers in every row as curve 1' identify bias \
  part1.csv part2.csv part1.csv "${bias[@]}" "${stiff[@]}" -o found.toml
go 'would overwrite part2.csv' part1.csv part2.csv --fit part2.csv

# Bending and compression.
printf 'overhang_mm,angle_deg\n140,41.5\n141,41.5\n139,41.5\n' >hang.csv
expect 0 'bending length 69' identify cantilever hang.csv --direction both --fabric glass.toml \
  -o bent.toml
[ "$(grep -c '^bending_stiffness = ' bent.toml)" = 2 ] || fail 'bent.toml: warp and weft'
awk 'BEGIN { print "deflection (mm),force (N)"; for (i = 0; i <= 30; i++) print i / 5 "," i * 48 * 2 * 50 / 5 / 60 ^ 3 }' >three.csv
expect 0 'bending_stiffness = 2 N mm' identify three-point three.csv --span 60 --width 50 \
  --direction warp --fabric bent.toml --compliance 0 -o bent2.toml
expect_law bent2.toml bending_stiffness 2 1e-4
awk 'BEGIN { print "deflection (mm),force (N)"; for (i = 0; i <= 60; i++) { m = i / 1200; print 900 * (m / 12 + 25 * m ^ 3) "," 200 * m / 60 } }' >soften.csv
expect 0 'bending_table of 7 rows, 3.9' identify three-point soften.csv --span 60 --width 50 \
  --direction warp --fabric bent.toml --compliance 0 -o bent5.toml
grep -q '^bending_table = ' bent5.toml || fail 'bent5.toml has no table'
expect 0 'k1 = 0.37044' identify bias bias.csv "${bias[@]:0:4}" --fabric bent5.toml -o bent6.toml
awk 'BEGIN { print "s (mm),gamma (deg)"; for (i = 0; i <= 30; i++) print i * 2 "," 8 - 6 * exp(-i * 2 / 10) }' >zone.csv
expect 0 'zone 10 mm wide' identify in-plane-bending zone.csv --direction both --fabric bent2.toml \
  -o bent3.toml
awk 'BEGIN { print "strain,force (N)"; for (i = 0; i <= 40; i++) { e = i / 4000; print e "," (e < 0.005 ? 460 * e : 2.3 + 4.6 * (e - 0.005)) } }' >press.csv
expect 0 'buckling_force = 2.3 N per yarn' identify compression press.csv --direction warp \
  --fabric bent3.toml -o bent4.toml
sed -i 's|^glass = .*|glass = "../bent4.toml"|' case/case.toml
expect 0 'the case is sound' check case --set blanks.square.element_size=34
expect 2 'shear: is missing' identify in-plane-bending zone.csv --direction both --fabric bare.toml \
  -o never.toml

# Specimens of two kinds: both signs of shear, the stitch that they differ by, warp and weft.
taut=(--compliance 0 --toe 0)
sides=(--side 200 --fabric glass.toml "${taut[@]}")
expect 0 'frame.csv' theory frame --side 200 --fabric two.toml --to 45 -o frame.csv
expect 0 'negative.csv' theory frame --side 200 --fabric two.toml --to 45 --negative -o negative.csv
expect 0 'torque of negative angles over that of positive ones 0.1 at' \
  identify frame frame.csv --negative negative.csv "${sides[@]}" -o signs.toml
expect_law signs.toml polynomial 0.37044 1e-6
expect_law signs.toml negative_polynomial 0.037044 1e-6
expect 0 'no difference beyond scatter, one law for both signs' \
  identify frame frame.csv --negative frame.csv "${sides[@]}" -o signs.toml
! grep -q negative_polynomial signs.toml || fail 'signs.toml: both signs of one law'
cp "$2/fabrics/ncf_biaxial_pillar.toml" ncf.toml
for test in 'frame --side 200' 'bias --length 300 --width 100'; do
  expect 0 'stitches pull' theory $test --fabric ncf.toml --to 50 -o drawn.csv
  expect 0 'stitches pull' theory $test --fabric ncf.toml --to 50 --negative -o slack.csv
  sed 's/^stiffness = 24.0/stiffness = 1.0/; s/^slack = .*//; s/^breaking_force = .*//' ncf.toml \
    >unknown.toml
  expect 0 'stiffness = 24 N per stitch, slack up to an elongation of 0.02' identify $test \
    drawn.csv --negative slack.csv --fabric unknown.toml --stitch stitch "${taut[@]}" -o found.toml
  expect_law found.toml polynomial 1.225 1e-3
  sed -n '/^\[\[stitch/,$p' found.toml >stitch.toml
  expect_law stitch.toml stiffness 24 1e-2
  expect_law stitch.toml breaking_force 4.2 3e-2
  expect 0 'taken off: what stitch pulls' identify $test drawn.csv --fabric ncf.toml "${taut[@]}" \
    -o found.toml
  grep -q '^\[\[crossing\]\]' found.toml || fail 'found.toml has lost its crossing'
done
frames=(frame drawn.csv --negative slack.csv --side 200 --fabric ncf.toml)
expect 2 'stitch = tricot: is no stitch of the fabric; it has stitch' identify "${frames[@]}" \
  --stitch tricot -o never.toml
expect 2 'needs curves of both signs' identify frame drawn.csv --side 200 --fabric ncf.toml \
  --stitch stitch -o never.toml
expect 2 'the curves show no stitch' identify frame frame.csv --negative frame.csv --side 200 \
  --fabric unknown.toml --stitch stitch "${taut[@]}" -o never.toml
expect 2 'would overwrite slack.csv' identify "${frames[@]}" --fit slack.csv -o never.toml
for n in 1 2 3; do
  for yarns in warp:46000 weft:43000; do
    awk -v k="${yarns#*:}" -v n="$n" 'BEGIN { for (i = 0; i <= 20; i++)
      print i / 2000 "," k * i / 2000 * (1 + 0.004 * (n - 2)) }' >"${yarns%:*}$n.csv"
  done
done
expect 0 'weft over warp, tension per yarn: 0.935' identify warp warp[123].csv --weft weft[123].csv \
  --fabric glass.toml -o both.toml
expect 0 'they differ, and the fabric is not balanced' identify warp warp[123].csv \
  --weft weft[123].csv --fabric glass.toml -o both.toml
[ "$(grep -c '^stiffness = 4[36]000' both.toml)" = 2 ] || fail 'both.toml: warp and weft'
expect 0 'no difference beyond scatter' identify warp warp[123].csv --weft warp[123].csv \
  --fabric glass.toml -o both.toml
printf 'overhang_mm,angle_deg\n120,41.5\n121,41.5\n119,41.5\n' >short_hang.csv
expect 0 'weft over warp, bending stiffness: 0.63' identify cantilever hang.csv --direction warp \
  --weft short_hang.csv --fabric glass.toml -o both.toml

# Biaxial tension: straight yarns and crimps; what curves do not show.
biaxial() { # RATIO: a balanced cell of 46 kN, crimp 0.5 %, strained in both directions alike
  awk -v k=46000 -v c=0.005 'BEGIN { print "warp_strain,weft_strain,warp_load_N,weft_load_N"
    for (i = 0; i <= 40; i++) { e = i * 0.0004; h = c * (2 + c); l = sqrt((1 + e) ^ 2 + h)
      n = k * (l / (1 + c) - 1) * (1 + e) / l; print e "," e "," n "," n } }'
}
biaxial >equal.csv
awk -v k=46000 -v c=0.005 'BEGIN { print "warp strain,warp load (N)"
  for (i = 0; i <= 40; i++) { e = i * 0.0004; n = k * ((1 + e) / (1 + c) - 1); print e "," (n > 0 ? n : 0) } }' >free_weft.csv
sed '1s/.*/weft strain,weft load (N)/' free_weft.csv >free_warp.csv
expect 0 'stiffness = 46000 N per straight yarn, crimp 0.005' identify biaxial equal.csv \
  free_weft.csv free_warp.csv --fabric glass.toml -o crimped.toml
expect_law crimped.toml ratio 0.005 1e-3
sed -i 's|^glass = .*|glass = "../crimped.toml"|' case/case.toml
expect 0 'the case is sound' check case --set blanks.square.element_size=34
expect 2 'all of one strain ratio' identify biaxial equal.csv --fabric glass.toml -o never.toml
cut -d, -f1-3 equal.csv >one_load.csv
expect 2 'weft_strain: is the only column whose name says weft' identify biaxial one_load.csv --fabric glass.toml \
  -o never.toml
expect 2 'no column says that it is of warp or weft' identify biaxial strip.csv --fabric glass.toml \
  -o never.toml

# What is wrong with options and files.
expect 2 'length = 150: must be at least twice the width' identify bias low.csv --length 150 \
  --width 100 --fabric glass.toml -o never.toml
go 'coefficients = 9: must be 1 to 6' low.csv --coefficients 9
go 'to = 5: must be greater than --from, 10' low.csv --from 10 --to 5
go 'would overwrite low.csv' low.csv --fit ./low.csv
go 'would overwrite never.toml' low.csv --fit never.toml
cp glass.toml before.toml
expect 2 'would overwrite glass.toml' identify bias low.csv "${bias[@]}" -o case/../glass.toml
cmp -s glass.toml before.toml || fail 'the base has been overwritten'
printf 'fibre_angle = 60.0\n%s\n' "$(cat glass.toml)" >oblique.toml
expect 2 'fibre_angle = 60: must be 90 degrees' identify frame frame.csv --side 200 \
  --fabric oblique.toml -o never.toml
expect 2 'yarns = 0: must be greater than 0' identify warp yarn.csv --yarns 0 \
  --fabric glass.toml -o never.toml
expect 2 'to = 90: must be above 0 and below 90' theory bias "${bias[@]}" --to 90 -o never.csv
expect 1 'nosuch/never' identify bias low.csv "${bias[@]}" -o nosuch/never.toml
expect 2 '--length is required' identify bias low.csv --width 100 --fabric glass.toml -o never.toml
expect 2 'subcommand is required' identify
for file in never.toml never_fit.csv never.csv x.csv; do
  [ ! -e "$file" ] || fail "a mistake has written $file"
done

# Rubber: a law for a sheet that has none, loads by width, both constants of curves both ways.
rubber() { # C10 C01 STRETCH both|one: strain and nominal stress
  awk -v a="$1" -v b="$2" -v to="$3" -v way="$4" -v OFMT=%.12g -v CONVFMT=%.12g 'BEGIN {
    print "strain,stress_MPa"
    for (i = 0; i <= 40; ++i) {
      l = 1 + (to - 1) * i / 40
      s = way == "both" ? 2 * (l - l^-5) * (a + b * l * l) : 2 * (l - l^-2) * (a + b / l)
      print l - 1 "," s
    }
  }'
}
printf 'surface_density = 1650.0\nthickness = 1.5\n' >sheet.toml
rubber 0.16 0.04 2.2 one >one.csv
rubber 0.16 0.04 1.8 both >both.csv
rubber 0.15 0 2 one | awk -F, -v CONVFMT=%.12g 'NR == 1 { print "stretch,load_N" } NR > 1 { print 1 + $1 "," 9 * $2 }' >load.csv
expect 0 'C10 = 0.16, C01 = 0.04 N/mm2' identify uniaxial one.csv --equibiaxial both.csv --fabric sheet.toml \
  -o rubber.toml --report rubber.json
expect_law rubber.toml c10 0.16 1e-5
expect_law rubber.toml stretch_limit 2.2 1e-3
expect_json rubber.json 'j["numbers"][1]["name"] == "C01" and abs(j["numbers"][1]["value"] / 0.04 - 1) < 1e-5'
expect 0 'shear modulus 0.3 N/mm2' identify uniaxial load.csv --width 6 --fabric rubber.toml -o neo.toml
expect_law neo.toml shear_modulus 0.3 1e-5
grep -q mooney neo.toml && fail 'neo.toml keeps the law before'
expect 2 'is missing: load_N is a force' identify uniaxial load.csv --fabric sheet.toml -o never.toml
expect 2 'must be neo_hookean, mooney_rivlin, or missing' identify uniaxial one.csv --fabric glass.toml \
  -o never.toml

# What flows: frames of 200 mm at several speeds and temperatures, relaxation, pull-out.
rated() { # SPEED DEGC [wlf]: torque 0.4 g + (0.3 + g^2) f(T) dg/dt, 0.25 x 0.25 yarns/mm, 45 kJ/mol
  awk -v v="$1" -v t="$2" -v wlf="${3:-}" -v OFMT=%.12g -v CONVFMT=%.12g 'BEGIN {
    print "extension_mm,load_N"
    D = 200 * sqrt(2)
    f = exp(45000 / 8.31446261815324 * (1 / (t + 273.15) - 1 / 453.15))
    if (wlf) f = exp(-log(10) * 8 * (t - 180) / (110 + t - 180))
    for (i = 0; i <= 60; ++i) {
      d = 70 * i / 60; s = (1 + d / D)^2 - 1; g = atan2(s, sqrt(1 - s * s))
      rate = 2 * (1 + d / D) / (D * sqrt(1 - s * s))
      print d "," 0.0625 * 40000 * (0.4 * g + (0.3 + g * g) * f * v * rate) * rate
    }
  }'
}
sed 's/^density = .*/density = 0.25/' glass.toml >flow.toml
rated 0.5 180 >slow.csv
rated 5 180 >middle.csv
rated 50 180 >fast.csv
rated 5 210 >warm.csv
expect 0 'c0 = 0.3, c2 = 1 N mm s' identify frame slow.csv middle.csv fast.csv --speeds 0.5 5 50 \
  --side 200 --fabric flow.toml -o rates.toml --report rates.json "${stiff[@]}"
expect_law rates.toml viscosity 0.3 1e-5
expect_law rates.toml polynomial 0.4 1e-5
expect_json rates.json 'any(n["name"] == "c2" and abs(n["value"] - 1) < 1e-5 for n in j["numbers"])'
expect 0 'Arrhenius, activation energy 45 ' identify frame slow.csv middle.csv fast.csv warm.csv \
  --speeds 0.5,5,50,5 --temperatures 180,180,180,210 --side 200 --fabric flow.toml -o warm.toml "${stiff[@]}"
expect_law warm.toml activation_energy 45 1e-4
expect_law warm.toml reference 180 1e-9
for celsius in 180 150 210 240; do
  for speed in 5 50; do rated "$speed" "$celsius" wlf >"wlf_${celsius}_$speed.csv"; done
done
wlf=(wlf_180_5.csv wlf_180_50.csv wlf_150_5.csv wlf_150_50.csv wlf_210_5.csv wlf_210_50.csv wlf_240_5.csv
  wlf_240_50.csv --speeds 5,50,5,50,5,50,5,50 --temperatures 180,180,150,150,210,210,240,240 --side 200)
expect 0 'WLF, C1 8 ' identify frame "${wlf[@]}" --fabric flow.toml -o wlf.toml "${stiff[@]}"
expect_law wlf.toml c1 8 1e-3
expect_law wlf.toml c2 110 1e-3
expect 0 'viscosity over 150 to 240 degC: table' identify frame "${wlf[@]}" --temperature-law table \
  --fabric flow.toml -o table.toml "${stiff[@]}"
grep -q '^    \[150, ' table.toml || fail "table.toml: $(cat table.toml)"
expect 2 'needs tests at 3 temperatures' identify frame slow.csv middle.csv warm.csv --speeds 0.5,5,5 \
  --temperatures 180,180,210 --temperature-law wlf --side 200 --fabric flow.toml -o never.toml "${stiff[@]}"
expect 2 'needs --temperatures beside it' identify frame slow.csv middle.csv --speeds 0.5,5 \
  --temperature-law wlf --side 200 --fabric flow.toml -o never.toml
expect 2 'must differ by a factor of 2' identify frame slow.csv middle.csv --speeds 5 6 --side 200 \
  --fabric flow.toml -o never.toml "${stiff[@]}"
expect 2 'must be one for each of the 2 curves' identify frame slow.csv middle.csv --speeds 5 --side 200 \
  --fabric flow.toml -o never.toml
expect 2 'needs --speeds beside it' identify frame slow.csv middle.csv --temperatures 180 200 --side 200 \
  --fabric flow.toml -o never.toml
awk -v OFMT=%.12g -v CONVFMT=%.12g 'BEGIN {
  print "time_s,load_N"
  for (i = 0; i <= 80; ++i) {
    t = i ? 0.05 * 10^((i - 1) / 25) : 0
    print t "," 10 + 6 * exp(-t / 0.8) + 3 * exp(-t / 25)
  }
}' >stop.csv
expect 0 'N mm in 0.8 s' identify relaxation stop.csv --side 200 --angle 30 --fabric flow.toml -o stop.toml
grep -q '^relaxation = ' stop.toml || fail 'stop.toml has no branches'
expect 2 'must be between 0 and 90' identify relaxation stop.csv --side 200 --angle 90 --fabric flow.toml \
  -o never.toml
for speed in 0.2 1 5; do # a power law of the Hersey number, 400 Pa s and 0.05 N/mm2
  awk -v v="$speed" 'BEGIN { print "displacement_mm,load_N"
    for (i = 0; i <= 40; ++i) print 2 * i "," 400 * (0.0004 * v / 0.05)^0.3 * (i > 2) }' >"pull_$speed.csv"
done
expect 0 'Hersey numbers 0.0016 to 0.04 mm' identify pull-out pull_0.2.csv pull_1.csv pull_5.csv \
  --speeds 0.2 1 5 --pressures 0.05 0.05 0.05 --viscosity 400 --area 4000 --from 20 -o friction.toml
grep -q '^\[friction.pull_out\]' friction.toml || fail 'friction.toml has no law'
grep -q '0.0016, 0.14' friction.toml || fail "friction.toml: $(cat friction.toml)"
expect 2 'must be one for each of the 3 curves' identify pull-out pull_0.2.csv pull_1.csv pull_5.csv \
  --speeds 0.2 1 --pressures 0.05 0.05 0.05 --viscosity 400 --area 4000 -o never.toml
expect 2 'may have only letters' identify pull-out pull_0.2.csv pull_1.csv pull_5.csv --speeds 0.2 1 5 \
  --pressures 0.05 0.05 0.05 --viscosity 400 --area 4000 --name 'a]b' -o never.toml

printf '%s\n' 'fibre volume fraction,pressure (kPa)' 0.52,0 0.545,101.4 0.570,344.7 0.600,827.4 \
  0.665,2757.9 0.685,6894.8 >pressed.csv
pressed_base=$cases/fabrics/glass_plain_weave_compaction.toml
expect 0 'table of 6 rows' identify compaction pressed.csv --fabric "$pressed_base" -o pressed.toml
grep -q '0.4127967, 0.3447' pressed.toml || fail "pressed.toml: $(cat pressed.toml)"
expect 0 'Va = ' identify compaction pressed.csv --law gutowski --fabric "$pressed_base" -o pressed.toml
expect 2 'no packing goes above' identify compaction pressed.csv --x-unit % --fabric "$pressed_base" \
  -o never.toml --x-column 2 --y-column 1 --y-unit MPa
expect 2 'must be greater than 0' identify compaction pressed.csv --layers 0 --fabric "$pressed_base" -o never.toml
expect 2 'is missing: fibre volumes follow' identify compaction pressed.csv \
  --fabric "$cases/fabrics/glass_pp_plain.toml" -o never.toml

echo "$failures failed"
[ "$failures" = 0 ]
