# Part of `./run`, which provides the functions that this script uses: tests on an emulated board, and
# predictions for boards.

# Prints the folder with the pictures that the emulated cameras play: three seconds of the simulated
# board. Makes the folder if it is missing or if the programs that make it have changed.
film() {
    local sim=.build/host/daemon/tools/mfar-sim film=.build/host/tests/testbed/mfar-film folder
    build host mfar-sim mfar-film >&2
    folder=$(cacheFolder)/film-$(cat $sim $film | sha256sum | cut -c 1-12)
    if [[ ! -d $folder ]]; then
        say "Making $folder"
        rm -rf .build/recording "$folder.part"
        $sim --scene office --seconds 3 --stills 10 --no-truth --out .build/recording >&2
        $film .build/recording "$folder.part"
        mv "$folder.part" "$folder"
        rm -rf .build/recording
    fi
    touch "$folder"
    find "$(cacheFolder)" -maxdepth 1 -name 'film-*' -mtime +14 -exec rm -rf {} +
    echo "$folder"
}

# deviceTest [NUMBER...]: runs these scenarios (default: all) on the emulated board.
deviceTest() {
    local root image deb film programs=.build/aarch64/tests/device
    ensurePackages buildPackages aarch64Packages rootPackages bedPackages
    sysroot aarch64
    deb=$(pack aarch64)
    build aarch64 tests/device/all
    film=$(film)
    root=$(rootCommand) || exit 1
    # shellcheck disable=SC2016,SC2046 # dpkg-deb expands ${Depends}; the names are words
    image=$($root toolchains/testbed/image.sh "$(cacheFolder)" $({
        dpkg-deb --show --showformat='${Depends}, ${Recommends}\n' "$deb"
        find "$programs" -maxdepth 1 -type f -executable -exec \
            toolchains/package/shlibdeps.sh .build/sysroot-aarch64 arm64 {} +
    } | tr ',' '\n' | awk '{ print $1 }'))
    python3 -B toolchains/testbed/bed.py --image "$image" --package "$deb" --programs "$programs" \
        --film "$film" "$@"
}

boardReport() {
    local root suite libraries program=.build/host/tests/engine/gles/mfar-compile-shaders
    local frame=tests/measure/boards/mfar-frame-work
    local -a command
    ensurePackages buildPackages aarch64Packages rootPackages boardPackages
    build host mfar-compile-shaders mfar-frame-work
    command=(python3 -B toolchains/boards/report.py --compile-shaders "$program" --frame-work ".build/host/$frame")
    root=$(rootCommand) || exit 1
    for suite in bookworm trixie; do
        # shellcheck disable=SC2086 # $root is a list of words
        libraries=$($root toolchains/boards/drivers.sh "$(cacheFolder)" "$suite")
        command+=(--drivers "$suite=$libraries")
    done
    case ${1:-} in
    --check | --update-budget) "${command[@]}" "$@" ;;
    *)
        qemu-aarch64 --help | grep -- -plugin >/dev/null ||
            die "board-report counts instructions with a plugin, but this qemu-aarch64 (Debian 13's) loads none; use Debian 12"
        sysroot aarch64
        build aarch64 mfar-frame-work
        "${command[@]}" --arm-frame-work ".build/aarch64/$frame" --sysroot "$(readlink .build/sysroot-aarch64)" "$@"
        ;;
    esac
}
