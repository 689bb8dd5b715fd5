#include "hal/device/display_host_scaler.h"
#include "tests/oracle/area_mean.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>

namespace mfar {
namespace {

using Pixels = AlignedRows<std::uint32_t>;

Pixels noisy(Size size) {
    std::mt19937 random(7);
    Pixels out(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            out[y][x] = random() % 3 != 0 ? static_cast<std::uint32_t>(random()) : 0x00ff00ff;
    return out;
}

std::array<int, 3> colourOf(std::uint32_t pixel) {
    return {static_cast<int>(pixel & 255), static_cast<int>(pixel >> 8 & 255),
            static_cast<int>(pixel >> 16 & 255)};
}

double worstError(HostScaler& scaler, const Pixels& picture, Size screen) {
    const Rows<const std::uint32_t> shown = scaler.scaled(picture.rows());
    EXPECT_EQ(shown.size, screen);
    const ScreenRect r = letterbox(picture.size(), screen);
    const auto colour = [&](int x, int y) { return colourOf(picture[y][x]); };
    double worst = 0;
    for (int y = 0; y < screen.height; ++y)
        for (int x = 0; x < screen.width; ++x) {
            const int u = x - r.x, v = y - r.y;
            const bool inside = u >= 0 && v >= 0 && u < r.size.width && v < r.size.height;
            const auto wanted = inside ? twin::scaledPixel(picture.size(), colour, r, u, v)
                                       : std::array<double, 3>{};
            for (std::size_t k = 0; k < 3; ++k)
                worst = std::max(worst, std::abs(colourOf(shown[y][x])[k] - wanted[k]));
        }
    return worst;
}

TEST(HostScaler, APictureOfTheScreensSizeIsReturnedWithoutACopy) {
    const Pixels picture = noisy({321, 97});
    HostScaler scaler({321, 97});
    EXPECT_EQ(scaler.scaled(picture.rows()).data, picture.rows().data);
}

TEST(HostScaler, EveryPixelIsTheMeanOfItsFootprint) {
    struct Case {
        Size from, screen;
    };
    for (const auto [from, screen] : {Case{{230, 172}, {128, 72}},
                                      {{64, 48}, {160, 90}},
                                      {{300, 20}, {40, 50}},
                                      {{96, 72}, {128, 72}},
                                      {{9, 9}, {9, 5}},
                                      {{1, 1}, {33, 17}},
                                      {{700, 500}, {1, 1}},
                                      {{17, 400}, {31, 23}}}) {
        HostScaler scaler(screen);
        // Tolerance: rounding by half a grey level, and products that are truncated.
        EXPECT_LE(worstError(scaler, noisy(from), screen), 0.55)
            << from.width << "x" << from.height;
    }
}

TEST(HostScaler, UniformPicturesKeepEveryGreyLevel) {
    const Size from{50, 37}, screen{24, 18};
    HostScaler smaller(screen), larger({200, 148});
    for (std::uint32_t level = 0; level < 256; ++level) {
        Pixels picture(from);
        for (int y = 0; y < from.height; ++y)
            std::fill_n(picture[y], from.width, level * 0x010101U);
        for (HostScaler* scaler : {&smaller, &larger}) {
            const Rows<const std::uint32_t> shown = scaler->scaled(picture.rows());
            std::set<std::uint32_t> levels;
            for (int y = 0; y < shown.size.height; ++y)
                levels.insert(shown[y], shown[y] + shown.size.width);
            levels.erase(0xff000000);
            ASSERT_LE(levels.size(), 1U);
            for (const std::uint32_t pixel : levels)
                ASSERT_EQ(pixel & 0xffffff, level * 0x010101U);
        }
    }
}

TEST(HostScaler, PicturesMayChangeTheirSize) {
    const Size screen{64, 64};
    HostScaler scaler(screen);
    for (const Size size : {Size{200, 100}, {64, 32}, {100, 200}, {64, 64}, {10, 64}, {200, 100}})
        EXPECT_LE(worstError(scaler, noisy(size), screen), 0.55) << size.width;
}

}  // namespace
}  // namespace mfar
