#include "pipeline/enlarge/warped_grid.h"
#include "tests/oracle/superres.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace mfar::enlarge {
namespace {

TEST(LookUpAt, AgreesWithTheOracleWithAndWithoutJumps) {
    const Size size{9, 7};
    std::mt19937 random(1);
    std::uniform_real_distribution<float> offset(-20, 20), weight(0, 1);
    AlignedRows<LookUpCell> cells(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const float right = x + 1 < size.width && random() % 4 == 0 ? params::kJumpRight : 0,
                        below = y + 1 < size.height && random() % 4 == 0 ? params::kJumpBelow : 0;
            cells[y][x] = {offset(random), offset(random), weight(random), 0.9F + right + below};
        }
    const auto field = [&](auto member) {
        return twin::greyOf(size, [&](int x, int y) { return double(cells[y][x].*member); });
    };
    const twin::Grey codes = field(&LookUpCell::confidenceAndJumps);
    std::uniform_real_distribution<double> across(-2, 4 * size.width + 2),
        down(-2, 4 * size.height + 2);
    for (int i = 0; i < 5000; ++i) {
        const double px = across(random), py = down(random);
        const double x = std::clamp((px - 1.5) / 4, 0.0, size.width - 1.0),
                     y = std::clamp((py - 1.5) / 4, 0.0, size.height - 1.0);
        const LookUpCell got = lookUpAt(cells, px, py);
        for (const auto member : {&LookUpCell::x, &LookUpCell::y, &LookUpCell::weight})
            ASSERT_NEAR(got.*member, twin::lookedUp(field(member), codes, x, y), 1e-4)
                << px << ", " << py;
    }
}

}  // namespace
}  // namespace mfar::enlarge
