#!/usr/bin/env bash
# Plants faults in shaders and host sources, one at a time, and runs the cases that have to find them.
# Usage: planted_faults.sh BUILD-FOLDER [shaders|host]. Prints each with what found it; exit status 1
# when one was not found. Shaders are changed as the program is handed them; a host source is changed
# in a copy, compiled as its unity file is, and linked before the library that has the sound one.
set -euo pipefail
build=$(readlink -f "$1") which=${2:-all}
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
program=$build/tests/stability/mfar-stress
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
missed=0 found=0

# Arguments: program, what, cases, further arguments.
expectFound() {
    local run=$1 what=$2 cases=$3 said status=0
    shift 3
    said=$("$run" --small --first 1 --rounds 40 --minutes 5 --case "$cases" "$@" 2>&1) || status=$?
    if [[ $status == 1 || $status -ge 128 ]]; then
        found=$((found + 1))
        printf 'found   %s\n        %s\n' "$what" \
            "$(grep -m1 ^FAILED <<<"$said" || echo "ended by signal $((status - 128))")"
    else
        missed=$((missed + 1))
        printf 'MISSED  %s (cases %s, status %s)\n' "$what" "$cases" "$status"
    fi
}

inShaders() {
    local index shader cases what
    while IFS=$'\t' read -r index shader cases what; do
        expectFound "$program" "$shader: $what" "$cases" --plant "$index"
    done < <("$program" --list-planted)
}

# The compiler's command for a source's unity file, with the source and the object exchanged.
compile() {
    local source=$1 changed=$2 object=$3 unity command
    unity=$(grep -lsF "/$source\"" "$build"/pipeline/CMakeFiles/*/Unity/*.cxx \
        "$build"/pipeline/*/CMakeFiles/*/Unity/*.cxx \
        "$build"/tests/measure/*/CMakeFiles/*/Unity/*.cxx | head -n 1)
    command=$(ninja -C "$build" -t commands | grep -F -- "-c $unity" | head -n 1)
    command=${command%% -MD*}
    (cd "$build" && eval "$command -w -I$PWD -c $changed -o $object")
}

# Arguments: source, its text, what comes instead, what that is, cases.
inHost() {
    local source=$1 from=$2 to=$3 what=$4 cases=$5 link
    if [[ $(grep -cF -- "$from" "$source") != 1 ]]; then
        printf 'MISSED  %s does not contain once: %s\n' "$source" "$from"
        missed=$((missed + 1))
        return
    fi
    FROM=$from TO=$to perl -pe 's/\Q$ENV{FROM}\E/$ENV{TO}/' "$source" >"$scratch/changed.cpp"
    compile "$source" "$scratch/changed.cpp" "$scratch/changed.o"
    link=$(ninja -C "$build" -t commands mfar-stress | grep -F -- '-o tests/stability/mfar-stress ')
    link=${link/-o tests\/stability\/mfar-stress /-Wl,--allow-multiple-definition $scratch/changed.o -o $scratch/program }
    (cd "$build" && eval "$link")
    expectFound "$scratch/program" "$source: $what" "$cases"
}

hostFaults() {
    inHost pipeline/depth/depth_filter.cpp 'if (InverseDepthField::isSound(measured.rho[i], measured.variance[i]))' \
        '' 'removed guard against measurements that are none' depth-filter
    inHost pipeline/depth/depth_filter.cpp 'const float moved = rho / p.z();' 'const float moved = rho;' \
        'depth not carried' depth-carried
    inHost pipeline/depth/edge_snap.cpp 'if (!isSound(in, i)) {' 'if (false) {' \
        'removed guard against depth that is none' edges
    inHost pipeline/epipolar/epipolar_flow.cpp 'std::clamp(error, 0.0F, kNowhere)' 'error' \
        'missing clamp of the two-way error' flow-of-poses
    inHost pipeline/epipolar/epipolar_search.cpp 'return label > -kBeyond ? std::min(label, longest) : static_cast<float>(-kBeyond);' \
        'return label;' 'missing clamp of a prediction' search
    inHost pipeline/epipolar/relative_pose.cpp 'out.error = ray - seen;' 'out.error = seen - ray;' \
        'wrong sign of an error' refinement-exact
    inHost pipeline/epipolar/semi_global.cpp 'from + std::clamp(shift, -apart, apart)' 'from + shift' \
        'missing clamp of a shift' aggregation
    inHost pipeline/flow/luma_image.cpp 'out.back().firstWeight = 1;' 'out.back().firstWeight = 2;' \
        'wrong weight' luma
    inHost pipeline/plan/tile_measure.cpp 'const int width = inside ? width_ : 0;' \
        'const int width = inside ? width_ : static_cast<int>(2 * pitch_);' \
        'noise beyond the border' plan
    inHost pipeline/plan/tile_choice.cpp 'if (tile.changed) return;' '' 'changed tiles taken for noise' plan
    inHost pipeline/track/pose_filter.cpp 'if (!usable) {' 'if (false) {' \
        'removed guard against poses that are none' pose-filter
    inHost pipeline/track/tag_pose.cpp 'tag.T_world_tag * T_camera_tag.inverse();' \
        'tag.T_world_tag * T_camera_tag;' 'an inverse left out' tag-exact
    inHost pipeline/composite/silhouette.cpp 'tile.farthest = std::max(tile.farthest, farthest);' \
        'tile.farthest = farthest;' 'a range that forgets' silhouette
    local triangulation=tests/measure/triangulation/triangulation.cpp
    inHost $triangulation 'd = s.e.squaredNorm() - s.b.z() * along;' \
        'd = s.e.squaredNorm() + s.b.z() * along;' 'wrong sign' triangulation-usual
    inHost $triangulation 'along > kNoAngle ? crossOf(s.e, s.u) / along : s.u.norm()' \
        'crossOf(s.e, s.u) / along' 'removed guard where there is no epipolar line' triangulation
    inHost $triangulation 'rho > 0 && rho < kLargestRho && distance <= mostDistance_;' \
        'distance <= mostDistance_;' 'removed guard' triangulation
}

if [[ $which != host ]]; then inShaders; fi
if [[ $which != shaders ]]; then hostFaults; fi
printf '%d found, %d missed\n' "$found" "$missed"
[[ $missed == 0 ]]
