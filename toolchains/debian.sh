# shellcheck shell=bash
# Debian packages as files, for roots of another architecture. Nothing of that architecture is
# executed. To be sourced; needs root, mmdebstrap and dpkg.

die() { printf '%s\n' "$(basename "$0"): $*" >&2; exit 1; }

# Prints the release whose packages are used: the one that runs here, as its compilers fit.
debianSuite() {
    local ID='' VERSION_CODENAME=''
    # shellcheck source=/dev/null
    . /etc/os-release
    [[ $ID == debian ]] || die "this script needs Debian, but this machine runs ${ID:-unknown}"
    echo "$VERSION_CODENAME"
}

# Prints the files with this machine's package sources, one a line; nothing: the usual mirror.
debianSources() {
    local file
    for file in /etc/apt/sources.list.d/debian.sources /etc/apt/sources.list; do
        if grep -qs '^[^#]*debian' "$file"; then echo "$file"; fi
    done
}

# Prints where this machine's packages come from; nothing: the usual mirror.
debianMirror() {
    local file
    while IFS= read -r file; do
        sed -n 's/^URIs: *\([^ ]*\).*/\1/p; s/^deb \(\[[^]]*\] \)\?\([^ ]*\).*/\2/p' "$file"
    done < <(debianSources) | head -n 1
}

# Arguments: what a folder is made from. Prints a name part that is the same for the same.
inputHash() { printf '%s\n' "$@" | sha256sum | cut -c 1-12; }

# Argument: a new folder. Copies the package sources there but for security updates; prints the files.
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

# Arguments: architecture, new folder, packages with commas between them, files of sources.
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

# Arguments: architecture, new folder, packages. Extracts them with all they depend on and keeps
# dpkg's records of them, as installed. No maintainer script is run. Mirrors do not always have the
# security updates of every architecture in order; what is built against the packages without them
# runs with them.
extractPackages() {
    local architecture=$1 root=$2 packages work sources
    shift 2
    packages=$(IFS=,; echo "$*")
    work=$(mktemp -d)
    mapfile -t sources < <(debianSources)
    if ! tryExtracting "$architecture" "$root" "$packages" "${sources[@]}" >"$work/log" 2>&1; then
        printf 'Failed for %s; once more without security updates\n' "$architecture" >&2
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

# Fills dpkg's database of a root from the packages that it was extracted from: their descriptions,
# and which package a library belongs to.
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

# Argument: a root. Debian chooses these libraries by scripts, which have not been run.
linkAlternatives() {
    local library folder
    for library in blas/libblas.so.3 lapack/liblapack.so.3; do
        for folder in "$1"/usr/lib/*-linux-gnu*/"${library%/*}"; do
            [[ -d $folder ]] && ln -sf "$library" "${folder%/*}/${library##*/}"
        done
    done
}

# Argument: a root. Links to absolute paths would lead out of it.
makeLinksRelative() {
    local root=$1 link target
    while IFS= read -r -d '' link; do
        target=$(readlink "$link")
        ln -snf "$(realpath -ms --relative-to="$(dirname "$link")" "$root$target")" "$link"
    done < <(find "$root" -type l -lname '/*' -print0)
}
