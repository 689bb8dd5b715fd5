#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace mfar::test {

/// Implements LLVMFuzzerCustomMutator(): runs libFuzzer's own mutation and then `mend`. `mend`
/// corrects a length or a checksum whose check would refuse the input early. One time in ten,
/// `mend` is skipped.
template <class Mend>
std::size_t mutated(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed,
                    const Mend& mend) {
    constexpr unsigned kOneIn = 10;
    size = LLVMFuzzerMutate(data, size, most);
    if (seed % kOneIn == 0) return size;
    std::vector<std::uint8_t> file(data, data + size);
    mend(file);
    size = std::min(file.size(), most);
    std::memcpy(data, file.data(), size);
    return size;
}

}  // namespace mfar::test
