#include "base/gl/pass.h"
#include "base/gl/validation.h"
#include "gles_shaders/shaders.h"
#include "pipeline/engine/params/flow.h"
#include "pipeline/engine/params/weigh.h"
#include "tests/engine/pictures.h"
#include "tests/stability/gl_watch.h"
#include "tests/stability/watched_shaders.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

namespace mfar::stress {
namespace {

constexpr Size kCells{5, 3};

/// Runs superres_weigh.comp, which copies x and y of `displacement` to the output cellField, and
/// z and w to the output lookupField.
void weigh(const std::vector<float>& displacement) {
    using gpu::TexelFormat;
    const std::vector<float> zeros(4UL * 15);
    const gpu::Texture d = floatTexture(kCells, TexelFormat::Rgba32F, displacement);
    const gpu::Texture s = floatTexture(kCells, TexelFormat::Rgba32F, zeros);
    const gpu::Texture field(kCells, TexelFormat::Rgba32F), weights(kCells, TexelFormat::Rgba8);
    const gpu::Texture look(kCells, TexelFormat::Rgba16F);
    gpu::ComputePass<params::WeighCells> pass("superres_weigh.comp");
    pass.run({.columns = kCells.width,
              .rows = kCells.height,
              .halfColumns = kCells.width,
              .halfRows = kCells.height,
              .noise = 1},
             {gpu::sampler(0, d), gpu::sampler(1, s), gpu::sampler(2, s), gpu::imageWrite(0, field),
              gpu::imageWrite(1, weights), gpu::imageWrite(2, look)},
             {1, 1, 1});
}

std::vector<float> withValue(std::size_t at, float value) {
    std::vector<float> out(4UL * 15, 1.0F);
    out[at] = value;
    return out;
}

class ValidationTest : public testing::Test {
protected:
    static std::unique_ptr<GlContext> context() { return createGlContext(); }
};

TEST_F(ValidationTest, ValidOutputsHaveNoFaults) {
    const auto gl = context();
    gpu::Validation validation;
    weigh(withValue(0, 3));
    EXPECT_TRUE(validation.takeFaults().empty());
    EXPECT_EQ(validation.counts().at("superres_weigh.comp").runs, 1);
}

TEST_F(ValidationTest, NanIsReportedWithPassOutputAndTexel) {
    const auto gl = context();
    gpu::Validation validation;
    validation.nextFrame();
    weigh(withValue(4 * 7 + 1, std::nanf("")));  // texel (2, 1), component 1
    const auto faults = validation.takeFaults();
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].pass, "superres_weigh.comp");
    EXPECT_EQ(faults[0].output, "cellField");
    EXPECT_EQ(faults[0].x, 2);
    EXPECT_EQ(faults[0].y, 1);
    EXPECT_EQ(faults[0].component, 1);
    EXPECT_EQ(faults[0].frame, 1);
    EXPECT_NE(describe(faults[0]).find("superres_weigh.comp wrote cellField(2, 1)[1] = nan"),
              std::string::npos)
        << describe(faults[0]);
}

TEST_F(ValidationTest, ValuesOutOfTheStatedRangeAreFaults) {
    const auto gl = context();
    gpu::Validation validation;
    for (const float value : {2.5e4F, -2.5e4F, std::numeric_limits<float>::infinity()}) {
        weigh(withValue(0, value));
        const auto faults = validation.takeFaults();
        ASSERT_EQ(faults.size(), 1U) << value;
        EXPECT_EQ(faults[0].range.high, 2e4);
    }
}

// Parameters for a picture of 16x8 pixels with eight words per row.
constexpr params::LumaFromVideo kLuma{.target = {0, 8, 16, 8}, .smoothing = 0.25F};
constexpr std::size_t kLumaBytes = std::size_t{4} * 8 * 8;

TEST_F(ValidationTest, WritesBehindABufferAreFaults) {
    const auto gl = context();
    gpu::Validation validation;
    const gpu::Texture picture = uploaded(TestPicture({16, 8}));
    const gpu::Buffer words(kLumaBytes);
    gpu::ComputePass<params::LumaFromVideo> pass("luma_from_video.comp");
    const auto run = [&] {
        pass.run(kLuma, {gpu::sampler(0, picture), gpu::storage(0, words)}, {});
        return validation.takeFaults();
    };
    EXPECT_TRUE(run().empty());
    const std::array<std::uint8_t, 4> stray{1, 2, 3, 4};
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, words.id());
    glBufferSubData(GL_SHADER_STORAGE_BUFFER, kLumaBytes, 4, stray.data());
    const auto faults = run();
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].output, "guard");
}

// The passes of the flow share one buffer, and the values of each pass have their own range. So a
// pass must not be judged by values that another pass wrote.
TEST_F(ValidationTest, OnlyValuesThatAPassWroteIntoABufferAreChecked) {
    const auto gl = context();
    gpu::Validation validation;
    constexpr int kTarget = 16;  // the source comes before it, values of another pass behind it
    std::vector<std::array<float, 4>> cells(3UL * kTarget);
    cells.back()[2] = 1e5F;  // no cost of flow_filter.comp is larger than 2.02
    gpu::Buffer buffer(16 * cells.size());
    const gpu::Buffer tiles(16);
    gpu::ComputePass<params::FilterFlow> pass("flow_filter.comp");
    const auto run = [&] {
        buffer.write(std::span<const std::array<float, 4>>(cells));
        pass.run(
            {.columns = 4, .rows = 4, .target = kTarget, .source = 0, .planeFits = 1, .byTile = 0},
            {gpu::storage(1, buffer), gpu::storage(2, tiles)}, {1, 1, 1});
        return validation.takeFaults();
    };
    EXPECT_TRUE(run().empty());
    cells[5][2] = 3;
    const auto faults = run();
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].x, kTarget + 5);
    EXPECT_EQ(faults[0].value, 3);
}

TEST_F(ValidationTest, PassesAreNotCheckedOnceTheValidationIsDestroyed) {
    const auto gl = context();
    {
        const gpu::Validation validation;
    }
    EXPECT_EQ(gpu::Validation::active(), nullptr);
    weigh(withValue(0, std::nanf("")));
    EXPECT_NO_THROW(gpu::checkErrors("after validation"));
}

TEST(WatchedShaders, AnIndexOutOfRangeIsCounted) {
    GlWatch gl;
    Checks checks;
    const gpu::Texture picture = uploaded(TestPicture({16, 8}));
    const gpu::Buffer words(kLumaBytes - 8);
    gpu::ComputePass<params::LumaFromVideo> pass("luma_from_video.comp");
    pass.run(kLuma, {gpu::sampler(0, picture), gpu::storage(0, words)}, {});
    gl.frame(checks, 128);
    const auto faults = checks.take();
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0], "luma_from_video.comp: 2 indices out of range");
}

TEST(WatchedShaders, ShadersContainTheTextsOfPlantedFaults) {
    ASSERT_FALSE(plantedFaults().empty());
    for (const PlantedFault& fault : plantedFaults())
        EXPECT_NO_THROW(requirePlantable(fault)) << fault.shader << ": " << fault.from;
}

TEST(StatedRanges, RangesAreReadFromTheShadersText) {
    const auto ranges =
        gpu::statedRanges("// a\n// Range: out -1.5..2, 0..1e6\nvoid main\n", "out");
    ASSERT_EQ(ranges.size(), 2U);
    EXPECT_EQ(ranges[0].low, -1.5);
    EXPECT_EQ(ranges[0].high, 2);
    EXPECT_EQ(ranges[1].low, 0);
    EXPECT_EQ(ranges[1].high, 1e6);
    EXPECT_TRUE(gpu::statedRanges("// Range: other 0..1\n", "out").empty());
}

// Every image of 32-bit or 16-bit floats that a shader writes must have a stated range.
TEST(StatedRanges, EveryFloatImageHasARange) {
    for (const shaders::Source& shader : shaders::all()) {
        const std::string text(shader.text);
        for (const std::string kind : {"(rgba32f, ", "(rgba16f, ", "(r32f, "})
            for (auto at = text.find(kind); at != std::string::npos; at = text.find(kind, at + 1)) {
                const auto end = text.find(';', at), name = text.rfind(' ', end) + 1;
                EXPECT_FALSE(gpu::statedRanges(text, text.substr(name, end - name)).empty())
                    << shader.name << ": " << text.substr(name, end - name);
            }
    }
}

}  // namespace
}  // namespace mfar::stress
