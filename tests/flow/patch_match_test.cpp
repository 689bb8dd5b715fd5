#include "pipeline/epipolar/patch_match.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace mfar {
namespace {

LumaImage drawn(Size size, const std::function<double(double, double)>& grey) {
    LumaImage out(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            out.row(y)[x] = static_cast<std::uint8_t>(std::lround(grey(x, y)));
    return out;
}

double waves(double x, double y) {
    return 120 + 30 * std::sin(0.71 * x + 0.2 * y) + 30 * std::sin(-0.3 * x + 0.63 * y) +
           30 * std::sin(0.35 * x + 0.41 * y + 1);
}

std::vector<std::uint8_t> allSeen(const LumaImage& picture) {
    return std::vector<std::uint8_t>(picture.pixels.size(), 1);
}

std::optional<Eigen::Vector2d> placed(const PatchMatcher& matcher, PatchPlace place,
                                      const PatchWindow& window) {
    const auto found = matcher.find(place, window);
    return found ? matcher.polish(place, *found) : std::nullopt;
}

TEST(TexturedPlaces, PatchesAreChosenWhereThePictureHasTexture) {
    const LumaImage picture =
        drawn({160, 120}, [](double x, double y) { return x < 80 ? waves(x, y) : 90; });
    const auto places = texturedPlaces(picture, 0);
    EXPECT_GT(places.size(), 50U);
    EXPECT_LE(places.size(), 400U);
    for (const PatchPlace& p : places) {
        EXPECT_GE(std::min(p.x, p.y), 1);
        EXPECT_LT(p.x, 80);
        EXPECT_LT(p.y + kPatch, 120);
    }
}

TEST(TexturedPlaces, PatchesOfNoiseOrStraightEdgesAreNotChosen) {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(120, 4);
    const auto grain = drawn({160, 120}, [&](double, double) { return noise(random); });
    EXPECT_TRUE(texturedPlaces(grain, 4).empty());
    EXPECT_FALSE(texturedPlaces(grain, 0).empty());
    const auto edges =
        drawn({160, 120}, [](double x, double) { return static_cast<int>(x) / 20 % 2 * 200; });
    EXPECT_TRUE(texturedPlaces(edges, 0).empty());
}

TEST(TexturedPlaces, PatchesOfTinyPicturesAreInsideThePicture) {
    for (int w = 1; w <= 24; ++w)
        for (int h = 1; h <= 24; ++h)
            for (const PatchPlace& p : texturedPlaces(drawn({w, h}, waves), 0)) {
                ASSERT_GE(std::min(p.x, p.y), 1);
                ASSERT_LT(p.x + kPatch, w);
                ASSERT_LT(p.y + kPatch, h);
            }
}

TEST(PatchMatcher, FindsShiftsByFractionsOfPixelsAtAnyGain) {
    const LumaImage from = drawn({60, 50}, waves);
    for (const auto& [gain, offset] : {std::pair(1.0, 0.0), {0.5, 60.0}, {0.8, -15.0}}) {
        for (const Eigen::Vector2d& d :
             {Eigen::Vector2d(0, 0), Eigen::Vector2d(2.3, -1.6), Eigen::Vector2d(-3.5, 2.75)}) {
            const LumaImage to = drawn({60, 50}, [&, g = gain, o = offset](double x, double y) {
                return g * waves(x - d.x(), y - d.y()) + o;
            });
            const auto seen = allSeen(to);
            const PatchMatcher matcher(from, to, seen);
            const PatchPlace place{25, 21};
            const auto at = placed(matcher, place, {place.middle(), {0.6, 0.8}, 5, 5});
            ASSERT_TRUE(at);
            EXPECT_LT((*at - place.middle() - d).norm(), 0.06) << d.transpose() << ' ' << gain;
        }
    }
}

TEST(PatchMatcher, AmbiguousMatchesAreRefused) {
    const auto grid = drawn({60, 50}, [](double x, double y) {
        return 120 + 60 * std::sin(2 * M_PI * x / 6) + 60 * std::sin(2 * M_PI * y / 6);
    });
    const auto seen = allSeen(grid);
    const PatchPlace place{25, 21};
    const PatchMatcher matcher(grid, grid, seen);
    EXPECT_FALSE(matcher.find(place, {place.middle(), {1, 0}, 7, 1}));
    EXPECT_TRUE(matcher.find(place, {place.middle(), {1, 0}, 2, 2}));
}

TEST(PatchMatcher, PatchesInUniformPicturesOrWithoutValidPixelsAreRefused) {
    const LumaImage from = drawn({60, 50}, waves);
    const auto seen = allSeen(from);
    const PatchPlace place{25, 21};
    const PatchWindow window{place.middle(), {1, 0}, 4, 4};
    for (const int grey : {0, 90, 255}) {
        const LumaImage even = drawn({60, 50}, [&](double, double) { return grey; });
        EXPECT_FALSE(PatchMatcher(from, even, seen).find(place, window));
        EXPECT_FALSE(PatchMatcher(from, even, seen).polish(place, place.middle()));
        EXPECT_FALSE(PatchMatcher(even, from, seen).find(place, window));
    }
    const std::vector<std::uint8_t> nothing(seen.size(), 0);
    EXPECT_FALSE(PatchMatcher(from, from, nothing).find(place, window));
    EXPECT_FALSE(PatchMatcher(from, from, nothing).polish(place, place.middle()));
}

TEST(PatchMatcher, MatchesStayWithinThePicture) {
    const LumaImage from = drawn({40, 30}, waves), to = drawn({24, 20}, waves);
    const auto seen = allSeen(to);
    const PatchMatcher matcher(from, to, seen);
    for (const double x :
         {-1e300, -1e7, -40.0, -3.0, 3.5, 12.0, 19.7, 24.0, 1e7, 1e300, std::nan("")}) {
        for (const double y : {-20.0, 3.4, 15.6, 20.0, std::nan("")}) {
            for (const auto& at : {placed(matcher, {8, 8}, {{x, y}, {1, 0}, 6, 6}),
                                   matcher.polish({8, 8}, {x, y})}) {
                if (!at) continue;
                EXPECT_GE(at->minCoeff(), 0);
                EXPECT_LT(at->x(), 24);
                EXPECT_LT(at->y(), 20);
            }
        }
    }
}

}  // namespace
}  // namespace mfar
