#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace mfar::test {

/// Damages files: bytes, words, decimal numbers, pieces left out, doubled or taken from another
/// file. A .glb keeps a header that fits its length most of the time, so that damage gets through
/// to where it hurts. The same seed gives the same files.
class Mutations {
public:
    using File = std::vector<std::uint8_t>;

    explicit Mutations(std::uint64_t seed) : random_(seed) {}

    [[nodiscard]] File next(const std::vector<File>& seeds);

private:
    /// 0 .. below - 1
    std::size_t any(std::size_t below);
    void damage(File& file, const std::vector<File>& seeds);
    void changeNumber(File& file);
    void changeWord(File& file);
    void cut(File& file);
    void copyPiece(File& file, const File& from);

    std::mt19937_64 random_;
};

}  // namespace mfar::test
