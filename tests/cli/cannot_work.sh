#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Scenes that cannot work, and what `plyform check` says to each, as a page:
#   tests/cli/cannot_work.sh PROGRAM > docs/verification/cannot_work.md
#   tests/cli/cannot_work.sh PROGRAM PAGE   # answers 1 if the page is another
set -euo pipefail
program=$1 page=${2:-}
data=$(cd "$(dirname "${BASH_SOURCE[0]}")/../data/cannot_work" && pwd)

# said CHANGE...: errors and warnings, shortened to what the user reads after the place.
said() {
  local code=0 output changes=()
  for change; do changes+=(--set "$change"); done
  output=$(cd "$data" && "$program" check press.toml "${changes[@]}" 2>&1) || code=$?
  { grep -E '(error|warning): ' <<<"$output" || echo nothing; } |
    sed -E 's/^ *//; s/^[^ ]*:[0-9]+:[0-9]+: //; s/\|/\\|/g; s/of [0-9.e+]+ GB here, and .* of computing/of ... GB here, and ... of computing/' | awk '{ printf "%s%s", (NR > 1 ? "<br>" : ""), $0 }'
  [ "$code" != 0 ] || printf ' (exit code 0)'
}

make_page() {
  cat <<'END'
# Scenes that cannot work

What `plyform check` says to each, made by `tests/cli/cannot_work.sh` and held by a test. The case is [tests/data/cannot_work/press.toml](../../tests/data/cannot_work/press.toml), a ply pressed over a hemisphere with elements of 17 mm; the second column is what `--set` changes in it. Exit code 2 unless the line says 0; the place in the file, which stands before each message, is left out.

| what is wrong | change | `plyform check` |
|---|---|---|
END
  local title changes list
  while IFS='|' read -r title changes; do
    [[ -n $title && $title != \#* ]] || continue
    read -ra list <<<"$changes"
    printf '| %s | %s | %s |\n' "${title% }" "${list[*]:+\`${list[*]}\`}" \
      "$(said "${list[@]+"${list[@]}"}")"
  done <"$data/scenes.txt"
}

if [ -z "$page" ]; then
  make_page
else
  diff -u "$page" <(make_page) || { echo "$page is stale: make it anew"; exit 1; }
fi
