#include "base/gl/pass.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/pictures.h"
#include "tests/oracle/superres.h"

#include <set>

namespace mfar {
namespace {

using Weigh = GlTest;
using Classify = GlTest;

constexpr Size kWhole{25, 15};
constexpr Size kHalf{13, 8};
constexpr double kSigma = 1.5;

twin::Cells randomStatistics(Size size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    twin::Cells out{size, {}};
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const float level = std::pow(10.0F, 1 + 4.0F * static_cast<float>(x) / size.width);
            const float a = level * (0.5F + unit(random)), b = level * (0.3F + unit(random));
            const float alike = 0.2F + 0.8F * static_cast<float>(y) / size.height;
            const float values[]{alike * std::sqrt(a * b), a, b, std::sqrt(unit(random))};
            out.values.insert(out.values.end(), values, values + 4);
        }
    return out;
}

struct Weighed {
    twin::Cells field, look;
    std::vector<std::uint8_t> weights;
};

Weighed weigh(const twin::Cells& displacement, const twin::Cells& statistics,
              const twin::Cells& half, double sigma) {
    using gpu::TexelFormat;
    const gpu::Texture d = floatTexture(kWhole, TexelFormat::Rgba32F, displacement.values);
    const gpu::Texture s = floatTexture(kWhole, TexelFormat::Rgba32F, statistics.values);
    const gpu::Texture h = floatTexture(kHalf, TexelFormat::Rgba32F, half.values);
    const gpu::Texture field(kWhole, TexelFormat::Rgba32F), weights(kWhole, TexelFormat::Rgba8);
    const gpu::Texture look(kWhole, TexelFormat::Rgba16F);
    gpu::ComputePass<params::WeighCells> pass("superres_weigh.comp");
    pass.run({.columns = kWhole.width,
              .rows = kWhole.height,
              .halfColumns = kHalf.width,
              .halfRows = kHalf.height,
              .noise = static_cast<float>(sigma)},
             {gpu::sampler(0, d), gpu::sampler(1, s), gpu::sampler(2, h), gpu::imageWrite(0, field),
              gpu::imageWrite(1, weights), gpu::imageWrite(2, look)},
             {gpu::groupsFor(kWhole.width, 8), gpu::groupsFor(kWhole.height, 8), 1});
    return {{kWhole, field.readRgba32F()}, {kWhole, look.readRgba32F()}, weights.readRgba8()};
}

TEST_F(Weigh, WeightsMatchTheOracle) {
    // The flow's x component is nearly uniform on the left and changes more and more to the right.
    // The y component jumps from row to row, by 0.3 px in the upper half and 0.9 px in the lower.
    twin::Cells displacement{kWhole, {}};
    for (int y = 0; y < kWhole.height; ++y)
        for (int x = 0; x < kWhole.width; ++x)
            for (const float v : {0.012F * static_cast<float>(x * x),
                                  (2 * y > kWhole.height ? 0.9F : 0.3F) * static_cast<float>(y % 2),
                                  10.0F + static_cast<float>(x), 20.0F})
                displacement.values.push_back(v);
    const twin::Cells statistics = randomStatistics(kWhole, 1), half = randomStatistics(kHalf, 2);
    const Weighed got = weigh(displacement, statistics, half, kSigma);
    int zero = 0, strong = 0, unexplained = 0;
    for (int y = 0; y < kWhole.height; ++y)
        for (int x = 0; x < kWhole.width; ++x) {
            const twin::Weight t = twin::weigh(displacement, statistics, half, x, y, kSigma);
            const Eigen::Vector4d f = got.field.at(x, y), d = displacement.at(x, y);
            EXPECT_NEAR(f[2], t.weight, 1e-3 * t.weight + 1e-6) << x << ", " << y;
            EXPECT_NEAR(f[3], t.confidence, 1e-6);
            EXPECT_EQ(f.head<2>(), d.head<2>());
            const Eigen::Vector4d l = got.look.at(x, y);  // the look-up is stored in half precision
            EXPECT_NEAR(l[0], std::min(d[2], 65504.0), 1e-3 * d[2]);
            EXPECT_NEAR(l[2], t.weight, 1e-3 * t.weight + 1e-4);
            const std::uint8_t* w = &got.weights[4UL * (1UL * y * kWhole.width + x)];
            EXPECT_NEAR(w[0], std::min(127.5 * t.weight, 255.0), 1);
            EXPECT_NEAR(w[1], 255 * t.confidence, 1);
            EXPECT_NEAR(w[2], 255 * t.signal, 1);
            EXPECT_EQ(w[3], 255 * t.unexplained) << x << ", " << y;
            zero += t.weight == 0 ? 1 : 0;
            strong += t.weight > 0.3 ? 1 : 0;
            unexplained += t.unexplained > 0 ? 1 : 0;
        }
    EXPECT_GT(zero, 10);
    EXPECT_GT(strong, 10);
    EXPECT_GT(unexplained, 10);
}

twin::Cells constantCells(Size size, std::array<float, 4> value) {
    twin::Cells out{size, {}};
    for (int i = 0; i < size.width * size.height; ++i)
        out.values.insert(out.values.end(), value.begin(), value.end());
    return out;
}

// The squared correlation of video and still is a half. Changing flow then has about a quarter of
// the weight of uniform flow.
TEST_F(Weigh, ChangingFlowLowersTheWeightOfAnImperfectMatch) {
    const twin::Cells half = constantCells(kHalf, {0, 0, 0, 0});
    const twin::Cells matched = constantCells(kWhole, {7.07e4F, 1e5F, 1e5F, 1});
    twin::Cells bent{kWhole, {}};
    for (int i = 0; i < kWhole.width * kWhole.height; ++i)
        for (const float v : {0.5F * static_cast<float>(i % kWhole.width), 0.0F, 0.0F, 0.0F})
            bent.values.push_back(v);
    const double even = weigh(matched, matched, half, 0.3).field.at(5, 5)[2];
    EXPECT_LT(weigh(bent, matched, half, 0.3).field.at(5, 5)[2], 0.4 * even);
}

// Look-ups are wrong between two cells whose flow differs abruptly. Rotations and zooms change the
// flow smoothly and keep their weight.
TEST_F(Weigh, DiscontinuousFlowHasNoWeight) {
    const twin::Cells half = constantCells(kHalf, {1e5F, 1e5F, 1e5F, 0});
    const twin::Cells alike = constantCells(kWhole, {1e5F, 1e5F, 1e5F, 1});
    const auto weightsWithJump = [&](float jump) {
        twin::Cells flow{kWhole, {}};
        for (int i = 0; i < kWhole.width * kWhole.height; ++i) {
            const int x = i % kWhole.width, y = i / kWhole.width;
            for (const float v :
                 {(x > 5 ? jump : 0.0F) + 0.2F * static_cast<float>(x + y), 0.0F, 0.0F, 0.0F})
                flow.values.push_back(v);
        }
        return weigh(flow, alike, half, 0.3).field;
    };
    const twin::Cells even = weightsWithJump(0), torn = weightsWithJump(params::kTornStep + 1);
    for (const int x : {5, 6})
        EXPECT_EQ(torn.at(x, 5)[2], 0);
    for (const int x : {4, 7})
        EXPECT_NEAR(torn.at(x, 5)[2], even.at(x, 5)[2], 1e-4);
    EXPECT_GT(even.at(5, 5)[2], 0.9);
}

TEST_F(Weigh, EqualTextureHasFullWeightAndUnrelatedTextureNone) {
    const twin::Cells half = constantCells(kHalf, {1e5F, 1e5F, 1e5F, 0});
    const twin::Cells alike = constantCells(kWhole, {1e5F, 1e5F, 1e5F, 1});
    for (const float v : {weigh(alike, alike, half, 0.3).field.at(5, 5)[2]})
        EXPECT_NEAR(v, params::kLookUpLoss, 0.01);
    for (const std::array<float, 4>& s :
         {std::array<float, 4>{0, 1e5F, 1e5F, 1}, std::array<float, 4>{-1e5F, 1e5F, 1e5F, 1},
          std::array<float, 4>{1e5F, 1e5F, 1e5F, 0}, std::array<float, 4>{0, 0, 0, 1}})
        EXPECT_EQ(weigh(alike, constantCells(kWhole, s), half, 0.3).field.at(5, 5)[2], 0);
}

constexpr Size kClassified{7, 4};
constexpr unsigned kTileCount = 28;

struct Draws {
    std::array<std::array<std::uint32_t, 4>, 5> commands{};
    std::array<std::uint32_t, 8> counts{};
};
struct Classified {
    Draws draws;
    std::vector<std::array<std::uint32_t, 2>> classes;
    std::vector<std::uint32_t> lists;
};

Classified classify(const twin::Cells& field, const std::vector<std::uint32_t>& changed,
                    bool hasStill, std::uint32_t detailFrame = 1) {
    const gpu::Texture cells = floatTexture(kWhole, gpu::TexelFormat::Rgba32F, field.values);
    const gpu::Texture weights = uploaded(TestPicture(kWhole));
    gpu::Buffer changedBuffer(changed.size() * 4), classes(8 * kTileCount);
    gpu::Buffer draws(sizeof(Draws)), lists(24 * kTileCount);
    changedBuffer.write(std::span(changed));
    gpu::ComputePass<params::ClassifyTiles> pass("superres_classify.comp");
    pass.run({.columns = kClassified.width,
              .rows = kClassified.height,
              .cellColumns = kWhole.width,
              .cellRows = kWhole.height,
              .leastWeight = params::kLeastDetailWeight,
              .plainFlow = params::kPlainFlow,
              .stillGiven = hasStill ? 1 : 0,
              .detailFrame = detailFrame,
              .learns = 0,
              .secondGiven = 0},
             {gpu::storage(0, changedBuffer), gpu::storage(1, classes), gpu::storage(2, draws),
              gpu::storage(3, lists), gpu::sampler(0, cells), gpu::sampler(1, weights)},
             {1, 1, 1});
    return {draws.read<Draws>(1)[0], classes.read<std::array<std::uint32_t, 2>>(kTileCount),
            lists.read<std::uint32_t>(4UL * kTileCount)};
}

twin::Cells mixedField() {
    twin::Cells out{kWhole, {}};
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int y = 0; y < kWhole.height; ++y)
        for (int x = 0; x < kWhole.width; ++x) {
            const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
            const float bump = y > 10 ? unit(random) : 0.0F;
            const float weight = x < 9 ? 0.01F : x > 20 ? 0.4F + 0.6F * unit(random) : 0.8F;
            const float values[]{2 + 0.3F * fx - 0.1F * fy + bump, 0.2F * fy, weight, 0.5F};
            out.values.insert(out.values.end(), values, values + 4);
        }
    return out;
}

/// Content of the buffer of tile flags: `whole`, an entry that the shader does not read, then the
/// flags `changed` and `matched` of each tile. Every third tile is unchanged; every fifth is not
/// matched.
std::vector<std::uint32_t> changes(std::uint32_t whole) {
    std::vector<std::uint32_t> out{whole, 0};
    for (unsigned i = 0; i < kTileCount; ++i)
        out.insert(out.end(), {i % 3 == 0 ? 0U : 1U, i % 5 == 0 ? 0U : 1U});
    return out;
}

unsigned classIn(const twin::Cells& field, int tile) {
    if (tile % 5 == 0) return 1;
    return twin::tileClass(field, tile % kClassified.width, tile / kClassified.width);
}

std::set<std::uint32_t> withNeighbours(const std::set<std::uint32_t>& tiles) {
    std::set<std::uint32_t> out;
    for (const std::uint32_t tile : tiles)
        for (int i = 0; i < 9; ++i) {
            const int x = static_cast<int>(tile & 0xFFFFU) + i % 3 - 1,
                      y = static_cast<int>(tile >> 16) + i / 3 - 1;
            if (x >= 0 && y >= 0 && x < kClassified.width && y < kClassified.height)
                out.insert(static_cast<std::uint32_t>(x | (y << 16)));
        }
    return out;
}

void expectLists(const Classified& got, const std::array<std::set<std::uint32_t>, 4>& wanted) {
    for (unsigned k = 0; k < wanted.size(); ++k) {
        const auto* list = &got.lists[k * kTileCount];
        EXPECT_EQ(got.draws.commands[k][1], wanted[k].size()) << "list " << k;
        EXPECT_EQ(std::set<std::uint32_t>(list, list + wanted[k].size()), wanted[k]);
    }
}

TEST_F(Classify, ClassesOfTilesTheirCountsAndTheirListsMatchTheOracle) {
    const twin::Cells field = mixedField();
    // Tiles that the four lists must contain: changed, only enlarged, trusted, blended.
    std::array<std::set<std::uint32_t>, 4> wanted;
    std::array<unsigned, 4> counts{};
    for (int i = 0; i < static_cast<int>(kTileCount); ++i) {
        const int x = i % kClassified.width, y = i / kClassified.width;
        const unsigned kind = i % 3 == 0 ? 0 : classIn(field, i);
        ++counts[kind];
        const auto packed = static_cast<std::uint32_t>(x | (y << 16));
        if (kind != 0) {
            wanted[0].insert(packed);
            wanted[kind].insert(packed);
        }
    }
    const auto changed = wanted[0];
    std::set<std::uint32_t> detailed = wanted[2];
    detailed.insert(wanted[3].begin(), wanted[3].end());
    const auto around = withNeighbours(detailed);
    wanted[0].insert(around.begin(), around.end());
    EXPECT_GT(wanted[0].size(), changed.size());
    EXPECT_LT(wanted[0].size(), kTileCount) << "the test needs tiles that are far from all detail";

    const Classified got = classify(field, changes(0), true);
    expectLists(got, wanted);
    for (unsigned i = 0; i < kTileCount; ++i)
        EXPECT_EQ(got.classes[i][0], i % 3 == 0 ? 0 : classIn(field, static_cast<int>(i)));
    for (unsigned k = 0; k < 4; ++k) {
        EXPECT_GT(counts[k], 0U) << "the test needs tiles of every class";
        EXPECT_EQ(got.draws.counts[k], counts[k]);
    }
    EXPECT_EQ(got.draws.counts[6],
              kTileCount * 128);  // each tile has a mean confidence of 128 / 256

    wanted[0] = changed;
    expectLists(classify(field, changes(0), true, 0), wanted);
}

TEST_F(Classify, IfTheWholeFrameIsDrawnNoTilesAreListed) {
    const Classified got = classify(mixedField(), changes(1), true);
    EXPECT_EQ(got.draws.counts[0], 0U);
    for (const auto& command : got.draws.commands)
        EXPECT_EQ(command[1], 0U);
}

TEST_F(Classify, TilesWithDetailAreListedIfTheWholeFrameIsEnlarged) {
    const twin::Cells field = mixedField();
    std::array<std::set<std::uint32_t>, 4> wanted;
    for (int i = 0; i < static_cast<int>(kTileCount); ++i) {
        const unsigned kind = classIn(field, i);
        const int x = i % kClassified.width, y = i / kClassified.width;
        if (kind < 2) continue;
        wanted[kind].insert(static_cast<std::uint32_t>(x | (y << 16)));
    }
    const Classified got = classify(field, changes(2), true);
    expectLists(got, wanted);
    for (const unsigned k : {2U, 3U}) {
        EXPECT_GT(wanted[k].size(), 0U);
        EXPECT_EQ(got.draws.counts[k], wanted[k].size());
    }
}

TEST_F(Classify, AllChangedTilesAreEnlargedAndCountAsUnmatchedIfThereIsNoStill) {
    const Classified got = classify(mixedField(), changes(0), false);
    EXPECT_EQ(got.draws.counts[0], 10U);
    EXPECT_EQ(got.draws.counts[1], 18U);
    EXPECT_EQ(got.draws.counts[5], 18U);
    EXPECT_EQ(got.draws.counts[6], 0U);
}

}  // namespace
}  // namespace mfar
