#include "pipeline/simd/enlarge_rows.h"
#include "tests/engine/simd/every_target.h"
#include "tests/oracle/learned.h"

#include <gtest/gtest.h>

#include <random>

namespace mfar::simd {
namespace {

using namespace enlarge;
using test::onEveryTarget;
using twin::Grey;

constexpr int kMargin = 64;

struct LumaPicture {
    LumaPicture(Size size, const std::function<int(int, int)>& eighthsAt)
        : grey(twin::greyOf(size,
                            [&](int x, int y) { return eighthsAt(x, y) / double(kLumaScale); })),
          rows({size.width + 2 * kMargin, size.height}) {
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width + 2 * kMargin; ++x)
                rows[y][x] = static_cast<std::int16_t>(kLumaScale * grey.at(x - kMargin, y));
    }
    template <std::size_t Count>
    [[nodiscard]] std::array<const std::int16_t*, Count> around(int y) const {
        std::array<const std::int16_t*, Count> out{};
        for (int k = 0; k < int(Count); ++k)
            out[k] = rows[std::clamp(y + k - int(Count) / 2, 0, grey.size.height - 1)] + kMargin;
        return out;
    }

    Grey grey;
    AlignedRows<std::int16_t> rows;
};

LumaPicture texturedPicture(Size size, unsigned seed) {
    std::mt19937 random(seed);
    return {size, [&](int x, int y) {
                const double wave = 80 * std::sin(0.31 * x + 0.17 * y) +
                                    60 * std::sin(0.05 * x * y / 7.0 - 0.4 * y) +
                                    (x * 3 + y * 5 > 150 ? 60 : 0);
                const int grain = int(random() % 97) - 48;
                return std::clamp(int(8 * (120 + 0.6 * wave)) + grain, 0, 2040);
            }};
}

std::vector<FilterBank::Filter> randomFilters(int most, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<FilterBank::Filter> out(kUnique);
    for (FilterBank::Filter& filter : out)
        for (std::int16_t& weight : filter)
            weight = static_cast<std::int16_t>(int(random() % (2 * most + 1)) - most);
    return out;
}

struct Classes {
    explicit Classes(const LumaPicture& p)
        : gradient(p.grey.size), curvature(p.grey.size),
          sums({p.grey.size.width + 2 * kMargin, 3}) {}
    void make(const LumaPicture& p, int y, int begin, int end) {
        classRow(p.around<7>(y), begin, end,
                 {sums[0] + kMargin, sums[1] + kMargin, sums[2] + kMargin}, gradient[y],
                 curvature[y]);
    }
    AlignedRows<std::uint16_t> gradient, curvature;
    AlignedRows<float> sums;
};

const std::vector<Size> kSizes{{1, 1}, {3, 5}, {16, 9}, {33, 12}, {97, 41}};

TEST(EnlargeRows, LumaMatchesTheOracle) {
    std::mt19937 random(3);
    onEveryTarget([&] {
        for (const int width : {1, 7, 16, 33, 100}) {
            std::array<std::vector<std::uint8_t>, 3> rgb;
            for (auto& channel : rgb)
                for (int x = 0; x < width; ++x)
                    channel.push_back(static_cast<std::uint8_t>(random()));
            AlignedRows<std::int16_t> out({width, 1});
            lumaEighthsRow({rgb[0].data(), rgb[1].data(), rgb[2].data()}, 0, width, out[0]);
            for (int x = 0; x < width; ++x)
                ASSERT_NEAR(out[0][x],
                            8 * (0.299 * rgb[0][x] + 0.587 * rgb[1][x] + 0.114 * rgb[2][x]), 0.8);
        }
    });
}

TEST(EnlargeRows, LumaOfGreyIsExact) {
    onEveryTarget([&] {
        std::vector<std::uint8_t> grey(256);
        std::iota(grey.begin(), grey.end(), 0);
        AlignedRows<std::int16_t> out({256, 1});
        lumaEighthsRow({grey.data(), grey.data(), grey.data()}, 0, 256, out[0]);
        for (int v = 0; v < 256; ++v)
            ASSERT_EQ(out[0][v], 8 * v);
    });
}

TEST(EnlargeRows, ClassesMatchTheOracle) {
    onEveryTarget([&] {
        int compared = 0, all = 0;
        for (const Size size : kSizes) {
            const LumaPicture p = texturedPicture(size, 5);
            Classes classes(p);
            for (int y = 0; y < size.height; ++y) {
                classes.make(p, y, 0, size.width);
                for (int x = 0; x < size.width; ++x) {
                    const auto gradient = twin::gradientClass(p.grey, x, y),
                               curvature = twin::curvatureClass(p.grey, x, y);
                    all += 2;
                    if (gradient.margin > 1e-3) {
                        ASSERT_EQ(classes.gradient[y][x], gradient.number) << x << " " << y;
                        ++compared;
                    }
                    if (curvature.margin > 1e-3) {
                        ASSERT_EQ(classes.curvature[y][x], curvature.number) << x << " " << y;
                        ++compared;
                    }
                }
            }
        }
        EXPECT_GT(compared, all * 0.8);
    });
}

TEST(EnlargeRows, WavesOfAllDirectionsContainMostClasses) {
    std::vector<bool> gradient(GradientClasses::kCount), curvature(CurvatureClasses::kCount);
    for (int angle = 0; angle < 64; ++angle)
        for (const double strength : {1.0, 4.0, 10.0, 40.0, 100.0}) {
            const double a = angle * std::numbers::pi / 64 + 0.01;
            const LumaPicture p({40, 40}, [&](int x, int y) {
                const double u = std::cos(a) * x + std::sin(a) * y,
                             v = std::cos(a) * y - std::sin(a) * x;
                return std::clamp(
                    int(1020 + 8 * strength * (std::sin(0.7 * u) + y / 40.0 * std::sin(0.6 * v))),
                    0, 2040);
            });
            Classes classes(p);
            for (int y = 0; y < 40; ++y) {
                classes.make(p, y, 0, 40);
                for (int x = 0; x < 40; ++x) {
                    gradient.at(classes.gradient[y][x]) = true;
                    curvature.at(classes.curvature[y][x]) = true;
                }
            }
        }
    EXPECT_GT(std::ranges::count(gradient, true), GradientClasses::kCount * 9 / 10);
    EXPECT_GT(std::ranges::count(curvature, true), CurvatureClasses::kCount * 8 / 10);
}

struct Residual {
    Residual(const LumaPicture& p, const FilterBank& bank)
        : classes(p), grid({4 * p.grey.size.width, 4 * p.grey.size.height}) {
        const auto [width, height] = p.grey.size;
        AlignedRows<std::int16_t> range({width, 2});
        const auto gradient = bank.gradient(), curvature = bank.curvature();
        for (int y = 0; y < height; ++y) {
            classes.make(p, y, 0, width);
            rangeRow(p.around<5>(y), 0, width, range[0], range[1]);
            residualRows(
                {p.around<5>(y), classes.gradient[y], classes.curvature[y], range[0], range[1]},
                {gradient.data, curvature.data, bank.cubic(), gradient.pitch, curvature.pitch}, 0,
                width, {grid[4 * y], grid[4 * y + 1], grid[4 * y + 2], grid[4 * y + 3]});
        }
    }
    Classes classes;
    AlignedRows<std::int16_t> grid;
};

TEST(EnlargeRows, ResidualMatchesTheOracleIfBothUseTheSameClasses) {
    for (const int most : {500, 8000}) {
        const FilterBank bank(randomFilters(most, 11));
        onEveryTarget([&] {
            for (const Size size : kSizes) {
                const LumaPicture p = texturedPicture(size, 7);
                const Residual residual(p, bank);
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x)
                        for (int phase = 0; phase < kPhases; ++phase) {
                            const int row = 4 * y + phase / 4, column = 4 * x + phase % 4;
                            ASSERT_NEAR(residual.grid[row][column],
                                        32 * twin::residualAt(p.grey, x, y, phase,
                                                              residual.classes.gradient[y][x],
                                                              residual.classes.curvature[y][x],
                                                              bank),
                                        // tolerance [1/32 grey level]: see gles/enlarge_test.cpp
                                        8.6)
                                << x << " " << y << " " << phase;
                        }
            }
        });
    }
}

TEST(EnlargeRows, ResidualOfFlatPicturesIsExactlyZero) {
    const FilterBank bank(randomFilters(8000, 2));
    onEveryTarget([&] {
        for (const int level : {0, 1, 1000, 2040}) {
            const Residual residual(LumaPicture({37, 9}, [&](int, int) { return level; }), bank);
            for (int y = 0; y < 36; ++y)
                for (int x = 0; x < 148; ++x)
                    ASSERT_EQ(residual.grid[y][x], 0);
        }
    });
}

TEST(EnlargeRows, PixelsOfExtremePicturesStayNearTheRangeOfTheirNeighbours) {
    std::mt19937 random(1);
    const FilterBank bank(randomFilters(10000, 9));
    onEveryTarget([&] {
        for (const int kind : {0, 1, 2}) {
            const LumaPicture p({61, 30}, [&](int x, int y) {
                if (kind == 0) return random() % 2 == 0 ? 0 : 2040;
                if (kind == 1) return (x + y) % 2 == 0 ? 2040 : 0;
                return x == 30 && y == 15 ? 2040 : 0;
            });
            const Residual residual(p, bank);
            const Grey up = twin::enlarged(p.grey, {244, 120});
            for (int y = 0; y < 120; ++y)
                for (int x = 0; x < 244; ++x) {
                    const auto [low, high] = twin::rangeAround(p.grey, x / 4, y / 4);
                    const double more = (high - low) / 4 + 0.5;
                    const double sum = up.at(x, y) + residual.grid[y][x] / 32.0;
                    ASSERT_GE(sum, low - more) << x << " " << y;
                    ASSERT_LE(sum, high + more) << x << " " << y;
                }
        }
    });
}

TEST(EnlargeRows, MirroredAndTransposedPicturesHaveTheSameResiduals) {
    const FilterBank& bank = FilterBank::prior();
    const Size size{29, 29};
    const LumaPicture p = texturedPicture(size, 4);
    const auto eighths = [&](int x, int y) { return int(8 * p.grey.at(x, y)); };
    const LumaPicture mirrored(size, [&](int x, int y) { return eighths(x, 28 - y); }),
        transposed(size, [&](int x, int y) { return eighths(y, x); });
    const Residual a(p, bank), b(mirrored, bank), c(transposed, bank);
    for (int y = 0; y < 116; ++y)
        for (int x = 0; x < 116; ++x) {
            if (twin::gradientClass(p.grey, x / 4, y / 4).margin < 1e-3 ||
                twin::curvatureClass(p.grey, x / 4, y / 4).margin < 1e-3)
                continue;
            ASSERT_NEAR(a.grid[y][x], b.grid[115 - y][x], 1) << x << " " << y;
            ASSERT_NEAR(a.grid[y][x], c.grid[x][y], 1) << x << " " << y;
        }
}

TEST(EnlargeRows, BlurredEdgesGetSharper) {
    // A step, averaged over the area of each pixel. At each angle, the result must be closer to the
    // true step than cubic enlargement is. The mean over the angles has a stricter limit.
    double allBefore = 0, allAfter = 0;
    for (const double degrees : {0.0, 17.0, 45.0, 71.0, 90.0, 118.0}) {
        const double a = degrees * std::numbers::pi / 180, nx = std::cos(a), ny = std::sin(a);
        const auto step = [&](double x, double y) {
            return nx * (x - 20.2) + ny * (y - 20.4) > 0 ? 180.0 : 60.0;
        };
        const auto mean = [&](double x, double y, double side) {
            double sum = 0;
            for (int j = 0; j < 16; ++j)
                for (int i = 0; i < 16; ++i)
                    sum +=
                        step(x + ((i + 0.5) / 16 - 0.5) * side, y + ((j + 0.5) / 16 - 0.5) * side);
            return sum / 256;
        };
        const LumaPicture p({41, 41},
                            [&](int x, int y) { return 8 * int(std::lround(mean(x, y, 1))); });
        const Residual residual(p, FilterBank::prior());
        const Grey up = twin::enlarged(p.grey, {164, 164});
        double before = 0, after = 0;
        for (int y = 24; y < 140; ++y)
            for (int x = 24; x < 140; ++x) {
                const double truth = mean((x + 0.5) / 4 - 0.5, (y + 0.5) / 4 - 0.5, 0.28);
                before += std::pow(up.at(x, y) - truth, 2);
                after += std::pow(up.at(x, y) + residual.grid[y][x] / 32.0 - truth, 2);
            }
        EXPECT_LT(after, 0.9 * before) << degrees;
        allBefore += before;
        allAfter += after;
    }
    EXPECT_LT(allAfter, 0.8 * allBefore);
}

TEST(EnlargeRows, AMixedResidualRowLiesBetweenItsTwoInputs) {
    onEveryTarget([&] {
        AlignedRows<std::int16_t> rows({50, 2});
        AlignedRows<float> out({50, 1});
        for (int x = 0; x < 50; ++x) {
            rows[0][x] = static_cast<std::int16_t>(17 * x - 300);
            rows[1][x] = static_cast<std::int16_t>(100 - 9 * x);
        }
        mixedRow(rows[0], rows[1], 0.25F, 3, 50, out[0]);
        for (int x = 3; x < 50; ++x)
            ASSERT_FLOAT_EQ(out[0][x], 0.75F * rows[0][x] + 0.25F * rows[1][x]);
    });
}

}  // namespace
}  // namespace mfar::simd
