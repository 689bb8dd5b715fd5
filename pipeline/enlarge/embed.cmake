# Usage: cmake -DIN=prior.filters -DOUT=file.cpp -P embed.cmake. Writes the bytes of prior.filters
# as an array into a C++ source file.
cmake_minimum_required(VERSION 3.25)

file(READ "${IN}" hex HEX)
string(REGEX REPLACE "(................................)" "\\1\n" hex "${hex}")
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," bytes "${hex}")
file(WRITE "${OUT}" "#include \"pipeline/enlarge/prior_filters.h\"

namespace mfar::enlarge {
namespace {

constexpr std::uint8_t kBytes[] = {
${bytes}
};

}  // namespace

std::span<const std::uint8_t> priorFilters() {
    return kBytes;
}

}  // namespace mfar::enlarge
")
