#!/usr/bin/env bash
# Builds Mesa's OpenGL ES drivers for boards from the source package of a Debian release, if they do
# not exist, and prints their folder. Also builds Mesa's drm-shim: libraries that replace a GPU's
# kernel driver and do nothing. With them, a program can use a board's driver on any machine. The
# driver compiles each shader and prints statistics, but nothing is drawn. The folder contains all
# libraries (even the C library), so that the drivers of one release run on another. Needs root
# rights; takes 10 to 20 minutes on two cores, 2 GB during the build and 150 MB afterwards.
# Usage: drivers.sh [--if-built] CACHE SUITE   (--if-built: exit code 77 if the drivers are missing)
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
# shellcheck source=toolchains/debian.sh
. "$here/../debian.sh"

# mesaPackages SUITE: prints the packages that Mesa's build needs.
mesaPackages() {
    echo bison dpkg-dev flex g++ libdrm-dev libelf-dev libexpat1-dev meson ninja-build pkg-config \
        python3-mako zlib1g-dev
    # Panfrost compiles helpers in OpenCL C since Mesa 25.
    if [[ $1 != bookworm ]]; then
        echo glslang-tools libclang-19-dev libclang-cpp19-dev libclc-19 libclc-19-dev libllvmspirvlib-19-dev \
            llvm-19-dev llvm-spirv-19 python3-packaging python3-yaml spirv-tools
    fi
}

# makeRoot SUITE ROOT: installs the Debian release with the packages for the build into the new
# folder ROOT, and puts Mesa's source in its folder /mesa.
makeRoot() {
    local suite=$1 root=$2 mirror
    mirror=$(debianMirror)
    [[ -n $mirror ]] || die "no source of Debian packages is configured"
    # shellcheck disable=SC2046 # the package names are a list of words
    mmdebstrap --quiet --mode=root --variant=apt --aptopt='APT::Install-Recommends "false"' \
        --include="$(mesaPackages "$suite" | xargs | tr ' ' ,)" "$suite" "$root" \
        "deb $mirror $suite main" "deb-src $mirror $suite main"
    cp /etc/resolv.conf "$root/etc/resolv.conf"
    chroot "$root" sh -c 'cd /tmp && apt-get -qq update && apt-get -qq source --download-only mesa &&
        mkdir /mesa && tar xf mesa_*.orig.tar.*z -C /mesa --strip-components=1'
}

# amend ROOT: changes drm-shim's replacement of the V3D kernel driver in two ways. It makes the
# version of Mesa 22.3 report support of compute shaders, without which there is no OpenGL ES 3.1.
# And if V3D_GPU_ID is set (to 71), the replacement stands for V3D 7.1 with three slices instead of
# V3D 4.2.
amend() {
    local file=$1/mesa/src/broadcom/drm-shim/v3d_noop.c
    if ! grep -q PARAM_SUPPORTS_CSD "$file"; then
        sed -i 's/^\( *case DRM_V3D_PARAM_SUPPORTS\)_TFU:/\1_CSD:\n\1_CACHE_FLUSH:\n&/' "$file"
    fi
    sed -i -e 's/static const uint32_t v3d42_reg_map/const uint32_t v3d42_reg_map/' \
        -e 's/= 0x04443356,/= getenv("V3D_GPU_ID") ? 0x07443356 : 0x04443356,/' \
        -e 's/= 0x81001422,/= getenv("V3D_GPU_ID") ? 0x81001431 : 0x81001422,/' "$file"
}

buildMesa() {
    local root=$1 llvm=disabled
    if [[ -d $root/usr/lib/llvm-19 ]]; then llvm=enabled; fi
    chroot "$root" meson setup /mesa /mesa/build --wrap-mode=nofallback --buildtype=release \
        -Dgallium-drivers=v3d,panfrost,freedreno -Dvulkan-drivers= -Dtools=drm-shim -Dplatforms= \
        -Degl=enabled -Dgbm=enabled -Dgles1=disabled -Dgles2=enabled -Dglx=disabled -Dllvm=$llvm \
        -Dlibunwind=disabled -Dvalgrind=disabled
    chroot "$root" ninja -C /mesa/build
}

# collect ROOT OUT: copies the drivers, and all libraries that they and a C++ program need.
collect() {
    local root=$1 out=$2 library
    mkdir -p "$out"
    find "$root/mesa/build/src" -name '*.so*' ! -type d ! -path '*.p/*' ! -name '*.symbols' -exec cp -a -t "$out" {} +
    {
        for library in "$out"/*.so*; do
            cp "$library" "$root/tmp/one.so"
            chroot "$root" ldd /tmp/one.so || true
        done
        chroot "$root" ldd /usr/bin/ninja # a C++ program
    } | sed -n 's/.* => \(\/[^ ]*\) .*/\1/p; s/^\s*\(\/lib64\/ld-[^ ]*\) .*/\1/p' | sort -u |
        while IFS= read -r library; do
            if [[ ! -e $out/${library##*/} ]]; then cp -L "$root$library" "$out/"; fi
        done
}

ifBuilt=
if [[ ${1:-} == --if-built ]]; then
    ifBuilt=yes
    shift
fi
[[ $# -eq 2 ]] || die "usage: drivers.sh [--if-built] CACHE SUITE"
cache=$1
suite=$2
drivers=$cache/boards-$suite-$(inputHash "$suite" "$(codeOf "$here/drivers.sh")")
# With --if-built, nothing is removed below, because a normal user cannot remove root's files.
if [[ -n $ifBuilt ]]; then
    [[ -d $drivers ]] || exit 77
    echo "$drivers/lib"
    exit
fi
if [[ ! -d $drivers ]]; then
    printf 'Building the drivers in %s; takes 10 to 20 minutes\n' "$drivers" >&2
    rm -rf "$drivers.part"
    mkdir -p "$drivers.part"
    # Runs in the background. Directly before "||", bash would ignore errexit, and the commands
    # would continue after a failure.
    {
        makeRoot "$suite" "$drivers.part/root"
        amend "$drivers.part/root"
        buildMesa "$drivers.part/root"
        collect "$drivers.part/root" "$drivers.part/lib"
    } >"$drivers.log" 2>&1 &
    wait $! || {
        tail -n 20 "$drivers.log" >&2
        die "the build of Mesa from Debian $suite failed, see $drivers.log"
    }
    rm -rf "$drivers.part/root" "$drivers.log"
    chmod -R a+rX "$drivers.part"
    mv "$drivers.part" "$drivers"
fi
# Removes drivers of this release that other versions of this script built over two weeks ago.
find "$cache" -maxdepth 1 -name "boards-$suite-*" ! -name "${drivers##*/}" -mtime +14 -exec rm -rf {} +
echo "$drivers/lib"
