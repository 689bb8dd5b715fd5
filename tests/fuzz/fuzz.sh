# Part of `./run`, which provides the functions that this script uses.

fuzzPackages() {
    cat <<'EOF'
clang-19                compiler with libFuzzer
libclang-rt-19-dev      libFuzzer and the sanitizers
llvm-19                 names of functions in reports, coverage
EOF
}

fuzzLibraryPackages() {
    cat <<'EOF'
dpkg-dev                sources of the libraries that fuzzing instruments
EOF
}

fuzzTargets() { sed -n 's/^ *mfar_fuzz_target(\([a-z0-9]*\).*/\1/p' tests/fuzz/CMakeLists.txt | sort -u; }

# fuzzRoom TARGET: prints a regular expression for the source files whose coverage is measured.
fuzzRoom() {
    case $1 in
    calibration) echo 'base/calibration/' ;;
    config) echo 'daemon/(.*_config|config|toml_reader|rig_words|picture_size)\.|base/toml_bounds' ;;
    control) echo 'daemon/control\.' ;;
    environment) echo 'pipeline/models/(environment_map|radiance_hdr)' ;;
    filters) echo 'pipeline/enlarge/(learner_state|stored_numbers)' ;;
    gltf) echo 'pipeline/models/gltf_' ;;
    image) echo 'hal/image_codec' ;;
    line) echo 'daemon/taken_line' ;;
    mjpeg) echo 'hal/device/jpeg_decoder' ;;
    quality) echo 'daemon/(quality_table|toml_reader)' ;;
    recording) echo 'hal/virtual/(recording\.|recording_csv|png_header|image_files|float_files)' ;;
    tags) echo 'pipeline/track/tag_map' ;;
    v4l2) echo 'hal/device/(camera_v4l2|v4l2_)' ;;
    *) die "the source files of the fuzz target $1 are unknown" ;;
    esac
}

fuzzFolder() {
    local folder
    folder=$(cacheFolder)/fuzz/$1
    mkdir -p "$folder"
    echo "$folder"
}

# fuzzOne PRESET TARGET SECONDS: runs a target. Keeps a failing input and prints its path.
fuzzOne() {
    local build=.build/$1 target=$2 seconds=$3 seeds=tests/fuzz/corpus/$2 found
    local dictionary=tests/fuzz/$2.dict
    found=$(fuzzFolder "$target")
    local options=(-max_total_time="$seconds" -timeout=25 -rss_limit_mb=1024 -print_final_stats=1
        -artifact_prefix="$found-failed-")
    [[ ! -f $dictionary ]] || options+=(-dict="$dictionary")
    clearProgress
    say "fuzz $target: $seconds s, from $(find "$seeds" "$found" -type f | wc -l) inputs"
    ASAN_SYMBOLIZER_PATH=$(command -v llvm-symbolizer-19) UBSAN_OPTIONS=print_stacktrace=1 \
        "$build/tests/fuzz/mfar-fuzz-$target" "${options[@]}" "$found" "$seeds" \
        >"$build/$target.log" 2>&1 || {
        tail -n 60 "$build/$target.log" >&2
        return 1
    }
    clearProgress
    awk -v target="$target" '
        /^stat::number_of_executed_units:/ { runs = $2 }
        /^stat::average_exec_per_sec:/     { rate = $2 }
        /^stat::peak_rss_mb:/              { peak = $2 }
        / cov: [0-9]+ /                    { for (i = 1; i < NF; ++i) if ($i == "cov:") cov = $(i + 1) }
        END { printf "%s: %d runs, %d a second, %d edges, %d MB at most\n", target, runs, rate, cov, peak }
    ' "$build/$target.log"
}

fuzzCoverage() {
    local target=$1 program=.build/fuzz-coverage/tests/fuzz/mfar-fuzz-$1 data=.build/fuzz-coverage/$1
    LLVM_PROFILE_FILE=$data.profraw "$program" "tests/fuzz/corpus/$target" "$(fuzzFolder "$target")" >/dev/null
    llvm-profdata-19 merge -o "$data.profdata" "$data.profraw"
    local room
    mapfile -t room < <(find base daemon hal pipeline \( -name '*.cpp' -o -name '*.h' \) |
        grep -E "^($(fuzzRoom "$target"))")
    printf '%-12s' "$target"
    llvm-cov-19 report "$program" -instr-profile="$data.profdata" "${room[@]/#/$PWD/}" |
        awk '/^TOTAL/ { print $10 " of " $8 " lines, " $7 " of " $5 " functions" }'
}

# Builds the libraries that decode pictures and read YAML, with coverage and sanitizers. Creates the
# link by which the preset finds them. If the link changes, CMake must run again, because its cache
# contains the old target of the link.
instrumentLibraries() {
    local made link=.build/instrumented
    ensurePackages fuzzLibraryPackages
    made=$(tests/fuzz/libraries.sh "$(cacheFolder)")
    [[ $(readlink "$link") != "$made" ]] || return 0
    rm -f .build/fuzz-libraries/CMakeCache.txt .build/fuzz-libraries/.configured
    mkdir -p .build
    ln -sfn "$made" "$link"
}

# fuzz [TARGET...] [--minutes N] [--coverage] [--instrument-libraries]: runs the given targets, by
# default all, for N minutes, by default 1.
fuzz() {
    local preset=fuzz seconds=60 coverage='' targets=() running=0 status=0 target ticker rounds
    while [[ $# -gt 0 ]]; do
        case $1 in
        --minutes) [[ $# -ge 2 ]] || die "--minutes needs a number"
            seconds=$(awk -v m="$2" 'BEGIN { print int(m * 60) }')
            # libFuzzer takes 0 seconds as a search without end.
            [[ $seconds -gt 0 ]] || die "--minutes must be a number of at least 1/60, not '$2'"
            shift 2 ;;
        --coverage) coverage=1; shift ;;
        --instrument-libraries) preset=fuzz-libraries; shift ;;
        *) fuzzTargets | grep -qx -- "$1" || die "unknown fuzz target '$1'; expected one of $(fuzzTargets | xargs)"
            targets+=("$1"); shift ;;
        esac
    done
    [[ ${#targets[@]} -gt 0 ]] || mapfile -t targets < <(fuzzTargets)
    ensurePackages buildPackages fuzzPackages
    if [[ -n $coverage ]]; then
        build fuzz-coverage "${targets[@]/#/mfar-fuzz-}" >&2
        for target in "${targets[@]}"; do fuzzCoverage "$target"; done
        return
    fi
    if [[ $preset == fuzz-libraries ]]; then instrumentLibraries; fi
    build "$preset" "${targets[@]/#/mfar-fuzz-}" >&2
    rounds=$(((${#targets[@]} + jobs - 1) / jobs))
    tick $((rounds * seconds)) "fuzz, ${#targets[@]} targets" &
    ticker=$!
    for target in "${targets[@]}"; do
        if ((running == jobs)); then
            wait -n || status=1
            running=$((running - 1))
        fi
        fuzzOne "$preset" "$target" "$seconds" &
        running=$((running + 1))
    done
    for (( ; running > 0; --running)); do wait -n || status=1; done
    kill "$ticker" 2>/dev/null || true
    clearProgress
    return "$status"
}
