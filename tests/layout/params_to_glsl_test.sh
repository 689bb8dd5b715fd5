#!/usr/bin/env bash
set -euo pipefail
top=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../..
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

cat >print.cmake <<END
include($top/gles_shaders/params_to_glsl.cmake)
params_to_glsl("$work" "case.h" glsl)
file(WRITE "$work/out.glsl" "\${glsl}")
END
translate() { cmake -P print.cmake >log 2>&1; }
fail() {
    printf '%s\n' "$*"
    cat log
    exit 1
}

cat >shared.h <<'END'
#pragma once
namespace mfar::params {
struct alignas(16) Level {
    std::int32_t width;  ///< [px]
};
inline constexpr float kQuarter = 0.25F;
}  // namespace mfar::params
END
cat >case.h <<'END'
#pragma once

#include "shared.h"

#include <cstdint>

// The translation leaves out comments.
namespace mfar::params {

/// Doxygen comments are left out, too.
inline constexpr float kHalf = 2.0F * kQuarter;
inline constexpr std::uint32_t kMask = 15U;
inline constexpr int kSum =
    (3 + 4) * 2;
inline constexpr float kTiny = -1e-6F;
static_assert(kSum == 14);

struct alignas(16) Pass {
    Level from, to[2];
    float share, x;
    std::uint32_t flags;  ///< bits
};

}  // namespace mfar::params
END
cat >wanted.glsl <<'END'
#include "shared.h"
const float kHalf = 2.0 * kQuarter;
const uint kMask = 15u;
const int kSum = (3 + 4) * 2;
const float kTiny = -1e-6;
struct Pass {
    Level from, to[2];
    float share, x;
    uint flags;
};
END
translate || fail "a valid header is refused"
diff wanted.glsl out.glsl || fail "the translation differs from wanted.glsl"

# refused LINE REASON TEXT: a header with TEXT, which starts at line 3, must be refused with REASON
# at LINE.
refused() {
    printf '#pragma once\n#include "shared.h"\n%s\n' "$3" >case.h
    if translate; then fail "the invalid header is accepted: $3"; fi
    grep -q "case.h:$1: $2" <(tr -d '\n' <log | tr -s ' ') ||
        fail "no message 'case.h:$1: $2' for: $3"
}
inStruct() { refused 4 "$1" $'struct alignas(16) Pass {\n'"$2"$'\n};'; }

inStruct 'unsupported member' 'float weights[4];'
inStruct 'unsupported member' 'double x;'
inStruct 'unsupported member' 'float x = 1;'
inStruct 'unsupported member' 'bool given;'
inStruct 'unsupported member' 'float length() const;'
inStruct 'unknown structure Matrix' 'Matrix m;'
refused 3 'unsupported statement' $'struct Pass {\nfloat x;\n};'
refused 3 'unsupported statement' 'enum class Kind { A };'
refused 3 'unsupported statement' 'inline constexpr double kX = 1.0;'
refused 3 'unsupported statement' 'constexpr float kX = 1.0F;'
refused 3 'not an expression of type float' 'inline constexpr float kX = 1;'
refused 3 'not an expression of type float' 'inline constexpr float kX = 1.0;'
refused 3 'not an expression of type int' 'inline constexpr int kX = 1U;'
refused 3 'not an expression of type uint' 'inline constexpr std::uint32_t kX = 1;'
refused 3 'not an expression of type float' 'inline constexpr float kX = std::sqrt(2.0F);'
refused 3 'kQuarter is not a constant of type int' 'inline constexpr int kX = kQuarter;'
refused 3 'kMissing is not a constant of type float' 'inline constexpr float kX = kMissing;'
refused 3 'the name is defined twice' 'inline constexpr float kQuarter = 0.5F;'
refused 3 'the header ends within a statement' 'inline constexpr float kX ='
echo "valid headers are translated, invalid ones refused"
