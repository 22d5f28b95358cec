#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What may be written over: outputs of before, never what is read, a run's own files or those of others.
#   tests/cli/outputs_test.sh PROGRAM CASES_FOLDER
set -euo pipefail
program=$1 cases=$2 tests=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
. "$tests/expect.sh"
cd "$folder"

cp -r "$cases/fabrics" fabrics
mkdir case
cp "$cases/hemisphere_0/case.toml" case
short=(--threads 1 --set blanks.square.mesh_from=element_size --set blanks.square.element_size=34
  --set solver.duration=0.002 --set tool.0.stroke=0.5 --set solver.outputs=2)
expect 0 'results are in run' run case "${short[@]}" -o run

# kept ARGUMENT...: refused with 2 and the words; no file is another than before.
kept() {
  local before after
  before=$(find . -type f ! -name 'part_*' -exec md5sum {} + | sort)
  expect 2 'would overwrite' "$@"
  after=$(find . -type f ! -name 'part_*' -exec md5sum {} + | sort)
  [ "$before" = "$after" ] || fail "plyform $*: "$'\n'"$(diff <(echo "$before") <(echo "$after"))"
}

if python3=$(command -v /usr/bin/python3) && "$python3" -c 'import h5py, scipy, ezdxf, jinja2' 2>/dev/null; then
  for file in run/results.h5 run/history.csv run/summary.json run/plies/ply.csv case/case.toml; do
    kept report run -o "$file"
  done
  ln -s ../run/results.h5 case/elsewhere.h5
  kept report run -o case/elsewhere.h5
  expect 0 page.html report run -o page.html
  expect 0 page.html report run -o page.html # its own, again
  kept map run --format csv -o run/plies
  printf 'x,y\n-30,-30\n30,-30\n30,30\n-30,30\n' >pattern.csv
  expect 2 'would overwrite' pattern run --trim pattern.csv -o .
  [ "$(head -n 1 pattern.csv)" = x,y ] || fail "the trim line is overwritten"
  expect 0 cut/pattern.csv pattern run --trim pattern.csv -o cut
  expect 0 cut/pattern.csv pattern run --trim pattern.csv -o cut
fi

# export: the run's tables, and meshes that it has not written itself
kept export run --format csv -o run/plies
mkdir tools
printf 'solid punch\nendsolid punch\n' >tools/punch.stl
expect 2 'tools/punch.stl: would overwrite it' export run --format stl -o tools
[ "$(head -c 5 tools/punch.stl)" = solid ] || fail "the mesh of a tool is overwritten"
expect 0 exported/punch.stl export run -o exported
expect 0 exported/punch.stl export run -o exported

# run: files of other programs, whatever is in their way
mkdir -p foreign/plies
for file in summary.json history.csv results.xdmf results.h5 plies/old.csv; do
  printf '{"of": "another program"}\n' >"foreign/$file"
  kept run case "${short[@]}" -o foreign
  rm "foreign/$file"
done
expect 0 'results are in foreign' run case "${short[@]}" -o foreign
expect 0 'results are in foreign' run case "${short[@]}" -o foreign # a former run's are replaced
mkdir linked out
ln -s ../out linked/plies
kept run case "${short[@]}" -o linked
[ -z "$(ls out)" ] || fail "a run has written through a link"

# --resume: an ended run of this case, and not of another one
expect 0 'there is nothing to resume' run case "${short[@]}" -o run --resume
expect 2 'is of another case' run case "${short[@]}" -o run --resume --set solver.outputs=3
sed -i 's/^stiffness = 46000.*/stiffness = 46001.0/' fabrics/glass_plain_weave.toml
expect 2 'is of another case' run case "${short[@]}" -o run --resume

# Python: what is read stays what it is under another name, and no more once another file has its inode
PYTHONPATH="$tests/../../tools" /usr/bin/python3 - <<'END' || fail "what Python reads"
import os, pathlib
from base import ending, outputs
one, other = pathlib.Path("one"), pathlib.Path("other")
one.write_text("1")
outputs.note_read(one, one.stat())
os.link(one, other)
try:
    outputs.check_output(other)
    raise SystemExit(1)
except ending.Mistake:
    pass
one.unlink()
outputs.check_output(other)
END
echo "$failures failed"
[ "$failures" = 0 ]
