# Functions that run clang-tidy on all files that have changed since clang-tidy last passed. `run`
# reads this file in the project's folder.

# Prints all files to check: the build's unity files, so that a header of several sources is checked
# once. Generated sources are left out.
everything() {
    sed -n 's|^ *"file": "\(.*\)",\?$|\1|p' .build/host/compile_commands.json |
        sort -u |
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
    # Unity files that include a changed source, or the source itself, each with the flags of its
    # target.
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

# tidyFile FILE: checks a file. Prints the names of its sources as progress, then clang-tidy's
# messages. A kernel's file is checked for one instruction set only.
tidyFile() {
    local file=$1 sources=$1 said status=0
    if [[ $file == */Unity/* ]]; then
        sources=$(sed -n 's|^#include "\(.*\)"$|\1|p' "$file")
        sources=${sources//"$PWD/"/}
    fi
    said=$(clang-tidy-19 -p .build/host --load .build/host/own_code.so --quiet \
        --extra-arg=-DHWY_COMPILE_ONLY_STATIC --extra-arg=-Wno-unknown-warning-option "$file" 2>/dev/null) || status=1
    # shellcheck disable=SC2086 # $sources is a list of words
    printf '  %s\n' $sources
    [[ -z $said ]] || printf '%s\n' "$said"
    return "$status"
}

tidy() {
    local stamp=.build/host/.linted plugin=.build/host/own_code.so begun files
    files=$(unlinted "$stamp") || return
    [[ -n $files ]] || return 0
    tidyPlugin "$plugin" || return
    tests/lint/check.sh "$plugin" || return
    begun=$(mktemp -p .build/host)
    export -f tidyFile
    # shellcheck disable=SC2016 # the inner shell expands $1
    if xargs -P "$jobs" -n 1 bash -c 'tidyFile "$1"' bash <<<"$files"; then
        mv "$begun" "$stamp"
    else
        rm "$begun"
        return 1
    fi
}
