#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Rules of the house that no compiler checks:
#   tests/house_check.sh SOURCE_FOLDER
# Prints every breach as file:line and answers 1 if there is any.
set -euo pipefail
cd "$1"
breaches=0

# breach RULE LINES: counts and prints the lines, if any.
breach() {
  [ -n "$2" ] || return 0
  printf '%s:\n%s\n' "$1" "$2"
  breaches=$((breaches + 1))
}

mapfile -t files < <(
  find . -maxdepth 1 -type f ! -name .git
  find .ci base cases cmake contact core docs python tests tools -type f ! -path '*/__pycache__/*' 2>/dev/null
)
# of REGEX: those of the files whose path matches.
of() { printf '%s\n' "${files[@]}" | grep -E "$1" || true; }
mapfile -t sources < <(of '\.([ch]pp|cmake|cmake\.in|sh|pyi?|js|css|html)$|/CMakeLists\.txt$|^\./\.ci/run$')
mapfile -t cpp < <(of '\.[ch]pp$')
mapfile -t housed < <(of '^(\./)?(base|contact|core|python|tools)/.*\.[chi]pp$')
mapfile -t js < <(of '\.(js|css|html)$')
mapfile -t build < <(of '\.(cmake|sh)$|/CMakeLists\.txt$|/CMakePresets\.json$|^\./\.ci/run$')
mapfile -t scripts < <(of '\.sh$|^\./\.ci/run$')
mapfile -t texts < <(of '(^\./README|^\./docs/.*)\.md$')
[ ${#cpp[@]} -gt 0 ] || { echo "no C++ files under $1"; exit 1; }

breach "no SPDX line within the first three lines" "$(
  awk 'FNR == 1 { if (file != "" && !told) print file; file = FILENAME; told = 0 }
       FNR <= 3 && /SPDX-License-Identifier: GPL-3.0-or-later/ { told = 1 }
       FNR > 3 { nextfile }
       END { if (!told) print file }' "${sources[@]}"
)"

# A folder that exists on one machine only. -I leaves binary files out.
breach "path of somebody's machine" "$(
  grep -InE '(^|[^[:alnum:]_.}/-])/(home|root|work|tmp|Users|mnt|opt|media|srv)/' "${files[@]}" || true
)"

flags='[-](march|mtune|mcpu|mavx|msse|mfma|ffast-math|Ofast|funsafe-math|fassociative-math)'
# One binary runs everywhere and computes the same bits (comments may speak of the flags).
breach "flag that ties the program to one processor or changes its sums" "$(
  for file in "${build[@]}"; do
    allowed='none' # kernels are compiled for AVX2 and AVX-512 as well, to the same bits
    [ "$file" != cmake/simd.cmake ] || allowed='[-]mavx(2|512f|512vl|512dq)\>'
    sed -E "s/#.*//; s/$allowed//g" "$file" | grep -nE "$flags" | sed "s|^|$file:|" || true
  done
  grep -nE 'optimize *\(|#pragma +(GCC|clang) +(optimize|target)' "${cpp[@]}" || true
)"

breach "more than 400 lines" "$(
  wc -l "${cpp[@]}" "${js[@]}" | awk '$2 != "total" && $1 > 400 { print $2 ": " $1 " lines" }'
)"

# A function begins and ends at the left margin. Tables are long: functions that return rows of
# keys, and arrays.
breach "function of more than 60 lines" "$(
  awk '
    FNR == 1 { start = 0 }
    /^[A-Za-z].*\{$/ && !/^(namespace|struct|class|enum|union|extern)/ && !/rows\(\) \{$|\] = \{$/ { start = FNR }
    /^[A-Za-z].*\($|^[A-Za-z].*,$/ && !start { start = FNR }
    /^[};]/ {
      if (start && FNR - start + 1 > 60 && /^\}/) print FILENAME ":" start ": " FNR - start + 1 " lines"
      start = 0
    }
  ' "${cpp[@]}"
)"

# fmt::format and fmt::print within plyform are those of base/format.hpp, which print numbers or words.
breach "includes <fmt/format.h> in the place of base/format.hpp" "$(
  grep -n '^#include <fmt/format.h>' "${housed[@]}" | grep -vE '^(\./)?base/format\.hpp:' || true
)"

# Arrows between rooms run one way: tests/rooms.txt. Of C++ by what is included, of the workbench by what its
# Python and JavaScript import.
mapfile -t workbench < <(of '^(\./)?tools/workbench/.*\.(py|js)$')
breach "includes a file of a room that its own must not know (tests/rooms.txt)" "$(
  awk '
    function meets(to, what) {
      if (!(room in order)) print FILENAME ": stands in no room of tests/rooms.txt"
      else if (to != room && !((room, to) in may)) print FILENAME ":" FNR ": " what
    }
    FILENAME == "tests/rooms.txt" {
      if (!NF || $0 ~ /^#/) next
      order[$1] = ++rooms
      for (i = 2; i <= NF; ++i) may[$1, $i] = 1
      for (i = 2; i <= NF; ++i) if ($i in order) print "tests/rooms.txt:" FNR ": " $1 " -> " $i " runs back up"
      next
    }
    FNR == 1 { room = FILENAME; sub(/^\.\//, "", room); sub(/\/[^\/]*$/, "", room) }
    /^#include "(base|core|contact|python|tools|support)\// {
      split($0, part, "\"")
      to = part[2]; sub(/\/[^\/]*$/, "", to)
      all = to; sub(/\/.*/, "/*", all)
      meets((room, all) in may ? room : to, part[2])
    }
    /^ *from (\.\.?|workbench\.)[a-z_.]* import / { # of a room, or of a file beside rooms
      to = $2 ~ /^\.\./ ? substr(room, 1, match(room, /\/[^\/]*$/) - 1) : $2 ~ /^\./ ? room : "tools/workbench"
      name = $2; sub(/^(\.+|workbench\.)/, "", name); sub(/\..*/, "", name)
      meets(to "/" name in order ? to "/" name : to, $2)
    }
    match($0, /(from |import\()"workbench\/[^"]+"/) {
      to = substr($0, RSTART, RLENGTH); sub(/^[^\/]*/, "tools/workbench/web", to); sub(/\/[^\/]*$/, "", to)
      meets(to, to)
    }
  ' tests/rooms.txt "${housed[@]}" "${workbench[@]}"
)"

# Within a room headers make no circle, nor do sources, each taken with the header of its name.
breach "files of a room include one another in a circle" "$(
  awk '
    FNR == 1 {
      unit = FILENAME; sub(/^\.\//, "", unit)
      kind = unit ~ /\.cpp$/ ? "sources" : "headers"
      sub(/\.[a-z]+$/, "", unit)
      room = unit; sub(/\/[^\/]*$/, "", room)
    }
    /^#include "/ {
      split($0, part, "\"")
      to = part[2]; sub(/\.[a-z]+$/, "", to)
      of = to; sub(/\/[^\/]*$/, "", of)
      if (of == room && to != unit) arrow[kind SUBSEP unit SUBSEP to]
    }
    END { # what includes nothing that is left, or is included by nothing, is in no circle
      do {
        split("", includes); split("", included); taken = 0
        for (a in arrow) {
          split(a, end, SUBSEP)
          includes[end[1], end[2]]; included[end[1], end[3]]
        }
        for (a in arrow) {
          split(a, end, SUBSEP)
          if ((end[1], end[3]) in includes && (end[1], end[2]) in included) continue
          delete arrow[a]
          taken = 1
        }
      } while (taken)
      for (a in arrow) {
        split(a, end, SUBSEP)
        print end[1] ": " end[2] " -> " end[3]
      }
    }
  ' "${housed[@]}" | sort
)"

# Files that comments name, by any end of their path.
breach "comment names a file that does not exist" "$(
  printf '%s\n' "${files[@]}" | awk '
    FILENAME == "-" {
      for (path = $0; path != ""; path = sub(/^[^\/]*\//, "", path) ? path : "") known[path]
      next
    }
    match($0, /\/\/.*/) {
      rest = substr($0, RSTART)
      while (match(rest, /[a-z0-9_\/]+\.(hpp|cpp|py|sh|md|js)($|[^A-Za-z0-9_])/)) {
        name = substr(rest, RSTART, RLENGTH); sub(/[^a-z]$/, "", name); sub(/^\/+/, "", name)
        if (!(name in known)) print FILENAME ":" FNR ": " name
        rest = substr(rest, RSTART + RLENGTH)
      }
    }
  ' - "${cpp[@]}"
)"

breach "script that cannot be executed" "$(
  for file in "${scripts[@]}"; do
    [ -x "$file" ] || echo "$file"
  done
)"

# Commands and links in the texts. A name in capitals (tools/NAME.sh) stands for something else.
folders='(\.ci|base|cases|cmake|contact|core|docs|python|tests|tools)'
path='(^|[[:space:]`(])(\./)?'$folders'/[[:alnum:]_./-]*[[:alnum:]_/]'
breach "names a file that does not exist" "$(
  for file in "${texts[@]}"; do
    grep -noE "$path" "$file" |
      while IFS=: read -r line name; do
        name=$(tr -d '[:space:]`(' <<<"$name")
        [[ $name =~ [A-Z]{2} || -e $name ]] || echo "$file:$line: $name"
      done
    grep -noE '\]\([^)#:]+' "$file" |
      while IFS=: read -r line name; do
        [[ $name =~ ^..https?$ || -e $(dirname "$file")/${name#](} ]] || echo "$file:$line: ${name#](}"
      done
  done
)"

[ "$breaches" -eq 0 ] || exit 1
echo "${#files[@]} files follow the rules of the house"
