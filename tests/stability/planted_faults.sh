#!/usr/bin/env bash
# Plants faults in shaders and host sources, one at a time, and runs the cases that must find them.
# Usage: planted_faults.sh BUILD-FOLDER [shaders|host|kernels|texts]. Prints each fault with the
# case that found it. Exit status 1: a fault was not found. A shader is changed when the program
# loads it. A host source is changed in a copy, which is compiled with the flags of its unity file
# and linked before the library that contains the original. `texts` only checks that the host sources
# still contain the texts to be replaced, each exactly once.
set -euo pipefail
build=$(readlink -f "$1") which=${2:-all}
cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.."
program=$build/tests/stability/mfar-stress
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
missed=0 found=0

# expectFound PROGRAM DESCRIPTION CASES [ARGUMENT...]: runs the cases with a planted fault. Reports
# the fault as missed if none of them fails.
expectFound() {
    local run=$1 what=$2 cases=$3 said status=0
    shift 3
    # Each process has its own seeds, so the number of processes must not depend on the machine.
    said=$("$run" --small --jobs 2 --first 1 --rounds 40 --minutes 5 --case "$cases" "$@" 2>&1) || status=$?
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

# compile SOURCE OBJECT: compiles the source with the changed copies of itself or of a header. The
# copies are in $scratch under the same relative paths, because a kernel includes itself once per
# instruction set. Uses the compiler command of the source's unity file, or, without a unity file,
# the source's own command.
compile() {
    local source=$1 object=$2 unit command
    unit=$(grep -lsF "/$source\"" "$build"/pipeline/CMakeFiles/*/Unity/*.cxx \
        "$build"/pipeline/*/CMakeFiles/*/Unity/*.cxx \
        "$build"/tests/measure/*/CMakeFiles/*/Unity/*.cxx | head -n 1 || true)
    command=$(ninja -C "$build" -t commands mfar-stress | grep -E -- "-c (${unit:-.*/$source})\$" | head -n 1)
    [[ -n $command ]] || { echo "no command compiles $source" >&2; exit 2; }
    command=${command%% -MD*}
    command=${command/ -I/ -I$scratch -I}
    (cd "$build" && eval "$command -w -I$PWD -c $scratch/$source -o $object")
}

# inHost SOURCE FROM TO DESCRIPTION CASES [INCLUDER]: plants a fault by replacing FROM by TO in a
# host source. If SOURCE is a header, INCLUDER is a source that includes it.
inHost() {
    local source=$1 from=$2 to=$3 what=$4 cases=$5 unit=${6:-$1} link
    if [[ $(grep -cF -- "$from" "$source") != 1 ]]; then
        printf 'MISSED  %s does not contain exactly once: %s\n' "$source" "$from"
        missed=$((missed + 1))
        return
    fi
    if [[ $which == texts ]]; then
        found=$((found + 1))
        return
    fi
    rm -rf "${scratch:?}"/*
    mkdir -p "$scratch/$(dirname "$unit")"
    cp "$unit" "$scratch/$unit"
    FROM=$from TO=$to perl -pe 's/\Q$ENV{FROM}\E/$ENV{TO}/' "$source" >"$scratch/$source"
    compile "$unit" "$scratch/changed.o"
    link=$(ninja -C "$build" -t commands mfar-stress | grep -F -- '-o tests/stability/mfar-stress ')
    link=${link/-o tests\/stability\/mfar-stress /-Wl,--allow-multiple-definition $scratch/changed.o -o $scratch/program }
    (cd "$build" && eval "$link")
    expectFound "$scratch/program" "$source: $what" "$cases"
}

hostFaults() {
    inHost pipeline/depth/depth_filter.cpp 'InverseDepthField::isSound(measured.inverseDepth[i], measured.variance[i]))' \
        'true)' 'missing check for invalid measurements' depth-filter
    inHost pipeline/depth/edge_snap.cpp 'const bool sound = InverseDepthField::isSound(in.inverseDepth[i], in.variance[i]);' \
        'const bool sound = true;' 'missing check for invalid depth' edges
    inHost pipeline/epipolar/epipolar_search.cpp 'return label > -kBeyond ? std::min(label, longest) : static_cast<float>(-kBeyond);' \
        'return label;' 'missing clamp of a prediction' search
    inHost pipeline/epipolar/relative_pose.cpp 'out.error = ray - seen;' 'out.error = seen - ray;' \
        'wrong sign of an error' refinement-exact
    inHost pipeline/flow/luma_image.cpp 'out.back().firstWeight = 1;' 'out.back().firstWeight = 2;' \
        'wrong weight' luma
    inHost pipeline/plan/tile_measure.cpp \
        'std::memcpy(to + inside, out.now[c][y] + inside, kTileSize - inside);' '' \
        'a difference beyond the border' plan
    inHost pipeline/plan/tile_choice.cpp 'if (tile.changed) return;' '' 'changed tiles counted as noise' plan
    inHost pipeline/track/pose_filter.cpp 'if (!usable) {' 'if (false) {' \
        'missing check for invalid poses' pose-filter
    inHost pipeline/track/tag_pose.cpp '*T_world_tag * T_camera_tag.inverse();' \
        '*T_world_tag * T_camera_tag;' 'missing inverse of a pose' tag-exact
    inHost pipeline/composite/silhouette.cpp 'tile.farthest = std::max(tile.farthest, farthest);' \
        'tile.farthest = farthest;' 'a depth range of the last pixel only' silhouette
    local triangulation=tests/measure/triangulation/triangulation.cpp
    inHost $triangulation 'd = s.e.squaredNorm() - s.b.z() * along;' \
        'd = s.e.squaredNorm() + s.b.z() * along;' 'wrong sign' triangulation-usual
    inHost $triangulation 'along > kNoAngle ? crossOf(s.e, s.u) / along : s.u.norm()' \
        'crossOf(s.e, s.u) / along' 'missing check for pixels without an epipolar line' triangulation
    inHost $triangulation 'inverseDepth > 0 && inverseDepth < kLargestInverseDepth && distance <= mostDistance_;' \
        'distance <= mostDistance_;' 'missing range check' triangulation
}

kernelFaults() {
    local simd=pipeline/simd
    inHost $simd/luma_kernels.cpp 'hn::Set(d, params::kLumaGreen)' 'hn::Set(d, 0.614F)' 'wrong weight of green' engines
    inHost $simd/still_footprint.cpp 'return std::clamp(i, 0, p.width - 1);' 'return std::clamp(i + 1, 0, p.width - 1);' \
        'pixel of the next column' engines
    inHost $simd/still_kernels.cpp 'const auto share = hn::Set(d, neighboursShare);' \
        'const auto share = hn::Set(d, std::int16_t(0 * neighboursShare));' 'missing neighbours' engines
    inHost $simd/still_look_up.cpp 'hn::Lt(error, Const(params::kTwoWayAlpha))' \
        'hn::Lt(error, Const(1e9F))' \
        'missing guard: confidence below zero' engines,pipeline
    inHost $simd/cell_weights.cpp 'smoothStep(params::kUnlikePatches, params::kAlikePatches, ncc2)' \
        'smoothStep(0.1F, params::kAlikePatches, ncc2)' 'wrong threshold' engines
    inHost $simd/patch_sums.cpp 'hn::MulFixedPoint15(hn::Sub(b, a), f)' 'hn::MulFixedPoint15(hn::Sub(a, b), f)' \
        'wrong sign between pixels' engines
    inHost $simd/detail_kernels.cpp 'hn::Sub(hn::LoadU(d16, warped.luma + x), shown)' \
        'hn::LoadU(d16, warped.luma + x)' 'a mean that is not subtracted' engines
    inHost $simd/sharpen_kernels.cpp 'kNearTap = params::kSharpenNear' 'kNearTap = -params::kSharpenNear' 'wrong sign of a tap' engines
    inHost $simd/patch_search.cpp 'hn::NegMulAdd(hn::Add(gain, gain), covariance, energy)' \
        'hn::MulAdd(hn::Add(gain, gain), covariance, energy)' 'wrong sign in a cost' pipeline-truth
    inHost $simd/field_rows.cpp 'return hn::Max(low, middle);' 'return hn::Min(low, middle);' \
        'wrong value instead of the median' filters
    inHost $simd/luma_filters.cpp 'hn::ShiftRight<2>(hn::Add(sum, hn::Set(d, 2)))' 'hn::ShiftRight<1>(hn::Add(sum, hn::Set(d, 2)))' \
        'wrong divisor of a mean' luma
    inHost $simd/path_windows-inl.h 'from + std::clamp(shift, -labels - 1, labels + 1)' 'from + shift' \
        'missing clamp of a shift' aggregation $simd/path_costs.cpp
    inHost $simd/cell_flow_rows.cpp 'const auto held = hn::Min(hn::Max(error, zero), nowhere);' \
        'const auto held = error;' 'missing clamp of the two-way error' flow-of-poses
    rowFaults
}

rowFaults() {
    local simd=pipeline/simd
    inHost $simd/label_costs.cpp 'hn::IfNegativeThenElse(seen, hn::Set(d, kUnseenCost), count)' 'count' \
        'missing check for pixels without census' label-costs
    inHost $simd/label_costs.cpp 'for (const float side : {-1.0F, 1.0F}) {' 'for (const float side : {1.0F}) {' \
        'missing pixels on one side of the line' label-costs
    inHost $simd/label_lines.cpp 'hn::Sub(own.foot, left.foot)' 'hn::Sub(left.foot, own.foot)' \
        'wrong sign of a slope' label-places
    inHost $simd/label_lines.cpp 'hn::Or(hn::Eq(rise, hn::Zero(d)), hn::Eq(rise, hn::Set(d, Valley::kUnknown)))' \
        'hn::Eq(rise, hn::Zero(d))' 'missing check for rises outside the window' label-places
    inHost $simd/depth_rows.cpp 'const auto moved = hn::Mul(inverseDepth, inverse);' 'const auto moved = inverseDepth;' \
        'depth does not follow the camera' depth-carried
    inHost $simd/depth_rows.cpp 'hn::Ge(hn::Add(s, set(rule.slack)), first)' 'hn::Ge(s, s)' \
        'missing check for nearer surfaces' measured-row
    inHost $simd/depth_rows.cpp 'const auto depth = hn::NegMulAdd(s, tz, one);' \
        'const auto depth = hn::MulAdd(s, tz, one);' 'wrong sign of a depth' measured-row
    inHost $simd/depth_rows.cpp 'storePixels(d, at, hn::Gt(z, least), size.width, landing + i);' \
        'storePixels(d, at, hn::Gt(z, least), size.width + 1, landing + i);' 'a wrong pitch' landed-row
    inHost $simd/tile_rows.cpp 'Const(kMeanToDeviation / 64)' 'Const(kMeanToDeviation / 60)' 'wrong divisor of noise' plan
    inHost $simd/tile_rows.cpp '1 << (kCells * row + column)' '1 << (kCells * column + row)' 'rows and columns exchanged' plan
    inHost $simd/turned_rows.cpp 'hn::MulAdd(fy, hn::Sub(low, top), top)' 'hn::MulAdd(fx, hn::Sub(low, top), top)' \
        'columns instead of rows' turned-row
    inHost $simd/turned_rows.cpp 'const auto skipped = hn::ShiftLeft<3>(hn::Sub(offset, from));' \
        'const auto skipped = hn::Zero(dInt_);' 'a wrong byte at the end of the picture' turned-row
    inHost $simd/turned_rows.cpp 'hn::Gt(pz, set(kLeastDepth))' 'hn::Eq(pz, pz)' \
        'missing check for points behind the camera' turned-points
}

if [[ $which == all || $which == shaders ]]; then inShaders; fi
if [[ $which == all || $which == host || $which == texts ]]; then hostFaults; fi
if [[ $which == all || $which == kernels || $which == texts ]]; then kernelFaults; fi
printf 'planted faults: %d found, %d missed\n' "$found" "$missed"
[[ $missed == 0 && $found != 0 ]]
