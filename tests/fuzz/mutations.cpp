#include "tests/fuzz/mutations.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <string_view>

namespace mfar::test {
namespace {

using File = Mutations::File;

/// What breaks arithmetic on sizes and indices, and coordinates.
constexpr std::array<std::string_view, 14> kNumbers = {"0",
                                                       "1",
                                                       "-1",
                                                       "2",
                                                       "255",
                                                       "65535",
                                                       "2147483647",
                                                       "4294967295",
                                                       "9223372036854775807",
                                                       "18446744073709551615",
                                                       "1e308",
                                                       "-0.5",
                                                       "null",
                                                       "[]"};
constexpr std::array<std::uint32_t, 9> kWords = {
    0, 1, 0x7FFFFFFF, 0x80000000U, 0xFFFFFFFFU, 0x7F800000, 0x7FC00000, 0x00000100, 0xFFFEU};

/// The lengths of a .glb and of its JSON as they should be: the latter up to the BIN chunk.
void mendHeader(File& file) {
    constexpr std::size_t kJson = 20;
    if (file.size() < kJson + 8 || std::memcmp(file.data(), "glTF", 4) != 0) return;
    const auto put = [&](std::size_t at, std::size_t value) {
        const auto word = static_cast<std::uint32_t>(value);
        std::memcpy(&file[at], &word, sizeof word);
    };
    constexpr std::string_view kBin("BIN\0", 4);
    const auto bin = std::search(file.begin() + kJson, file.end(), kBin.begin(), kBin.end());
    if (bin == file.end()) return;
    // Spaces at the end of the JSON keep the chunks aligned.
    auto chunk = static_cast<std::size_t>(bin - file.begin()) - 4;
    file.insert(file.begin() + static_cast<std::ptrdiff_t>(chunk), (4 - chunk % 4) % 4, ' ');
    chunk = (chunk + 3) / 4 * 4;
    file.resize((file.size() + 3) / 4 * 4);
    put(8, file.size());
    put(12, chunk - kJson);
    put(chunk, file.size() - chunk - 8);
}

}  // namespace

File Mutations::next(const std::vector<File>& seeds) {
    File file = seeds[any(seeds.size())];
    for (std::size_t left = any(6); left > 0 && !file.empty(); --left)
        damage(file, seeds);
    constexpr std::size_t kOneInSoMany = 10;
    if (any(kOneInSoMany) != 0) mendHeader(file);
    return file;
}

std::size_t Mutations::any(std::size_t below) {
    return random_() % below;
}

void Mutations::damage(File& file, const std::vector<File>& seeds) {
    switch (any(8)) {
    case 0: file[any(file.size())] ^= static_cast<std::uint8_t>(1U << any(8)); break;
    case 1: file[any(file.size())] = static_cast<std::uint8_t>(random_()); break;
    case 2: changeWord(file); break;
    case 3: cut(file); break;
    case 4: copyPiece(file, file); break;
    case 5: copyPiece(file, seeds[any(seeds.size())]); break;
    default: changeNumber(file); break;
    }
}

void Mutations::changeNumber(File& file) {
    const std::size_t from = any(file.size());
    const auto begin = std::find_if(file.begin() + static_cast<std::ptrdiff_t>(from), file.end(),
                                    [](std::uint8_t c) { return std::isdigit(c) != 0; });
    const auto end =
        std::find_if(begin, file.end(), [](std::uint8_t c) { return std::isdigit(c) == 0; });
    const std::string_view number = kNumbers[any(kNumbers.size())];
    const auto at = file.erase(begin, end);
    file.insert(at, number.begin(), number.end());
}

void Mutations::changeWord(File& file) {
    const std::uint32_t word = kWords[any(kWords.size())];
    const std::size_t at = any(file.size());
    std::memcpy(&file[at], &word, std::min(sizeof word, file.size() - at));
}

void Mutations::cut(File& file) {
    const std::size_t at = any(file.size()), length = any(file.size() - at) / (1 + any(16));
    const auto begin = file.begin() + static_cast<std::ptrdiff_t>(at);
    file.erase(begin, begin + static_cast<std::ptrdiff_t>(length));
}

void Mutations::copyPiece(File& file, const File& from) {
    const std::size_t at = any(from.size());
    const std::size_t length = std::min(any(200) + 1, from.size() - at);
    const File piece(from.begin() + static_cast<std::ptrdiff_t>(at),
                     from.begin() + static_cast<std::ptrdiff_t>(at + length));
    file.insert(file.begin() + static_cast<std::ptrdiff_t>(any(file.size() + 1)), piece.begin(),
                piece.end());
}

}  // namespace mfar::test
