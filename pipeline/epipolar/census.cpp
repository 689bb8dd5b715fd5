#include "pipeline/epipolar/census.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace mfar {
namespace {

constexpr int kRadius = 2;

/// The row with kRadius pixels repeated at both ends.
void padRow(const std::uint8_t* row, int width, std::vector<std::uint8_t>& out) {
    std::copy_n(row, width, out.begin() + kRadius);
    std::fill_n(out.begin(), kRadius, row[0]);
    std::fill_n(out.begin() + kRadius + width, kRadius, row[width - 1]);
}

}  // namespace

void census(const LumaImage& picture, int first, int last, std::vector<std::uint32_t>& out) {
    const int w = picture.size.width, h = picture.size.height;
    std::array<std::vector<std::uint8_t>, 2 * kRadius + 1> rows;
    for (auto& row : rows)
        row.resize(static_cast<std::size_t>(w) + 2 * kRadius);
    for (int y = first; y < last; ++y) {
        for (int j = -kRadius; j <= kRadius; ++j)
            padRow(picture.row(std::clamp(y + j, 0, h - 1)), w, rows[j + kRadius]);
        const std::uint8_t* centre = rows[kRadius].data() + kRadius;
        std::uint32_t* to = out.data() + static_cast<std::size_t>(y) * w;
        std::fill_n(to, w, 0U);
        for (int j = 0; j <= 2 * kRadius; ++j) {
            for (int i = 0; i <= 2 * kRadius; ++i) {
                if (i == kRadius && j == kRadius) continue;
                const std::uint8_t* neighbour = rows[j].data() + i;
                for (int x = 0; x < w; ++x)
                    to[x] = (to[x] << 1) | static_cast<std::uint32_t>(neighbour[x] < centre[x]);
            }
        }
    }
}

}  // namespace mfar
