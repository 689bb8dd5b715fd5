#include "base/gl/texture.h"
#include "pipeline/gles/texture_layer.h"
#include "tests/engine/gl_test.h"

#include <cstring>
#include <random>
#include <span>
#include <vector>

namespace mfar {
namespace {

using gpu::TexelFormat;
using GlTexture = GlTest;

GLint bound(GLenum binding) {
    GLint out = -1;
    glGetIntegerv(binding, &out);
    return out;
}

// GL unbinds a texture or framebuffer when it is deleted.
TEST_F(GlTexture, ARefusedTextureIsDeleted) {
    constexpr int kTooManyLevels = 9;
    EXPECT_THROW(gpu::Texture({8, 8}, TexelFormat::Rgba8, gpu::Filter::Nearest, kTooManyLevels),
                 gpu::GlError);
    EXPECT_EQ(bound(GL_TEXTURE_BINDING_2D), 0);
}

TEST_F(GlTexture, ARefusedFramebufferIsDeleted) {
    const gpu::Texture depth({8, 8}, TexelFormat::Depth24);
    EXPECT_THROW(gpu::Framebuffer{depth}, gpu::GlError);
    EXPECT_EQ(bound(GL_FRAMEBUFFER_BINDING), 0);
}

// Rows in CPU memory, wider than the picture, with random pixels of `bytes` bytes.
std::vector<std::uint8_t> randomRows(Size size, int bytes) {
    std::mt19937 random(1);
    std::vector<std::uint8_t> out(static_cast<std::size_t>(bytes) * (size.width + 3) * size.height);
    for (std::uint8_t& byte : out)
        byte = static_cast<std::uint8_t>(random() % 127);  // as a float: never NaN
    return out;
}

TEST_F(GlTexture, ACopyIsReadBackWithTheChannelsOfItsFormat) {
    constexpr Size kSize{21, 37};
    for (const auto& [format, bytes] : {std::pair{TexelFormat::R8, 1},
                                        {TexelFormat::Rg8, 2},
                                        {TexelFormat::Rgba8, 4},
                                        {TexelFormat::R32F, 4}}) {
        SCOPED_TRACE(bytes);
        const std::ptrdiff_t pitch = std::ptrdiff_t{bytes} * (kSize.width + 3);
        const std::vector<std::uint8_t> sent = randomRows(kSize, bytes);
        std::vector<std::uint8_t> read(sent.size(), 200);
        TextureCopy copy(kSize, format, gpu::Filter::Nearest);
        copy.upload(sent.data(), pitch);
        const std::size_t inPicture = static_cast<std::size_t>(bytes) * kSize.width;
        EXPECT_EQ(copy.download(read.data(), pitch), inPicture * kSize.height);
        for (int y = 0; y < kSize.height; ++y) {
            EXPECT_EQ(std::memcmp(&read[y * pitch], &sent[y * pitch], inPicture), 0) << "row " << y;
            EXPECT_EQ(read[y * pitch + inPicture], 200) << "row " << y;
        }
    }
}

// The textures of a layer that is 0 outside `box`.
struct BoxTextures {
    explicit BoxTextures(Size size)
        : colour(size, TexelFormat::Rgba8), depth(size, TexelFormat::R32F) {}
    void draw(const PixelRect& box, std::uint32_t value) {
        const auto [width, height] = colour.size();
        std::vector<std::uint32_t> colours(static_cast<std::size_t>(width) * height);
        for (int y = box.y0; y < box.y1; ++y)
            std::fill_n(&colours[y * width + box.x0], box.x1 - box.x0, value);
        const std::vector<float> depths(colours.begin(), colours.end());
        TextureCopy(colour).upload(colours.data(), 4L * width);
        TextureCopy(depth).upload(depths.data(), 4L * width);
    }
    gpu::Texture colour, depth;
};

TEST_F(GlTexture, OfALayerOnlyTheBoundsOfThisAndTheLastDownloadAreReadBack) {
    constexpr Size kSize{40, 30};
    Transfers transfers;
    TextureLayer layer(&transfers);
    BoxTextures textures(kSize);
    const auto drawAndRead = [&](const PixelRect& box, std::uint32_t value) {
        textures.draw(box, value);
        const LayerPicture& shown = layer.show(textures.colour, textures.depth, box);
        const Rows<const std::uint32_t> colour = shown.colour.host();
        const Rows<const float> depth = shown.depth.host();
        for (int y = 0; y < kSize.height; ++y)
            for (int x = 0; x < kSize.width; ++x) {
                const bool inside = x >= box.x0 && x < box.x1 && y >= box.y0 && y < box.y1;
                ASSERT_EQ(colour[y][x], inside ? value : 0) << x << ", " << y;
                ASSERT_EQ(depth[y][x], inside ? static_cast<float>(value) : 0) << x << ", " << y;
            }
    };
    drawAndRead({3, 5, 13, 9}, 7);
    EXPECT_EQ(transfers.downloadedBytes, 2 * 4 * 10 * 4U);
    drawAndRead({10, 8, 20, 10}, 9);
    EXPECT_EQ(transfers.downloadedBytes, 2 * 4 * (10 * 4 + 17 * 5U));

    // Was shown, but not read back: the next download has the bounds of the last one that was.
    textures.draw({30, 20, 40, 30}, 4);
    (void)layer.show(textures.colour, textures.depth, {30, 20, 40, 30});
    drawAndRead({12, 9, 14, 11}, 5);
    EXPECT_EQ(transfers.downloadedBytes, 2 * 4 * (10 * 4 + 17 * 5 + 10 * 3U));
}

}  // namespace
}  // namespace mfar
