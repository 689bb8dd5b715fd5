#include "pipeline/epipolar/epipolar_search.h"
#include "pipeline/flow/flow_options.h"
#include "tests/flow/flow_scene.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace mfar {
namespace {

TEST(FlowOptions, DefaultsAreValid) {
    EXPECT_NO_THROW(validate(Flow2dOptions{}));
    EXPECT_NO_THROW(validate(EpipolarOptions{}));
}

template <class Options>
void expectRange(int Options::* option, int least, int most) {
    for (const int value : {least, most}) {
        Options options;
        options.*option = value;
        EXPECT_NO_THROW(validate(options));
    }
    for (const int value : {least - 1, most + 1, std::numeric_limits<int>::min()}) {
        Options options;
        options.*option = value;
        EXPECT_THROW(validate(options), std::invalid_argument);
    }
}

TEST(FlowOptions, ValuesOutOfRangeAreRefused) {
    expectRange(&Flow2dOptions::levels, 1, 6);
    expectRange(&Flow2dOptions::searchRadius, 0, 40);
    expectRange(&Flow2dOptions::candidates, 1, 4);
    expectRange(&Flow2dOptions::steps, 0, 16);
    expectRange(&Flow2dOptions::propagations, 0, 8);
    expectRange(&Flow2dOptions::coarsestPropagations, 0, 8);
    expectRange(&Flow2dOptions::planeFits, 0, 2);
    expectRange(&EpipolarOptions::levels, 1, 4);
    expectRange(&EpipolarOptions::windowRadius, 0, 8);
    expectRange(&EpipolarOptions::stepPenalty, 1, 30);
    expectRange(&EpipolarOptions::jumpPenalty, 1, 60);
    expectRange(&EpipolarOptions::finest, 0, 2);
    expectRange(&EpipolarOptions::mostPredicted, 0, 60);
    for (const double share : {0.0, -1.0, 1.01, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW(validate(EpipolarOptions{.longestParallax = share}), std::invalid_argument);
}

test::FlowErrors errorsWith(const EpipolarOptions& options) {
    const CameraModel camera{{200, 150}, 190, 190, 99.5, 74.5, {}};
    const test::View view{
        camera, {{{{0, 0, 1}, 2}}, 30, 100}, test::motion({0, 0, 0}, {-0.4, 0, 0})};
    EpipolarSearch search({camera, camera, {}}, std::make_shared<Workers>(2), options);
    search.setStill(test::viewOf(view.still()));
    EXPECT_TRUE(search.run(view.video(), view.T_still_video));
    EXPECT_TRUE(test::isFinite(search));
    return test::errorsOf(search, view);
}

TEST(EpipolarOptions, SettingsOtherThanTheDefaultsFindAWall) {
    for (const int levels : {1, 2, 3, 4})
        EXPECT_LT(errorsWith({.levels = levels}).bad, 0.02) << levels;
    for (const int radius : {0, 8})
        EXPECT_LT(errorsWith({.windowRadius = radius}).bad, 0.02) << radius;
    EXPECT_LT(errorsWith({.longestParallax = 0.25}).bad, 0.02);
    EXPECT_LT(errorsWith({.stepPenalty = 30}).bad, 0.02);
    EXPECT_LT(errorsWith({.jumpPenalty = 1}).bad, 0.1);
}

TEST(EpipolarOptions, HalfTheResolutionFindsAWallToAboutAPixel) {
    for (const int levels : {1, 2, 4})
        EXPECT_LT(errorsWith({.levels = levels, .finest = 1}).bad, 0.02) << levels;
}

TEST(EpipolarOptions, OptionsExceptLevelsCanBeChangedBetweenFrames) {
    const CameraModel camera{{200, 150}, 190, 190, 99.5, 74.5, {}};
    const test::View view{
        camera, {{{{0, 0, 1}, 2}}, 30, 100}, test::motion({0, 0, 0}, {-0.4, 0, 0})};
    const LumaImage video = view.video(), still = view.still();
    EpipolarSearch search = test::searchWith(camera, 2);
    search.setStill(test::viewOf(still));
    search.setOptions({.levels = 1, .finest = 1});
    ASSERT_TRUE(search.run(video, view.T_still_video));
    EXPECT_EQ(test::errorsOf(search, view).median, errorsWith({.finest = 1}).median)
        << "a change of `levels` between frames must have no effect";
    search.setOptions({});
    ASSERT_TRUE(search.run(video, view.T_still_video));
    EXPECT_EQ(test::errorsOf(search, view).median, errorsWith({}).median);
    EXPECT_THROW(search.setOptions({.windowRadius = -1}), std::invalid_argument);
}

TEST(EpipolarOptions, LongestParallaxLimitsTheSearch) {
    EXPECT_GT(errorsWith({.levels = 1, .longestParallax = 0.05}).bad, 0.9);
}

}  // namespace
}  // namespace mfar
