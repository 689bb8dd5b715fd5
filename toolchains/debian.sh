# shellcheck shell=bash
# Functions that extract Debian packages into a folder (a root), also for another architecture. No
# program from the packages is executed. To be sourced; needs root rights, mmdebstrap and dpkg.

die() { printf '%s\n' "$(basename "$0"): $*" >&2; exit 1; }

# Prints the Debian release whose packages are used: that of this machine, because its compilers fit
# the packages.
debianSuite() {
    local ID='' VERSION_CODENAME=''
    # shellcheck source=/dev/null
    . /etc/os-release
    [[ $ID == debian ]] || die "this script needs Debian, but this machine runs ${ID:-unknown}"
    echo "$VERSION_CODENAME"
}

# Prints the files that list this machine's package sources, one per line. If it prints nothing,
# mmdebstrap uses Debian's usual mirror.
debianSources() {
    local file
    for file in /etc/apt/sources.list.d/debian.sources /etc/apt/sources.list; do
        if grep -qs '^[^#]*debian' "$file"; then echo "$file"; fi
    done
}

# Prints the URL of this machine's first package source. Prints nothing if there is none.
debianMirror() {
    local file
    while IFS= read -r file; do
        sed -n 's/^URIs: *\([^ ]*\).*/\1/p; s/^deb \(\[[^]]*\] \)\?\([^ ]*\).*/\2/p' "$file"
    done < <(debianSources) | head -n 1
}

# inputHash INPUT...: prints a hash of the inputs from which a folder is made. As part of the
# folder's name, it tells whether the folder has to be made anew.
inputHash() { printf '%s\n' "$@" | sha256sum | cut -c 1-12; }

# codeOf SCRIPT...: prints the scripts without lines that are only comments ("# ..." and "#"), also in
# here-documents. As an input of inputHash, it makes folders anew only if other lines have changed.
codeOf() { sed '/^ *#\( \|$\)/d' "$@"; }

# sourcesWithoutSecurity FOLDER: copies the lists of package sources to the folder, without the
# entries for security updates. Prints the copies' paths.
sourcesWithoutSecurity() {
    local file copy
    while IFS= read -r file; do
        copy=$1/${file##*/}
        case $file in
        *.sources) awk 'BEGIN { RS = ""; ORS = "\n\n" } !/\nSuites:[^\n]*-security/' "$file" >"$copy" ;;
        *) grep -v -- '-security' "$file" >"$copy" || true ;;
        esac
        echo "$copy"
    done < <(debianSources)
}

# tryExtracting ARCHITECTURE ROOT PACKAGE[,PACKAGE...] SOURCES...: extracts packages into the new
# folder ROOT. SOURCES are files that list package sources.
tryExtracting() {
    local architecture=$1 root=$2 packages=$3
    shift 3
    # shellcheck disable=SC2016 # mmdebstrap expands $1
    mmdebstrap --quiet --mode=root --variant=extract --architectures="$architecture" \
        --aptopt='APT::Install-Recommends "false"' \
        --dpkgopt='path-exclude=/usr/share/doc/*' --dpkgopt='path-exclude=/usr/share/man/*' \
        --dpkgopt='path-exclude=/usr/share/locale/*' --dpkgopt='path-exclude=/usr/share/info/*' \
        --setup-hook='for d in bin sbin lib; do mkdir -p "$1/usr/$d"; ln -s "usr/$d" "$1/$d"; done' \
        --skip=check/qemu,download/cleanup,cleanup/apt,output/dev \
        --include="$packages" "$(debianSuite)" "$root" "$@"
}

# extractPackages ARCHITECTURE ROOT PACKAGE...: extracts packages with all their dependencies into
# the new folder ROOT, and enters them as installed in dpkg's database there. Maintainer scripts are
# not run. On some mirrors, the security updates of an architecture can be inconsistent; then the
# packages are extracted without the updates. Programs built against these packages also run with
# the updates.
extractPackages() {
    local architecture=$1 root=$2 packages work sources
    shift 2
    packages=$(IFS=,; echo "$*")
    work=$(mktemp -d)
    mapfile -t sources < <(debianSources)
    if ! tryExtracting "$architecture" "$root" "$packages" "${sources[@]}" >"$work/log" 2>&1; then
        printf 'Extracting %s packages failed; trying without security updates\n' "$architecture" >&2
        rm -rf "$root"
        mapfile -t sources < <(sourcesWithoutSecurity "$work")
        tryExtracting "$architecture" "$root" "$packages" "${sources[@]}" >>"$work/log" 2>&1 || {
            tail -n 20 "$work/log" >&2
            die "the $architecture packages could not be extracted"
        }
    fi
    rm -r "$work"
    recordPackages "$root"
    rm -rf "${root:?}"/var/lib/apt/lists/* "${root:?}"/var/cache/apt/*
}

# recordPackages ROOT: fills dpkg's database in a root from the packages that were extracted into
# it: the packages' descriptions, and which package contains which library.
recordPackages() {
    local root=$1 info=$1/var/lib/dpkg/info control deb name
    control=$(mktemp -d)
    mkdir -p "$info"
    for deb in "$root"/var/cache/apt/archives/*.deb; do
        rm -rf "${control:?}"/*
        dpkg-deb --control "$deb" "$control"
        name=$(sed -n 's/^Package: //p' "$control/control")
        if grep -q '^Multi-Arch: same' "$control/control"; then
            name+=:$(sed -n 's/^Architecture: //p' "$control/control")
        fi
        { sed '/^$/d; s/^Package: .*/&\nStatus: install ok installed/' "$control/control"; echo; } \
            >>"$root/var/lib/dpkg/status"
        : >"$info/$name.list"
        if [[ -f $control/shlibs ]]; then cp "$control/shlibs" "$info/$name.shlibs"; fi
    done
    rm -rf "$control"
}

# linkAlternatives ROOT: links the default versions of BLAS and LAPACK. Usually, the packages'
# scripts make these links, but extractPackages runs no scripts.
linkAlternatives() {
    local library folder
    for library in blas/libblas.so.3 lapack/liblapack.so.3; do
        for folder in "$1"/usr/lib/*-linux-gnu*/"${library%/*}"; do
            [[ -d $folder ]] && ln -sf "$library" "${folder%/*}/${library##*/}"
        done
    done
}

# makeLinksRelative ROOT: makes absolute symbolic links relative, because they would lead out of the
# root.
makeLinksRelative() {
    local root=$1 link target
    while IFS= read -r -d '' link; do
        target=$(readlink "$link")
        ln -snf "$(realpath -ms --relative-to="$(dirname "$link")" "$root$target")" "$link"
    done < <(find "$root" -type l -lname '/*' -print0)
}
