#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# plyform chart as a user meets it: runs, table and picture; a second time nothing is run; what
# changes is run anew; mistakes, stopped runs and Ctrl-C.
#   tests/cli/chart_test.sh PROGRAM CASES_FOLDER
set -euo pipefail
. "$(dirname "${BASH_SOURCE[0]}")/expect.sh"
program=$1 cases=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp -r "$cases" "$folder/cases"
cd "$folder"
# logs: names and times of all runs' results; a run writes a new file.
logs() { stat -c '%n %y' out/runs/*/results.h5; }

cat >tiny.toml <<'END_OF_STUDY'
title = "Tiny <study> & more"
case = "cases/bias_extension"
settings = ["blanks.strip.element_size=25", "solver.duration=0.02", "solver.fibre_softening=300",
            "solver.outputs=1"]
presets = ["draft"]
[reference]
step = 1.0
[[dial]]
name = "fibre softening"
key = "solver.fibre_softening"
values = [100, 300, 1000]
[[dial]]
name = "element size"
key = "element_size"
values = [2]
END_OF_STUDY

# Six runs, of which 300 is the case's own.
expect 0 '6/6 runs' chart tiny.toml -o out --jobs 2
[ "$(ls out/runs | wc -l)" = 6 ] || fail "runs: $(ls out/runs)"
[ "$(wc -l <out/chart.csv)" = 8 ] || fail "chart.csv: $(cat out/chart.csv)"
python3 - out/chart.svg <<'END_OF_CHECK' || fail "chart.svg is not as it should be"
import sys
import xml.etree.ElementTree as tree
texts = ["".join(e.itertext()) for e in tree.parse(sys.argv[1]).iter("{http://www.w3.org/2000/svg}text")]
for wanted in ("Tiny <study> & more", "fibre softening", "element size", "draft", "100", "1000",
               "×2", "case", "reference run"):
    assert wanted in texts, f"{wanted} is not among {texts}"
assert not any("nan" in text for text in texts)
END_OF_CHECK
# Every run but the reference has an error, none of them 0; triangles in a quarter of the number.
awk -F, 'NR > 2 && !($7 > 0 && $7 <= $9 && $8 <= $9 && ($11 == "done" || $11 == "doubtful")) { bad = 1 } END { exit bad }' \
  out/chart.csv || fail "errors: $(cat out/chart.csv)"
[ "$(awk -F, '$1 == "reference" { print $6 / 4 }' out/chart.csv)" = \
  "$(awk -F, '$1 == "case" { print $6 }' out/chart.csv)" ] || fail "elements: $(cat out/chart.csv)"

before=$(logs) table=$(cat out/chart.csv)
expect 0 '6/6 runs were done before' chart tiny.toml -o out
[ "$before" = "$(logs)" ] || fail "runs were repeated: $before then $(logs)"
[ "$table" = "$(cat out/chart.csv)" ] || fail "the second table differs"

# One more value, one run that was broken off: two runs more, the others stay.
sed -i 's/1000\]/1000, 3000]/' tiny.toml
rm out/runs/case/summary.json
expect 0 '7/7 runs' chart tiny.toml -o out
changed=$(diff <(echo "$before") <(logs) | sed -n 's/^> \(.*\)results.h5.*/\1/p' | tr '\n' ' ' || true)
[ "$changed" = "out/runs/case/ out/runs/fibre_softening=3000/ " ] || fail "run anew: $changed"

# Another fabric: everything.
echo '# another' >>cases/fabrics/glass_plain_weave.toml
before=$(logs)
expect 0 '7/7 runs' chart tiny.toml -o out
[ "$(comm -12 <(echo "$before" | sort) <(logs | sort) | wc -l)" = 0 ] || fail "old runs were kept"

# The folder's name unless told; a run that stops is a row, and no failure.
sed 's/"fibre softening"/"balance"/; s/"solver.fibre_softening"/"solver.max_balance_error"/
     s/\[100, .*\]/[1e-12]/' tiny.toml >stops.toml
expect 0 'run balance=1e-12 stopped' chart stops.toml
grep -q '^balance,solver.max_balance_error=1e-12,.*,stopped,0$' results/stops/chart.csv ||
  fail "no stopped run in $(cat results/stops/chart.csv)"
# The reference that stops ends it all.
sed 's/^step = 1.0/&\nsettings = ["solver.max_balance_error=1e-12"]/' tiny.toml >ends.toml
expect 3 'run reference stopped' chart ends.toml
[ ! -e results/ends/chart.csv ] || fail "a chart without a reference"

sed 's/100, 300/0.1, 300/' tiny.toml >wrong.toml
expect 2 'wrong.toml:11:11: error: dial.0.values.0 = 0.1: does not fit the case' chart wrong.toml
[ ! -e results/wrong ] || fail "a wrong study has run"
expect 1 'study is required' chart

# Ctrl-C: the finished runs stay, the same command goes on.
sed 's/solver.duration=0.02/solver.duration=0.05/' tiny.toml >long.toml
"$program" chart long.toml --jobs 1 >log 2>&1 &
for _ in $(seq 600); do # until the first state of the reference is written
  [ -e results/long/runs/reference/results.h5 ] && break
  sleep 0.05
done
kill -INT $!
wait $! && code=0 || code=$?
[ "$code" = 1 ] && grep -q 'interrupted; finished runs are kept' log ||
  fail "Ctrl-C: exit code $code; $(cat log)"
[ ! -e results/long/runs/reference/settings.txt ] || fail "the broken-off run counts as done"
echo "$failures failed"
[ "$failures" = 0 ]
