#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tests of a program that is installed (docs/users/install.md), beside its own scripts and cases:
#   tests/installed.sh [PROGRAM]      the plyform of the PATH unless given
# Those of the page are left out where Chromium or its driver is missing.
set -euo pipefail
tests=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
program=$(command -v "${1:-plyform}")
share=$(cd "$(dirname "$(readlink -f "$program")")/../share/plyform" && pwd)
tools=$share/tools cases=$share/cases
module=$(/usr/bin/python3 -c 'import pathlib, plyform; print(pathlib.Path(plyform.__file__).parents[1])')
failed=0

# passes NAME COMMAND...: says whether it does, with the end of what it printed if not; 77 is skipped.
passes() {
  local name=$1 log code=0
  shift
  log=$(mktemp)
  "$@" >"$log" 2>&1 || code=$?
  case $code in
    0) echo "passed   $name" ;;
    77) echo "skipped  $name: $(tail -n 1 "$log")" ;;
    *)
      echo "FAILED   $name"
      tail -n 20 "$log"
      failed=$((failed + 1))
      ;;
  esac
  rm -f "$log"
}
# of Python: never with what lies beside the sources
script() { passes "$1" env PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 "$tests/python/$1.py" "${@:2}"; }

"$program" --version
passes cli "$tests/cli/cli_test.sh" "$program" "$cases"
passes identify "$tests/cli/identify_test.sh" "$program" "$cases"
passes robust "$tests/cli/robust_test.sh" "$program" "$cases"
script report_encoding_test "$tools"
script report_kinds_test "$tools" "$program" "$cases"
script study_test "$tools" "$cases" "$program"
script exchange_files_test "$tools"
script mesh_tool_test files "$tools" "$program" "$cases"
script module_scene_test "$module" "$program" "$tests/.."
script studio_edits_test "$tools" "$cases"
script studio_cases_test "$tools" "$program"
script studio_safety_test "$tools" "$program"
script studio_runs_test started "$tools" "$program" "$cases"
[ "$failed" = 0 ] || { echo "$failed failed"; exit 1; }
