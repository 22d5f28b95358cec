#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the libFuzzer targets, as many at a time as there are cores, each for so many seconds:
#   tests/fuzz/run.sh SECONDS [TARGET]...      all: case fabric curve results
#                                           checkpoint stl obj ply off dxf
# Seeds are tests/fuzz/corpus/TARGET; what is learned stays in build/asan/corpus, and a file that a
# target goes down on, or hangs or swells on, in build/asan/finds: mend the reader, then put the
# file into tests/fuzz/corpus/TARGET, where a test replays it. Answers 1 if there is any.
set -euo pipefail
seconds=${1:?how many seconds? tests/fuzz/run.sh SECONDS [TARGET]...}
shift
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=(case fabric curve results checkpoint stl obj ply off dxf)

tools/build.sh asan fuzzers
folder=$PWD/build/asan
mkdir -p "$folder/finds" "$folder/logs"
# words of case and fabric files, as keys.md lists them
sed -n 's/^| `\([^`]*\)`.*/\1/p' docs/users/keys.md | sed 's/.*[.]//; s/\[\]//; s/.*/"& = "/' |
  sort -u >"$folder/keys.dict"

run_one() {
  local target=$1 options=()
  mkdir -p "$folder/corpus/$target"
  case $target in case | fabric) options=(-dict="$folder/keys.dict") ;; esac
  ASAN_OPTIONS=detect_leaks=1:allocator_may_return_null=1:suppressions=$PWD/tests/fuzz/asan.txt \
    "$folder/tests/fuzz/fuzz_$target" \
    -max_total_time="$seconds" -timeout=25 -rss_limit_mb=4096 -max_len=65536 -print_final_stats=1 \
    -artifact_prefix="$folder/finds/$target-" "${options[@]}" \
    "$folder/corpus/$target" "tests/fuzz/corpus/$target" >"$folder/logs/$target.log" 2>&1
}

cores=$(nproc)
declare -A of=()
failed=()
reap() {
  local done_pid='' code=0
  wait -n -p done_pid || code=$?
  [ "$code" = 0 ] || failed+=("${of[$done_pid]}")
  unset "of[$done_pid]"
}
for target in "${targets[@]}"; do
  [ ${#of[@]} -lt "$cores" ] || reap
  run_one "$target" &
  of[$!]=$target
done
while [ ${#of[@]} -gt 0 ]; do reap; done

total=0
for target in "${targets[@]}"; do
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$folder/logs/$target.log")
  printf '%-10s %10s executions in %s s\n' "$target" "${runs:-?}" "$seconds"
  total=$((total + ${runs:-0}))
done
for target in ${failed[@]+"${failed[@]}"}; do
  echo "== $target: found something; build/asan/logs/$target.log ends with"
  tail -n 40 "$folder/logs/$target.log"
done
echo "${#targets[@]} targets, $total executions, ${#failed[@]} with finds"
[ ${#failed[@]} = 0 ]
