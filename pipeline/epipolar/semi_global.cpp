#include "pipeline/epipolar/semi_global.h"

#include <algorithm>
#include <atomic>

namespace mfar {
namespace {

/// Divides memory into pieces, and hands out one piece to each part of a loop that Workers splits
/// into parts.
class Slots {
public:
    Slots(std::vector<std::uint8_t>& memory, std::size_t bytes, int most)
        : memory_(memory), bytes_(bytes) {
        if (memory.size() < bytes * most) memory.resize(bytes * most);
    }
    [[nodiscard]] std::uint8_t* next() { return memory_.data() + bytes_ * taken_++; }

private:
    std::vector<std::uint8_t>& memory_;
    std::size_t bytes_;
    std::atomic<std::size_t> taken_ = 0;
};

}  // namespace

float vertexOf(const Valley& valley) {
    const int left = valley.rise[1], right = valley.rise[2], rise = std::max(left, right);
    const auto label = static_cast<float>(valley.label);
    if (rise == 0 || rise == Valley::kUnknown) return label;
    return label + 0.5F * static_cast<float>(left - right) / static_cast<float>(rise);
}

SemiGlobal::SemiGlobal(std::size_t vectors) : costs_(kLabels * vectors), sums_(kLabels * vectors) {}

void SemiGlobal::run(const LumaImage& guide, const std::vector<std::int16_t>& base, int vectors,
                     const Smoothness& smoothness, const CostRow& costs, Workers& workers,
                     std::span<Valley> out) {
    for (int d = 0; d < 256; ++d) {
        const double edge = std::max(0.0, d - smoothness.noise);
        const double jump = std::max<double>(smoothness.step + 3, smoothness.jump * 8 / (8 + edge));
        jumps_[d] = static_cast<std::uint8_t>(jump);
    }
    int differences = 255;
    while (differences > 0 && jumps_[differences - 1] == jumps_[255])
        --differences;
    const auto [width, height] = guide.size;
    const simd::PathVolume volume{guide.pixels.data(),
                                  base.data(),
                                  guide.size,
                                  vectors,
                                  static_cast<std::uint8_t>(smoothness.step),
                                  differences,
                                  jumps_.data(),
                                  costs_.data(),
                                  sums_.data()};
    const std::size_t row = static_cast<std::size_t>(width) * kLabels * vectors;
    constexpr int kRows = simd::kRowsTogether, kColumns = simd::kColumnsTogether;
    const int parts = 4 * workers.count();
    Slots forRows(scratch_, simd::pathScratch(vectors, 1), parts);
    workers.forRange((height + kRows - 1) / kRows, 1, [&](int first, int last) {
        std::uint8_t* scratch = forRows.next();
        for (int y = kRows * first; y < std::min(kRows * last, height); y += kRows) {
            const int end = std::min(y + kRows, height);
            for (int j = y; j < end; ++j)
                costs(j, costs_.data() + j * row);
            simd::pathsAlongRows(volume, y, end, scratch);
        }
    });
    Slots forColumns(scratch_, simd::pathScratch(vectors, kColumns), parts);
    workers.forRange((width + kColumns - 1) / kColumns, 1, [&](int first, int last) {
        std::uint8_t* scratch = forColumns.next();
        for (int x = kColumns * first; x < std::min(kColumns * last, width); x += kColumns)
            simd::pathsAlongColumns(volume, x, std::min(x + kColumns, width), scratch, out.data());
    });
}

}  // namespace mfar
