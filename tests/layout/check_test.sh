#!/usr/bin/env bash
# check.sh must accept a valid tree and report each fault that this test adds to it.
set -euo pipefail
check=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/check.sh
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
work=$scratch/sound
failures=0

put() {
    mkdir -p "$(dirname "$work/$1")"
    printf '%s\n' "${@:2}" >"$work/$1"
}

soundTree() {
    put run '#!/bin/sh'
    put hal/camera.h '#pragma once' '#include <chrono>'
    put hal/device/egl.cpp '#include "hal/camera.h"' '#include <EGL/egl.h>'
    put hal/virtual/player.h '#include "base/geometry.h"'
    put hal/virtual/recording.cpp '#include "base/calibration/sensor_yaml.h"'
    put base/calibration/sensor_yaml.h '#include "base/geometry.h"'
    put hal/virtual/osmesa.cpp '#include <GL/osmesa.h>' '#include "hal/virtual/player.h"'
    put gles_shaders/shaders.h '#pragma once'
    put base/time.h '#pragma once'
    put base/geometry.h '#include "base/time.h"'
    put base/gl/pass.h '#include "gles_shaders/shaders.h"'
    put pipeline/track/tags.cpp '#include <apriltag/apriltag.h>'
    put pipeline/pipeline.h '#include "base/gl/pass.h"'
    put daemon/app.h '#include "pipeline/pipeline.h"'
    put daemon/rig.cpp '#include "hal/device/egl.h"' '#include "hal/virtual/player.h"'
    put hal/device/egl.h '#include "base/gl/pass.h"'
    put daemon/tools/sim.cpp '#include "hal/virtual/player.h"'
    put tests/all.cpp '#include "daemon/app.h"' '#include "hal/virtual/player.h"'
}

# expectFault MESSAGE FILE LINE...: adds the file to a copy of the valid tree. check.sh must report
# MESSAGE. The copy saves time: it takes two processes, and creating the tree anew takes thirty.
expectFault() {
    local message=$1 said
    rm -rf "$work"
    cp -r "$scratch/sound" "$work"
    put "${@:2}"
    if said=$("$check" "$work") || [[ $said != *"$message"* ]]; then
        echo "check.sh did not report '$message' for $2; it printed '$said'"
        failures=$((failures + 1))
    fi
}

soundTree
if ! said=$("$check" "$work"); then
    echo "check.sh refuses a valid tree: $said"
    failures=1
fi
work=$scratch/faulty
expectFault 'pipeline/bad.cpp:1: pipeline must not' pipeline/bad.cpp '#include "daemon/app.h"'
expectFault 'pipeline/bad.cpp:2: pipeline must not' pipeline/bad.cpp '' '#include "hal/virtual/player.h"'
expectFault 'base/gl/bad.h:1: base must not' base/gl/bad.h '#include "pipeline/pipeline.h"'
expectFault 'base/calibration/bad.h:1: base must not' base/calibration/bad.h '#include "base/gl/pass.h"'
expectFault 'base/bad.h:1: base must not' base/bad.h '#include "hal/camera.h"'
expectFault 'base/bad.h:1: base must not' base/bad.h '#include "base/gl/pass.h"'
expectFault 'hal must not include "base/gl/pass.h"' hal/bad.h '#include "base/gl/pass.h"'
expectFault 'pipeline must not include "gles_shaders/shaders.h"' pipeline/bad.h '#include "gles_shaders/shaders.h"'
expectFault 'hal must not include "pipeline/pipeline.h"' hal/device/bad.h '#include "pipeline/pipeline.h"'
expectFault 'hal must not include "hal/virtual/player.h"' hal/device/bad.h '# include "hal/virtual/player.h"'
expectFault 'hal must not include "hal/device/egl.h"' hal/virtual/bad.h '#include "hal/device/egl.h"'
expectFault 'daemon must not include "hal/virtual/player.h"' daemon/app.cpp '#include "hal/virtual/player.h"'
expectFault 'daemon must not include "hal/device/egl.h"' daemon/tools/bad.cpp '#include "hal/device/egl.h"'
expectFault 'gles_shaders must not' gles_shaders/bad.cpp '#include "base/gl/pass.h"'
expectFault 'not a path from the top' daemon/bad.cpp '#include "app.h"'
expectFault 'not a path from the top' daemon/bad.cpp '#include "../hal/camera.h"'
expectFault '<apriltag/apriltag.h> may be included only in' pipeline/flow/bad.cpp '#include <apriltag/apriltag.h>'
expectFault '<hwy/highway.h> may be included only in' pipeline/flow/bad.cpp '#include <hwy/highway.h>'
expectFault '<embree4/rtcore.h> may be included only in' pipeline/bad.cpp '#include <embree4/rtcore.h>'
expectFault '<EGL/egl.h> may be included only in' pipeline/bad.cpp '#include <EGL/egl.h>'
expectFault '<GL/osmesa.h> may be included only in' hal/device/bad.cpp '#include <GL/osmesa.h>'
expectFault '<libcamera/camera.h> may be included only in' daemon/rig.cpp '#include <libcamera/camera.h>'
expectFault '<gpiod.hpp> may be included only in' pipeline/bad.cpp '#include <gpiod.hpp>'
expectFault '<xf86drm.h> may be included only in' daemon/bad.cpp '#include <xf86drm.h>'
mapfile -t long < <(yes '' | head -n 401)
expectFault 'tests/long.cpp: 401 lines' tests/long.cpp "${long[@]}"
expectFault 'notes.txt: is not allowed' notes.txt 'x'
[[ $failures == 0 ]]
