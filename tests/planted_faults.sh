#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Do the tests see a fault of contact, or of a law of cloth? Copies the sources, plants one fault after
# the other, builds the short tests and runs those of contact and of laws:
#   tests/planted_faults.sh [SCRATCH_FOLDER [REGEX]]
#   tests/planted_faults.sh --places      only whether each fault has its place: a second
# A folder that is given is kept, and the next call builds only what has changed; with REGEX only
# faults whose names match. Prints a table of faults and the first test that fails, and does not run
# the rest; answers 1 if a fault makes no test fail, or if one fails without.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# NAME | FILE | what sed does to it. Each must change its file.
faults=(
  "normals of tools point inward | contact/forces/tool_ply.cpp | s/normal_of(c) = s.normal;/normal_of(c) = -s.normal;/"
  "normals beside edges of profiles point to the edge, inside as outside | contact/shapes/profile.cpp | s/d \* (sign \/ length)}/d \/ length}/"
  "normals beside edges of mesh tools point to the edge, inside as outside | contact/shapes/mesh_shape.cpp | s/d \* (sign \/ length)}/d \/ length}/"
  "normal force between plies pulls | contact/simd/ply_ply_point_forces.hpp | s/SimdForces f{p.memory.normal_force \* normal/SimdForces f{-p.memory.normal_force * normal/"
  "boxes of the search: one triangle in 64 is never a candidate | contact/search/sheet_bvh.cpp | s/if (candidate.distance2 <= reach \* reach)/if (candidate.distance2 <= reach * reach \&\& face % 64 != 7)/"
  "boxes of the search are not brought up to date | core/solver/contact_search.cpp | s/^ *ply.tree->refit(ply.x);//"
  "contacts of plies are listed without the skin | core/solver/follow_thickness.cpp | s/layup.thickest \* distance + layup.skin/layup.thickest * distance/"
  "what may have closed its gap is looked at too late, plies | contact/search/active_list.hpp | s/if (list.free_until\[i\] > now)/if (list.free_until[i] + 0.5 > now)/"
  "a fold round a face is taken for a tenth of what it is | contact/simd/ply_ply_closest.hpp | s/return larger(distance, all(k.distance))/return 0.1 * larger(distance, all(k.distance))/"
  "bounds of folds are renewed by searches only | core/solver/follow_folds.cpp | s/if (ply.fold_motion > .*/if (ply.fold_motion > 1e300) renew_fold_bounds(ply);/"
  "the face across an edge is never the closest | contact/simd/ply_ply_closest.hpp | s/chosen = mask_of(g.real) \& (tied/chosen = Longs{} \& (tied/"
  "a ply keeps those on its sides apart past its rim | core/solver/occlusion.cpp | s/^ *char inside = .*/occluded[static_cast<std::size_t>(c.node)] = 1; char inside = 1;/"
  "the first node near a tool is not listed | contact/forces/tool_ply.cpp | s/if (room > reach) {/if (room > reach || contact.points.empty()) {/"
  "friction between plies is forgotten at a search | contact/forces/ply_ply.cpp | s/c.memory = before->memory;//"
  "friction with tools is forgotten at a search | contact/forces/tool_ply.cpp | s/point = old\[next_old++\];/point = old[next_old++], point.memory = {};/"
  "plies touch each other at half their thickness | core/solver/make_contacts.cpp | s/0.5 \* (slave.thickness + master.thickness)/0.25 * (slave.thickness + master.thickness)/"
  "plies touch tools at half their half thickness | core/solver/make_contacts.cpp | s/half_thickness = 0.5 \* plies\[p\].thickness/half_thickness = 0.25 * plies[p].thickness/"
  "depth between plies has no limit | core/solver/make_contacts.cpp | s/deepest_in_ply \* pair.contact.distance/1e9/"
  "contacts close by any way in a step | core/solver/time_step.cpp | s/std::min(ratio, largest_growth)/largest_growth/"
  "the stable step takes contacts for as soft as shallow ones | contact/forces/contact_law.hpp | s/per2 \* law.tangent(depth_ahead(law, -gap \* per))/per2 * law.stiffness/"
  "every other edge is not looked at | contact/forces/edge_search.cpp | s/if (gap > skin) continue;/if (gap > skin || near[i][1] % 2 == 1) continue;/"
  "ridges towards each other are taken for those of parallel shells | contact/search/sheet_ridges.cpp | s/dot > 0.0 ? swapped : sides_b/dot < 0.0 ? swapped : sides_b/"
  "edges push towards each other | contact/forces/edge_edge.cpp | s/return pair.side \* along_a/return -pair.side * along_a/"
  "the balance of a pushed tool takes contact for linear | contact/forces/pushed_tool.cpp | s/const double rate = area \* law->stiffness \* per_room \* per_room;/const double rate = area * law->stiffness;/"
  "the stable step knows no couples of friction | contact/forces/contact_tangent.cpp | s/if (spring.across > 0.0)/if (spring.across < 0.0)/"
  "friction takes tools for standing still | contact/simd/tool_ply_kernel.cpp | s/motions(k, g) - everywhere(k.tool_motion)/motions(k, g)/"
  "friction takes tools to move the other way | contact/simd/tool_ply_kernel.cpp | s/motions(k, g) - everywhere(k.tool_motion)/motions(k, g) + everywhere(k.tool_motion)/"
  "films see simulated speeds | contact/forces/contact_law.hpp | s/dt \* contact.process_time/dt/"
  "each of two passes of plies has the whole film | core/solver/make_contacts.cpp | s/law.share = 0.5/law.share = 1.0/"
  "a film lets go where faces open by less than its thickness | core/solver/make_contacts.cpp | s/law.sliding_gap = std::min(/law.sliding_gap = 0.0 * std::min(/"
  "nodes at a rim have films on all of their area | contact/forces/sliding_point.cpp | s/std::max(share, least_share) \* own/std::max(1.0 + 0.0 * share, least_share) * own/"
  "friction by the angle of fibres takes them for parallel | contact/forces/sliding_point.cpp | s/law.by_angle(std::acos(/law.by_angle(0.0 * std::acos(/"
  "stitches push where they are slack | core/ply/membrane_simd_yarns.hpp | s/beyond = larger(all(0.0), stretch - law.taut_at)/beyond = stretch - law.taut_at/"
  "broken stitches pull again | core/ply/membrane_simd_yarns.hpp | s/n\[a\] = (breaks | gone) ? all(0.0)/n[a] = breaks ? all(0.0)/"
  "what broken stitches had stored is not lost | core/ply/membrane_simd_yarns.hpp | s/torn += (breaks \& ~gone) ? was .*/torn += all(0.0);/"
  "a law of shear of both signs is that of positive angles | core/model/shear_law.cpp | s/plus = at(g), minus = at(-g);/plus = at(g), minus{-plus.value, plus.slope, plus.energy};/"
  "cells of crimp pull one family alone | core/model/crimp.cpp | s/a.tension \* a.cosine, b.tension \* b.cosine/a.tension * a.cosine, 0.0/"
  "pressed cloth does not resist shear | core/solver/thickness_forces.cpp | s/const Vec3 at_b = -w/const Vec3 at_b = -0.0 * w/"
  "sheared cloth is as thick as before | core/ply/thickness.cpp | s/return std::sqrt(ratio2);/return 1.0 + 0.0 * ratio2;/"
  "cloth goes back as it came | contact/simd/contact_law_simd.hpp | s/if (!k.compacted) {/if (true) {/"
  "air pushes on nodes that contact holds on each other | core/solver/vacuum_contact.cpp | s/const double borne = q/const double borne = 0.0 * q/"
  "friction does not feel a vacuum | contact/simd/ply_ply_point_forces.hpp | s/return {pull, on .* (1.0 - open), k.stuck/return {pull, all(0.0), k.stuck/"
  "opening between yarns is the change of area | core/run/output_state.cpp | s/now \/ before \/ (1.0 + family.strain\[e\]) - 1.0/now \/ before - 1.0/"
  "bending beyond a plane of symmetry pulls the wrong way | core/ply/bending_simd_kernel.cpp | s/mirror_images(block, false, force);//"
  "the shear of an image keeps its sign | core/run/whole_frame.cpp | s/return {c, first.sign \* second.sign};/return {c, 1.0};/"
  "a part is pressed by the force on the whole | core/setup/part_of_scene.cpp | s/divide_forces(tool, 2.0)/divide_forces(tool, 1.0)/"
  "plies alone have the room of the whole stack | core/setup/instant.cpp | s/tool_clearance.push_back(others.thickness)/tool_clearance.push_back(0.0 * others.thickness)/"
)
filter='*Contact*:*Oracle*:*Ridges*:Candidates*:PointTriangle*:ToolShape*:MeshShape*:Profile*:Run.Carries*:Run.Needs*:Step.Driven*:CapstanScene*:SlopeScene*:MomentumScene*:Impact*:EdgeEdgeContact*:*Stitch*:*Shear*:*Crimp*:Families*:ClosedMould*:Compaction*:MembraneSimd*:*Friction*:Enclosure*:BendingSimd*:PartOfScene*:Instant*'

# plant LINE: the fault's file with the fault in it, on standard output.
plant() {
  local rest=${1#* | }
  sed "${rest#* | }" "${rest%% | *}"
}

if [ "${1:-}" = --places ]; then
  lost=0
  for line in "${faults[@]}"; do
    rest=${line#* | }
    ! plant "$line" | cmp -s - "${rest%% | *}" || { echo "${rest%% | *}: no place for: ${line%% | *}"; lost=1; }
  done
  exit $lost
fi

if [ $# -gt 0 ]; then
  mkdir -p "$1"
  scratch=$(cd "$1" && pwd)
else
  scratch=$(mktemp -d)
  trap 'rm -rf "$scratch"' EXIT
fi
# Only what differs is copied, so that only that is compiled anew; what has gone here goes there.
(cd "$scratch" && find . \( -path ./build -o -name __pycache__ \) -prune -o -type f -print) |
  while read -r file; do
    [ -e "$file" ] || rm "$scratch/$file"
  done
find . \( -path ./build -o -path ./results -o -path ./.git -o -name __pycache__ \) -prune -o -type f -print |
  while read -r file; do
    cmp -s "$file" "$scratch/$file" || install -D -p -m 755 "$file" "$scratch/$file"
  done
cd "$scratch"
mkdir -p build
log=build/log planted=build/planted original=build/original
launcher=()
if command -v ccache >/dev/null; then
  launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  export CCACHE_BASEDIR=/ CCACHE_NOHASHDIR=1 # the same sources in another folder are known
fi
cmake --preset release "${launcher[@]}" >"$log" || { cat "$log"; exit 1; }

build() {
  cmake --build build/release --target contact_tests core_tests scenes_tests >"$log" 2>&1 || {
    tail -n 40 "$log"
    echo "planted_faults.sh: error: does not build: $1" >&2
    exit 1
  }
}

# failing: the first test that fails, or the program that crashes or hangs; nothing if none does.
failing() {
  local program code
  for program in contact_tests core_tests scenes_tests; do
    code=0
    timeout 600 "build/release/tests/$program" --gtest_filter="$filter" --gtest_fail_fast \
      >"$log" 2>&1 || code=$?
    case $code in
      0) continue ;;
      1) grep -m1 -oE '^\[  FAILED  \] [A-Za-z/]+\.[A-Za-z0-9/]+' "$log" | sed 's/.*\] //' ;;
      *) echo "$program, which ended with code $code" ;;
    esac
    return
  done
}

build "the sources as they are"
found=$(failing)
[ -z "$found" ] || { printf 'planted_faults.sh: error: a test fails without a fault: %s\n' "$found" >&2; exit 1; }

unseen=0
printf '| fault | the first test that fails |\n|---|---|\n'
for line in "${faults[@]}"; do
  name=${line%% | *} rest=${line#* | }
  file=${rest%% | *}
  [[ $name =~ ${2:-.} ]] || continue
  plant "$line" >"$planted"
  if cmp -s "$planted" "$file"; then
    echo "planted_faults.sh: error: $file has no place for the fault: $name" >&2
    exit 1
  fi
  cp "$file" "$original"
  cat "$planted" >"$file"
  build "$name"
  found=$(failing)
  cat "$original" >"$file"
  [ -n "$found" ] || unseen=$((unseen + 1))
  printf '| %s | %s |\n' "$name" "${found:-**none**}"
done
[ "$unseen" -eq 0 ] || { echo "planted_faults.sh: $unseen faults make no test fail" >&2; exit 1; }
