#include "pipeline/gles/still_reference.h"
#include "pipeline/superres/still_scale.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/gles/levels.h"
#include "tests/engine/gles/pipeline_case.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

using StillReducerTest = GlTest;

std::vector<double> reduced(const std::vector<double>& line, int to) {
    const int from = static_cast<int>(line.size());
    const double scale = static_cast<double>(from) / to;
    std::vector<double> out;
    for (int i = 0; i < to; ++i) {
        const double centre = (i + 0.5) * scale - 0.5;
        double sum = 0, weights = 0;
        for (int k = -4 * from; k < 5 * from; ++k) {
            const double weight = std::max(0.0, 1 - std::abs(k - centre) / scale);
            sum += weight * line[std::clamp(k, 0, from - 1)];
            weights += weight;
        }
        out.push_back(std::clamp(std::round(sum / weights), 0.0, 255.0));
    }
    return out;
}

std::vector<double> twinOf(const TestPicture& picture, Size to) {
    const Size from = picture.size;
    std::vector<double> narrow(static_cast<std::size_t>(to.width) * from.height),
        out(static_cast<std::size_t>(to.width) * to.height);
    for (int y = 0; y < from.height; ++y) {
        std::vector<double> row;
        for (int x = 0; x < from.width; ++x)
            row.push_back(picture.bytes[(y * from.width + x) * 4UL]);
        std::ranges::copy(reduced(row, to.width), narrow.begin() + long{y} * to.width);
    }
    for (int x = 0; x < to.width; ++x) {
        std::vector<double> column;
        for (int y = 0; y < from.height; ++y)
            column.push_back(narrow[static_cast<std::size_t>(y) * to.width + x]);
        const std::vector<double> down = reduced(column, to.height);
        for (int y = 0; y < to.height; ++y)
            out[static_cast<std::size_t>(y) * to.width + x] = down[y];
    }
    return out;
}

TEST_F(StillReducerTest, ReducedPicturesMatchTheOracle) {
    for (const auto& [from, to] : {std::pair(Size{100, 70}, Size{43, 31}),
                                   {Size{37, 41}, Size{36, 11}},
                                   {Size{9, 1}, Size{2, 1}},
                                   {Size{16, 12}, Size{1, 1}}}) {
        const TestPicture picture = randomPicture(from, 5);
        StillReducer reducer(from, to);
        reducer.run(uploaded(picture));
        ASSERT_EQ(reducer.picture().size(), to);
        const std::vector<double> wanted = twinOf(picture, to);
        const auto rgba = reducer.picture().readRgba8();
        for (std::size_t i = 0; i < wanted.size(); ++i)
            ASSERT_NEAR(rgba[4 * i], wanted[i], 1.01) << to.width << "x" << to.height << ": " << i;
    }
}

TEST_F(StillReducerTest, StillsAreReducedOnlyForAMuchSmallerOutput) {
    const StereoRig rig = plainRig({50, 35}, {200, 140});
    EXPECT_EQ(stillFor({200, 140}, rig).still.size, (Size{200, 140}));
    EXPECT_EQ(stillFor({400, 280}, rig).still.size, (Size{200, 140}));
    EXPECT_EQ(stillFor({150, 105}, rig).still.size, (Size{200, 140}));
    gpu::PictureTexture picture(gpu::Filter::Linear);
    const StillReference half(rig, {100, 70}, picture);
    EXPECT_EQ(half.rig().still.size, (Size{140, 98}));
    EXPECT_DOUBLE_EQ(half.rig().still.fx, rig.still.fx * 0.7);
    EXPECT_EQ(half.raised().size(), (Size{140, 98}));
}

std::vector<std::uint8_t> halved(const std::vector<std::uint8_t>& rgba, Size size) {
    std::vector<std::uint8_t> out;
    for (int y = 0; y + 1 < size.height; y += 2)
        for (int x = 0; x + 1 < size.width; x += 2)
            for (int c = 0; c < 4; ++c) {
                const auto at = [&](int dx, int dy) {
                    return int{rgba[((y + dy) * size.width + x + dx) * 4UL + c]};
                };
                const int sum = at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1);
                out.push_back(static_cast<std::uint8_t>((sum + 2) / 4));
            }
    return out;
}

TEST_F(StillReducerTest, ASmallOutputIsAsGoodAsAReducedLargeOutput) {
    const PipelineCase c;
    const Eigen::Vector2d shift{2.3, -1.4};
    Pipeline large(c.rig, {});
    const Size full = large.outputSize(), half{full.width / 2, full.height / 2};
    Pipeline small(c.rig, {.output = half});
    for (Pipeline* p : {&large, &small}) {
        p->setStill(c.still().view(), {});
        p->run(c.video(shift).view(), {});
    }
    const auto truth = c.fine(half, shift).bytes;
    EXPECT_EQ(small.outputSize(), half);
    EXPECT_GT(psnr(small.readImage(), truth), psnr(halved(large.readImage(), full), truth) - 0.2);
    // The flows differ, because their last correction reads the still, which is reduced for the
    // small output.
    const std::vector<float> flow = small.readFlow(), other = large.readFlow();
    ASSERT_EQ(flow.size(), other.size());
    for (std::size_t i = 0; i < flow.size(); ++i)
        ASSERT_NEAR(flow[i], other[i], 0.1) << i;
}

}  // namespace
}  // namespace mfar
