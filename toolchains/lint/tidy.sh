# Functions that run clang-tidy on all files that have changed since clang-tidy last passed. Part of
# `./run`; paths are relative to the project's folder.

# Prints all files to check: the build's unity files, and the sources that are in no unity file. A
# header of several sources is checked only once in a unity file. Generated sources are left out.
everything() {
    sed -n 's|^ *"file": "\(.*\)",\?$|\1|p' .build/host/compile_commands.json |
        sort -u |
        { grep -v '/\.build/.*\.cpp$' || true; } |
        { xargs grep -sL '^#include "[^"]*/\.build/' || true; } | # -s: some do not exist yet
        grep . # fails for an empty list
}

# unlinted STAMP: prints the files that changed after STAMP, the time at which clang-tidy last
# passed. If a header or the checks changed, prints all files.
unlinted() {
    local stamp=$1 changed
    if [[ ! -f $stamp ]]; then everything; return; fi
    changed=$(find .clang-tidy toolchains/lint base daemon hal pipeline gles_shaders tests \
        -newer "$stamp" \( -name '*.h' -o -name '.clang-tidy' -o -name CMakeLists.txt \
        -o -path 'toolchains/lint/*' \) -print -quit)
    if [[ -n $changed ]]; then everything; return; fi
    changed=$(find base daemon hal pipeline gles_shaders tests -name '*.cpp' -newer "$stamp" -printf "$PWD/%p\n")
    [[ -n $changed ]] || return 0
    # Unity files that include a changed source, and changed sources that are in no unity file.
    {
        everything | xargs grep -sFl -e "$changed" || true
        everything | grep -xF -e "$changed" || true
    } | sort -u
}

# tidyPlugin PLUGIN: builds the plugin that limits clang-tidy to the project's own code. With it,
# clang-tidy takes a third of the time. -fno-rtti, because LLVM is built without RTTI.
tidyPlugin() {
    local plugin=$1 source=toolchains/lint/own_code.cpp
    [[ $plugin -nt $source ]] ||
        { ccache c++ -std=c++17 -fno-rtti -fPIC -isystem /usr/lib/llvm-19/include \
            -c "$source" -o "$plugin.o" && c++ -shared "$plugin.o" -o "$plugin"; }
}

# Prints the compiler options in which clang-tidy must agree with the precompiled headers. They
# replace those of the target.
sharedOptions() {
    printf '%s\n' -O2 -fPIE -fmath-errno -DFMT_SHARED -DGTEST_HAS_PTHREAD=1 -DHWY_COMPILE_ONLY_STATIC
}

# precompileHeaders HEADERS: precompiles the headers of other projects, unless they are up to date.
# With them, clang-tidy takes half the time. They count as out of date after the installation of any
# package, which changes dpkg's status file, because the package may contain a changed header.
precompileHeaders() {
    local headers=$1 source=toolchains/lint/system_headers.h input options
    for input in "$source" toolchains/lint/tidy.sh /var/lib/dpkg/status; do
        [[ $headers -nt $input ]] && continue
        mapfile -t options < <(sharedOptions)
        clang++-19 -x c++-header -std=c++20 -DNDEBUG "${options[@]}" -fpch-instantiate-templates -w \
            -isystem /usr/include/eigen3 -isystem /usr/include/opencv4 "$source" -o "$headers"
        return
    done
}

# tidyOptions PLUGIN HEADERS: prints the options of clang-tidy. In precompiled headers, clang ignores
# the pragma by which libstdc++ allows itself a deprecated function. So its warnings of deprecated
# functions are off; GCC reports those in our files.
tidyOptions() {
    printf '%s\n' --quiet "--load=$1"
    { sharedOptions; printf '%s\n' -Wno-unknown-warning-option -Wno-deprecated-declarations \
        -Xclang -include-pch -Xclang "$PWD/$2"; } |
        sed 's/^/--extra-arg=/'
}

# tidyFile FILE OPTION...: checks a file. Prints the names of its sources as progress, then
# clang-tidy's messages. A SIMD kernel is checked for one instruction set only, because
# sharedOptions() contains HWY_COMPILE_ONLY_STATIC.
tidyFile() {
    local file=$1 sources=$1 said status=0
    shift
    if [[ $file == */Unity/* ]]; then
        sources=$(sed -n 's|^#include "\(.*\)"$|\1|p' "$file")
        sources=${sources//"$PWD/"/}
    fi
    # clang-tidy allocates so much memory that large pages save a tenth of its CPU time.
    said=$(GLIBC_TUNABLES=glibc.malloc.hugetlb=1 \
        clang-tidy-19 -p .build/host "$@" "$file" 2>/dev/null) || status=1
    # shellcheck disable=SC2086 # $sources is a list of words
    printf '  %s\n' $sources
    [[ -z $said ]] || printf '%s\n' "$said"
    return "$status"
}

tidy() {
    local stamp=.build/host/.linted plugin=.build/host/own_code.so headers=.build/host/system_headers.pch
    local begun files options
    files=$(unlinted "$stamp") || return
    [[ -n $files ]] || return 0
    tidyPlugin "$plugin" || return
    precompileHeaders "$headers" || return
    mapfile -t options < <(tidyOptions "$plugin" "$headers")
    tests/lint/check.sh "${options[@]}" || return
    begun=$(mktemp -p .build/host)
    export -f tidyFile
    # shellcheck disable=SC2016 # the inner shell expands $@
    if xargs -P "$jobs" -I FILE bash -c 'tidyFile "$@"' bash FILE "${options[@]}" <<<"$files"; then
        mv "$begun" "$stamp"
    else
        rm "$begun"
        return 1
    fi
}
