#include "tests/fuzz/mutator.h"

#include <algorithm>
#include <cstring>
#include <string_view>

namespace {

/// Corrects the lengths of a .glb, of its JSON chunk (which ends at the BIN chunk) and of its BIN
/// chunk.
void mendHeader(std::vector<std::uint8_t>& file) {
    constexpr std::size_t kJson = 20;
    if (file.size() < kJson + 8 || std::memcmp(file.data(), "glTF", 4) != 0) return;
    const auto put = [&](std::size_t at, std::size_t value) {
        const auto word = static_cast<std::uint32_t>(value);
        std::memcpy(&file[at], &word, sizeof word);
    };
    constexpr std::string_view kBin("BIN\0", 4);
    const auto bin = std::search(file.begin() + kJson, file.end(), kBin.begin(), kBin.end());
    if (bin == file.end()) return;
    // Spaces at the end of the JSON text align the next chunk.
    auto chunk = static_cast<std::size_t>(bin - file.begin()) - 4;
    file.insert(file.begin() + static_cast<std::ptrdiff_t>(chunk), (4 - chunk % 4) % 4, ' ');
    chunk = (chunk + 3) / 4 * 4;
    file.resize((file.size() + 3) / 4 * 4);
    put(8, file.size());
    put(12, chunk - kJson);
    put(chunk, file.size() - chunk - 8);
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
    return mfar::test::mutated(data, size, most, seed, mendHeader);
}
