#include "tests/fuzz/mutator.h"

#include <zlib.h>

namespace {

std::uint32_t bigEndian(const std::uint8_t* p) {
    return std::uint32_t{p[0]} << 24U | std::uint32_t{p[1]} << 16U | std::uint32_t{p[2]} << 8U |
           p[3];
}

void mendChecksums(std::vector<std::uint8_t>& file) {
    constexpr std::size_t kSignature = 8,
                          kAround = 12;  // kAround: bytes of a chunk without its data
    if (file.size() < kSignature || file[1] != 'P' || file[2] != 'N' || file[3] != 'G') return;
    for (std::size_t at = kSignature; at + kAround <= file.size();) {
        const std::size_t length = bigEndian(&file[at]);
        if (length > file.size() - at - kAround) return;
        const uLong sum = crc32(0, &file[at + 4], static_cast<uInt>(length + 4));
        for (unsigned i = 0; i < 4; ++i)
            file[at + 8 + length + i] = static_cast<std::uint8_t>(sum >> (24 - 8 * i));
        at += kAround + length;
    }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
    return mfar::test::mutated(data, size, most, seed, mendChecksums);
}
