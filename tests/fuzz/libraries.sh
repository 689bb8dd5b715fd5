#!/usr/bin/env bash
# Builds the libraries that decode pictures and read YAML, in Debian's versions, with coverage and
# sanitizers. Prints the folder in which they are installed. Keeps the results, because building
# takes about three minutes. Usage: libraries.sh CACHE
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
# shellcheck source=toolchains/debian.sh
. "$here/../../toolchains/debian.sh"

[[ $# -eq 1 ]] || die "usage: libraries.sh CACHE"
cache=$1

sources=(zlib libpng1.6 libjpeg-turbo yaml-cpp)
# If one of these packages changes, the libraries are built again. The downloaded sources may be
# newer than the packages, because an archive keeps only one version.
# shellcheck disable=SC2016 # dpkg-query expands
versions=$(dpkg-query -W -f '${Version} ' zlib1g-dev libpng-dev libturbojpeg0-dev libyaml-cpp-dev)

# The options of the preset "fuzz" without -fsanitize=function, because C libraries call functions
# through pointers of other types.
sanitizers=-fsanitize=fuzzer-no-link,address,undefined
flags="-O1 -g1 -fno-omit-frame-pointer -fno-sanitize-recover=all $sanitizers -fno-sanitize=function"

# tryFetching FOLDER FILE...: unpacks package sources with Debian's patches into a new folder.
tryFetching() {
    local folder=$1 file options
    shift
    mkdir -p "$folder/lists/partial" "$folder/sources"
    for file; do
        sed 's/^Types:.*/Types: deb-src/; s/^deb /deb-src /' "$file" >"$folder/sources/${file##*/}"
    done
    options=(-o "Dir::State::Lists=$folder/lists" -o "Dir::Etc::SourceParts=$folder/sources"
        -o Dir::Etc::SourceList=/dev/null -o APT::Sandbox::User=root)
    apt-get -qq "${options[@]}" update &&
        (cd "$folder" && apt-get -qq "${options[@]}" source "${sources[@]}")
}

# fetch FOLDER: downloads the sources into a new folder. Omits security updates if the mirror lacks
# their sources.
fetch() {
    local folder=$1 files
    mapfile -t files < <(debianSources)
    [[ ${#files[@]} -gt 0 ]] || die "no source of Debian packages is configured"
    if ! tryFetching "$folder" "${files[@]}"; then
        rm -rf "$folder"
        mkdir -p "$folder/main"
        mapfile -t files < <(sourcesWithoutSecurity "$folder/main")
        tryFetching "$folder" "${files[@]}"
    fi
}

buildOne() {
    local source=$1 prefix=$2
    shift 2
    cmake -S "$source" -B "$source/build" -G Ninja -DCMAKE_BUILD_TYPE=None \
        -DCMAKE_C_COMPILER=clang-19 -DCMAKE_CXX_COMPILER=clang++-19 \
        -DCMAKE_C_FLAGS="$flags" -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_PREFIX_PATH="$prefix" \
        -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_INSTALL_LIBDIR="$prefix/lib" \
        -DBUILD_SHARED_LIBS=OFF "$@"
    cmake --build "$source/build"
    cmake --install "$source/build"
}

buildAll() {
    local folder=$1 prefix=$2
    fetch "$folder"
    # Uses configure, because Debian's package lacks files that zlib's CMake project needs.
    (cd "$folder"/zlib-*/ && CC=clang-19 CFLAGS=$flags ./configure --static --prefix="$prefix" &&
        make install)
    buildOne "$folder"/libpng1.6-*/ "$prefix" -DPNG_SHARED=OFF -DPNG_TESTS=OFF -DPNG_EXECUTABLES=OFF
    # Builds libjpeg-turbo without its SIMD code, which is assembly that sanitizers cannot check.
    buildOne "$folder"/libjpeg-turbo-*/ "$prefix" -DENABLE_SHARED=OFF -DWITH_SIMD=OFF
    buildOne "$folder"/yaml-cpp-*/ "$prefix" -DYAML_CPP_BUILD_TESTS=OFF -DYAML_CPP_BUILD_TOOLS=OFF
}

built=$cache/instrumented-$(inputHash "$versions" "$(codeOf "$here/libraries.sh")")
if [[ ! -d $built ]]; then
    printf 'Making %s, about three minutes\n' "$built" >&2
    rm -rf "$built.part"
    mkdir -p "$built.part"
    # In "buildAll || ...", bash would ignore `set -e` inside buildAll and continue after a fault.
    # Therefore buildAll runs in the background.
    buildAll "$built.part/source" "$built.part/prefix" >"$built.log" 2>&1 &
    wait $! || {
        tail -n 20 "$built.log" >&2
        die "the libraries cannot be built, see $built.log"
    }
    # Files of pkg-config and CMake contain the path of the folder, which changes now.
    grep -rlIZ "$built.part/prefix" "$built.part/prefix/lib" | xargs -0 sed -i "s|$built.part/prefix|$built|g"
    rm -rf "$built.part/source" "$built.log"
    mv "$built.part/prefix" "$built"
    rmdir "$built.part"
fi
touch "$built"
find "$cache" -maxdepth 1 -name 'instrumented-*' ! -name "${built##*/}" -mtime +14 -exec rm -rf {} +
echo "$built"
