#include "pipeline/engine/params/weigh.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/gles/levels.h"
#include "tests/oracle/patch.h"
#include "tests/oracle/superres.h"

namespace mfar {
namespace {

using Assess = GlTest;
using Eigen::Vector2d;

constexpr Size kVideo{61, 45};
constexpr Size kStill{220, 163};
constexpr Size kGrid{16, 12};
constexpr int kGridArea = 16 * 12;
constexpr double kAlpha = params::kTwoWayAlpha;
// Tolerances for sums of 64 products of up to 255^2 in single precision.
constexpr double kRelative = 1e-3, kAbsolute = 2;
constexpr double kPixel = 0.01;  // tolerance of unprojection in single precision [still px]

/// Flow vectors in both directions, row by row. A pixel of the backward flow is `scale` video
/// pixels wide.
struct Fields {
    std::vector<std::array<float, 4>> forward, backward;
    int scale = 1;

    [[nodiscard]] Size backwardCells() const { return {kGrid.width / scale, kGrid.height / scale}; }
};

Fields constantFields(const Vector2d& forward, const Vector2d& backward) {
    const auto four = [](const Vector2d& v) {
        return std::array<float, 4>{static_cast<float>(v.x()), static_cast<float>(v.y()), 0, 0};
    };
    return {{kGridArea, four(forward)}, {kGridArea, four(backward)}};
}

struct Assessed {
    twin::Cells displacement, statistics;
};

Assessed assess(const LevelPair& pair, const StereoRig& rig, const Fields& fields) {
    gpu::Buffer cells(2 * kGridArea * 16);
    cells.write(std::span(fields.forward));
    cells.write(std::span(fields.backward), kGridArea * 16);
    const gpu::Texture displacement(kGrid, gpu::TexelFormat::Rgba32F);
    const gpu::Texture statistics(kGrid, gpu::TexelFormat::Rgba32F);
    gpu::ComputePass<params::AssessCells> pass("superres_assess.comp");
    pass.run({.rig = rigParams(rig),
              .video = pair.pyramids.video()[0],
              .still = pair.pyramids.still()[0],
              .columns = kGrid.width,
              .rows = kGrid.height,
              .backwardColumns = fields.backwardCells().width,
              .backwardRows = fields.backwardCells().height,
              .forward = 0,
              .backward = kGridArea,
              .errorsGiven = 0,
              .backwardScale = fields.scale,
              .stillWidth = static_cast<float>(rig.still.size.width),
              .stillHeight = static_cast<float>(rig.still.size.height),
              .scaleX = static_cast<float>(rig.still.fx / rig.video.fx),
              .scaleY = static_cast<float>(rig.still.fy / rig.video.fy)},
             {gpu::storage(0, pair.pyramids.words()), gpu::storage(1, cells),
              gpu::storage(2, pair.tiles.buffer()), gpu::imageWrite(0, displacement),
              gpu::imageWrite(1, statistics)},
             {4, 3, 1});
    return {{kGrid, displacement.readRgba32F()}, {kGrid, statistics.readRgba32F()}};
}

bool insideOf(const Vector2d& p, Size size) {
    return p.x() >= 0 && p.y() >= 0 && p.x() <= size.width - 1 && p.y() <= size.height - 1;
}

Fields randomFields(int scale) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> near(-0.8F, 0.8F), wide(-12, 12);
    Fields f = constantFields({0, 0}, {0, 0});
    f.scale = scale;
    const auto coarse = static_cast<float>(scale);
    for (int i = 0; i < kGridArea; ++i) {
        const float x = wide(random), y = wide(random);
        f.forward[i] = {x, y, 0, 0};
        f.backward[i] = {(near(random) - 3) / coarse, (near(random) + 2) / coarse, 0, 0};
        if (i % 2 == 0) f.forward[i] = {3 + near(random), near(random) - 2, 0, 0};
    }
    return f;
}

twin::Cells cellsOf(const std::vector<std::array<float, 4>>& field, Size cells) {
    twin::Cells out{cells, {}};
    for (const auto& v : field)
        out.values.insert(out.values.end(), v.begin(), v.end());
    return out;
}

class AssessFields : public GlTest, public testing::WithParamInterface<int> {};

TEST_P(AssessFields, StatisticsLookUpsAndConfidenceOfFlowMatchTheOracle) {
    const StereoRig rig = bentRig(kVideo, kStill);
    const Waves waves(1, 6, 60, 40);
    const LevelPair pair(waves.shoot(kVideo, {}), waves.shoot(kVideo, {.shift = {-3, 2}}));
    const auto a = pair.first(), b = pair.second();
    const Fields fields = randomFields(GetParam());
    const twin::Cells backward = cellsOf(fields.backward, fields.backwardCells());
    const double cell = 4. * fields.scale;
    const Assessed got = assess(pair, rig, fields);
    const Eigen::Array2d scale(rig.still.fx / rig.video.fx, rig.still.fy / rig.video.fy);
    int outside = 0, confident = 0;
    for (int i = 0; i < kGridArea; ++i) {
        const int x = i % 16, y = i / 16;
        const Vector2d u(fields.forward[i][0], fields.forward[i][1]);
        const Vector2d centre(4 * x + 1.5, 4 * y + 1.5), q = centre + u;
        const auto m = twin::comparePatch(a, b, x, y, u);
        const Eigen::Vector4d s = got.statistics.at(x, y), d = got.displacement.at(x, y);
        EXPECT_NEAR(s[0], m.covariance, kAbsolute + kRelative * std::abs(m.covariance));
        EXPECT_NEAR(s[1], m.varianceA, kAbsolute + kRelative * m.varianceA);
        EXPECT_NEAR(s[2], m.varianceB, kAbsolute + kRelative * m.varianceB);
        EXPECT_LE((d.head<2>() - u).norm(), 1e-6);
        const Vector2d inStill = twin::stillPixel(rig, q);
        const Vector2d scaled = scale * (centre.array() + 0.5) - 0.5;
        EXPECT_LE((d.tail<2>() - (inStill - scaled)).norm(), kPixel) << "cell " << i;
        const bool inside = insideOf(q, kVideo) && insideOf(inStill, kStill);
        const Vector2d back =
            fields.scale *
            backward.bilinear((q.x() + 0.5) / cell - 0.5, (q.y() + 0.5) / cell - 0.5).head<2>();
        EXPECT_NEAR(s[3], inside ? twin::confidence(u, back, kAlpha) : 0.0, 1e-4) << "cell " << i;
        outside += inside ? 0 : 1;
        confident += s[3] > 0.5 ? 1 : 0;
    }
    EXPECT_GT(outside, 10);
    EXPECT_GT(confident, 10);
}

INSTANTIATE_TEST_SUITE_P(BackwardScales, AssessFields, testing::Values(1, 2));

TEST_F(Assess, IfForwardAndBackwardFlowAgreeConfidenceIsOne) {
    const StereoRig rig = plainRig(kVideo, kStill);
    const TestPicture p = randomPicture(kVideo, 1);
    const Assessed got = assess(LevelPair(p, p), rig, constantFields({2, 1}, {-2, -1}));
    for (int i = 0; i < kGridArea; ++i) {
        const int column = i % 16, row = i / 16;
        const Vector2d q(4 * column + 3.5, 4 * row + 2.5);
        EXPECT_EQ(got.statistics.at(i % 16, i / 16)[3], insideOf(q, kVideo) ? 1 : 0) << i;
    }
}

TEST_F(Assess, IfForwardAndBackwardFlowDisagreeOrLeaveThePictureConfidenceIsZero) {
    const StereoRig rig = plainRig(kVideo, kStill);
    const TestPicture p = randomPicture(kVideo, 1);
    const LevelPair pair(p, p);
    for (const Fields& f : {constantFields({0, 0}, {kAlpha, 0}), constantFields({99, 0}, {-99, 0}),
                            constantFields({0, -1e6}, {0, 1e6})}) {
        const Assessed got = assess(pair, rig, f);
        for (int i = 0; i < kGridArea; ++i)
            EXPECT_EQ(got.statistics.at(i % 16, i / 16)[3], 0) << "cell " << i;
    }
}

TEST_F(Assess, GainStatisticsMatchTheOracle) {
    const Size size{122, 90}, half{61, 45}, forward{31, 23}, cells{16, 12};
    const Waves waves(2, 8, 80, 40);
    const LevelPair pair(waves.shoot(size, {}), waves.shoot(size, {.gain = 0.7}));
    const auto a = pair.first(1), b = pair.second(1);
    std::mt19937 random(4);
    std::uniform_real_distribution<float> flow(-8, 8);
    twin::Cells field{forward, std::vector<float>(4UL * forward.width * forward.height)};
    for (float& v : field.values)
        v = flow(random);
    gpu::Buffer flows(field.values.size() * 4);
    flows.write(std::span<const float>(field.values));
    const gpu::Texture out(cells, gpu::TexelFormat::Rgba32F);
    gpu::ComputePass<params::MeasureGain> pass("superres_gain.comp");
    pass.run({.video = pair.pyramids.video()[1],
              .still = pair.pyramids.still()[1],
              .columns = cells.width,
              .rows = cells.height,
              .forwardColumns = forward.width,
              .forwardRows = forward.height,
              .forward = 0,
              .tileColumns = pair.tiles.work().tiles.width},
             {gpu::storage(0, pair.pyramids.words()), gpu::storage(1, flows),
              gpu::storage(2, pair.tiles.buffer()), gpu::imageWrite(0, out)},
             {4, 3, 1});
    ASSERT_EQ(a.size, half);
    const twin::Cells got{cells, out.readRgba32F()};
    for (int y = 0; y < cells.height; ++y)
        for (int x = 0; x < cells.width; ++x) {
            const Eigen::Vector4d sum = field.at(2 * x, 2 * y) + field.at(2 * x + 1, 2 * y) +
                                        field.at(2 * x, 2 * y + 1) + field.at(2 * x + 1, 2 * y + 1);
            const auto m = twin::comparePatch(a, b, x, y, sum.head<2>() / 8);
            const Eigen::Vector4d s = got.at(x, y);
            EXPECT_NEAR(s[0], m.covariance, kAbsolute + kRelative * std::abs(m.covariance));
            EXPECT_NEAR(s[1], m.varianceA, kAbsolute + kRelative * m.varianceA);
            EXPECT_NEAR(s[2], m.varianceB, kAbsolute + kRelative * m.varianceB);
        }
}

}  // namespace
}  // namespace mfar
