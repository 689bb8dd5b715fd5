#!/usr/bin/env bash
# Checks the direction of includes, where third-party headers are included, the length of files and
# the names at the top level. Usage: check.sh [ROOT]. Prints one line per fault. Exit status 1:
# there are faults.
set -euo pipefail
cd "${1:-$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../..}"

rooms=(base daemon hal pipeline gles_shaders tests systemd toolchains)
topLevel=' CMakeLists.txt CMakePresets.json README.md LICENSE CHANGELOG.md CONTRIBUTING.md CITATION.cff
  run .clang-format .clang-tidy .ci .gitignore base daemon hal pipeline gles_shaders tests systemd
  toolchains docs '
# Names at the top level that git does not track: .git itself, builds, outputs and recordings.
ignored=' .git .build out shared '
maxLines=400

halTop='hal/[^/]+'
faults=0

fault() {
    printf '%s\n' "$*"
    faults=$((faults + 1))
}

# allowedFrom() and homeOf() return their result in a variable, because reading a printed result
# would start a process for each include. `allowed`: regular expression for the project files that a
# folder may include.
allowedFrom() {
    case $1 in
    tests/*) allowed='.+' ;;
    daemon/rig.* | daemon/rig_*) allowed='daemon/.+|pipeline/.+|hal/.+|base/.+' ;;
    daemon/tools/*) allowed="daemon/.+|pipeline/.+|$halTop|hal/virtual/.+|base/.+" ;;
    daemon/*) allowed="daemon/.+|pipeline/.+|$halTop|base/.+" ;;
    pipeline/*) allowed="pipeline/.+|$halTop|base/.+" ;;
    hal/device/*) allowed="hal/device/.+|$halTop|base/.+" ;;
    hal/virtual/*) allowed="hal/virtual/.+|$halTop|base/.+" ;;
    hal/*) allowed="$halTop|base/[^/]+" ;;
    base/gl/*) allowed='base/.+|gles_shaders/.+' ;;
    base/calibration/*) allowed='base/calibration/.+|base/[^/]+' ;;
    base/*) allowed='base/[^/]+' ;;
    gles_shaders/*) allowed='gles_shaders/.+' ;;
    esac
}

# `home`: regular expression for the only folders that may include a third-party header. Empty: any
# folder.
homeOf() {
    home=''
    case $1 in
    apriltag/* | apriltag.h | tag36h11.h) home='pipeline/track/|tests/' ;;
    hwy/*) home='pipeline/simd/|tests/engine/simd/|tests/measure/boards/' ;;
    embree*) home='pipeline/render/|tests/' ;;
    EGL/* | libcamera/* | gpiod* | xf86drm* | drm/* | libdrm/* | gbm.h) home='hal/device/|tests/device/' ;;
    GL/osmesa.h) home='hal/virtual/' ;;
    esac
}

checkInclude() {
    local file=$1 line=$2 name=$3 allowed='' home
    if [[ $name == \"* ]]; then
        name=${name//\"/}
        allowedFrom "$file"
        if [[ ! -f $name && $name == */* ]] || [[ $name != */* ]]; then
            fault "$file:$line: \"$name\" is not a path from the top of the tree"
        elif [[ ! $name =~ ^($allowed)$ ]]; then
            fault "$file:$line: ${file%%/*} must not include \"$name\""
        fi
        return
    fi
    name=${name//[<>]/}
    homeOf "$name"
    if [[ -n $home && ! $file =~ ^($home) ]]; then
        fault "$file:$line: <$name> may be included only in ${home//|/ or }"
    fi
}

checkIncludes() {
    local entry
    while IFS= read -r entry; do
        [[ $entry =~ ^([^:]+):([0-9]+):[[:space:]]*\#[[:space:]]*include[[:space:]]*(\"[^\"]+\"|<[^>]+>) ]] &&
            checkInclude "${BASH_REMATCH[1]}" "${BASH_REMATCH[2]}" "${BASH_REMATCH[3]}"
    done < <(find "${rooms[@]}" \( -name '*.h' -o -name '*.cpp' \) -exec grep -Hn '^[[:space:]]*#[[:space:]]*include' {} + \
        2>/dev/null)
    return 0
}

checkLengths() {
    local lines file
    while read -r lines file; do
        if [[ $file != total && $lines -gt $maxLines ]]; then
            fault "$file: $lines lines, at most $maxLines are allowed: split it by purpose"
        fi
    done < <(find run "${rooms[@]}" -type f \( -name run -o -name '*.h' -o -name '*.cpp' \
        -o -name '*.sh' -o -name '*.comp' -o -name '*.frag' -o -name '*.vert' -o -name '*.glsl' \
        -o -name '*.cmake' -o -name CMakeLists.txt \) -exec wc -l {} + 2>/dev/null)
}

checkTopLevel() {
    local name
    while read -r name; do
        if [[ "${topLevel//$'\n'/ } $ignored" != *" $name "* ]]; then
            fault "$name: is not allowed at the top level"
        fi
    done < <(ls -A)
}

checkIncludes
checkLengths
checkTopLevel
[[ $faults == 0 ]]
