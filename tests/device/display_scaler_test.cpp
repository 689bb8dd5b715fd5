#include "hal/device/display_scaler.h"
#include "hal/device/display_spec.h"
#include "tests/engine/gl_test.h"
#include "tests/oracle/area_mean.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

namespace mfar {
namespace {

using Colour = std::array<int, 3>;

class DisplayScaler : public GlTest {
protected:
    static gpu::Texture picture(Size size, const std::function<Colour(int, int)>& colour) {
        std::vector<std::uint8_t> pixels;
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                for (const int value : colour(x, y))
                    pixels.push_back(static_cast<std::uint8_t>(value));
                pixels.push_back(7);
            }
        gpu::Texture texture(size, gpu::TexelFormat::Rgba8);
        texture.upload({pixels.data(), static_cast<std::size_t>(size.width) * 4});
        return texture;
    }
    static std::vector<Colour> shown(const gpu::Texture& picture, Size screen) {
        ScreenScaler scaler;
        return shown(scaler, picture, screen);
    }
    static std::vector<Colour> shown(ScreenScaler& scaler, const gpu::Texture& picture,
                                     Size screen) {
        ScreenReader reader(screen, scaler);
        reader.begin(GlImage{picture.id(), picture.size()});
        std::vector<Colour> out;
        reader.finish([&](const ImageView& view) {
            EXPECT_EQ(view.size, screen);
            EXPECT_EQ(view.format, PixelFormat::Bgra8);
            for (int y = 0; y < screen.height; ++y)
                for (int x = 0; x < screen.width; ++x) {
                    const std::uint8_t* p = view.data + y * view.stride + 4 * x;
                    out.push_back({p[2], p[1], p[0]});
                    EXPECT_EQ(p[3], 255);
                }
        });
        return out;
    }
};

Colour noise(int x, int y) {
    const unsigned h =
        (static_cast<unsigned>(x) * 73856093U) ^ (static_cast<unsigned>(y) * 19349663U);
    return {static_cast<int>(h * 2654435761U >> 24), static_cast<int>(h * 40503U >> 8 & 255U),
            static_cast<int>(h * 69069U >> 16 & 255U)};
}

TEST_F(DisplayScaler, APictureOfTheScreensSizeIsCopied) {
    const Size size{321, 97};
    const auto pixels = shown(picture(size, noise), size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x)
            ASSERT_EQ(pixels[static_cast<std::size_t>(y) * size.width + x], noise(x, y))
                << x << ' ' << y;
}

TEST_F(DisplayScaler, EveryPixelIsTheMeanOfItsFootprint) {
    struct Case {
        Size from, screen;
    };
    for (const auto [from, screen] : {Case{{230, 172}, {128, 72}},
                                      {{64, 48}, {160, 90}},
                                      {{300, 20}, {40, 50}},
                                      {{9, 9}, {9, 5}}}) {
        const auto pixels = shown(picture(from, noise), screen);
        const ScreenRect r = letterbox(from, screen);
        double worst = 0;
        for (int y = 0; y < r.size.height; ++y)
            for (int x = 0; x < r.size.width; ++x) {
                const auto mean = twin::scaledPixel(from, noise, r, x, y);
                const Colour& got =
                    pixels[static_cast<std::size_t>(y + r.y) * screen.width + x + r.x];
                for (std::size_t k = 0; k < 3; ++k)
                    worst = std::max(worst, std::abs(got[k] - mean[k]));
            }
        // Tolerance: a GPU interpolates between two pixels with at least 8 bits. This loses up to
        // one grey level along x and one along y. Rounding adds half a grey level.
        EXPECT_LE(worst, 2.5) << from.width << "x" << from.height;
    }
}

TEST_F(DisplayScaler, ScreenBesideThePictureIsBlack) {
    const Size screen{128, 72};
    const auto white = [](int, int) { return Colour{255, 255, 255}; };
    const Size from{230, 172};
    const auto pixels = shown(picture(from, white), screen);
    const ScreenRect r = letterbox(from, screen);
    for (int y = 0; y < screen.height; ++y)
        for (int x = 0; x < screen.width; ++x) {
            const bool inside =
                x >= r.x && x < r.x + r.size.width && y >= r.y && y < r.y + r.size.height;
            const int level = inside ? 255 : 0;
            ASSERT_EQ(pixels[static_cast<std::size_t>(y) * screen.width + x],
                      (Colour{level, level, level}))
                << x << ' ' << y;
        }
}

// The stripes contain all frequencies, because they become finer from left to right. Detail finer
// than the screen's pixels must become grey. Sampling without a filter would show false stripes of
// full contrast.
TEST_F(DisplayScaler, DetailBeyondTheScreensResolutionBecomesGrey) {
    const Size from{2304, 1728}, screen{1280, 720};
    const auto stripes = [](int x, int) {
        // x / 2304 / 2 cycles per pixel
        const double phase = std::numbers::pi * x * x / 2304.0 / 2;
        const int level = static_cast<int>(std::lround(127.5 + 127.5 * std::cos(phase)));
        return Colour{level, level, level};
    };
    const auto pixels = shown(picture(from, stripes), screen);
    const auto contrast = [&](int begin, int end) {
        int low = 255, high = 0;
        for (int x = begin; x < end; ++x) {
            low = std::min(low, pixels[static_cast<std::size_t>(360) * 1280 + x][0]);
            high = std::max(high, pixels[static_cast<std::size_t>(360) * 1280 + x][0]);
        }
        return high - low;
    };
    EXPECT_GE(contrast(160, 400), 240);  // up to 0.3 cycles per screen pixel: full contrast
    EXPECT_LE(contrast(960, 1120), 64);  // 1 to 1.2 cycles per screen pixel: at most a quarter
}

TEST_F(DisplayScaler, WarmUpDoesNotChangeTheShownPicture) {
    const gpu::Texture texture = picture({96, 54}, noise);
    for (const Size screen : {Size{192, 108}, Size{96, 54}, Size{40, 30}, Size{20, 12}}) {
        ScreenScaler warm;
        warm.warmUp({texture.id(), texture.size()});
        EXPECT_EQ(shown(warm, texture, screen), shown(texture, screen)) << screen.width;
    }
    ScreenScaler scaler;
    EXPECT_NO_THROW(scaler.warmUp({})) << "warmUp() must work before the first picture";
}

TEST_F(DisplayScaler, DrawsOnAnotherContextOnceTheFirstIsReleased) {
    const auto colour = [](int x, int y) { return Colour{9 * x, 7 * y, 40}; };
    constexpr Size kPicture{24, 18}, kScreen{10, 8};
    ScreenScaler scaler;
    const std::vector<Colour> before = shown(scaler, picture(kPicture, colour), kScreen);
    scaler.releaseGl();
    EXPECT_NO_THROW(gpu::checkErrors("releaseGl"));
    {
        const std::unique_ptr<GlContext> other = createGlContext();
        EXPECT_EQ(shown(scaler, picture(kPicture, colour), kScreen), before);
        EXPECT_EQ(other->takeFault(), std::nullopt);
        scaler.releaseGl();
    }
    context().makeCurrent();
}

TEST_F(DisplayScaler, TheRenderTargetOfTheCallerIsRestored) {
    const gpu::Texture target({31, 17}, gpu::TexelFormat::Rgba8);
    const gpu::Framebuffer framebuffer(target);
    framebuffer.bind();
    {
        const KeptTarget kept;
        (void)shown(picture({20, 10}, noise), {64, 64});
    }
    const auto integer = [](GLenum name) {
        GLint value = -1;
        glGetIntegerv(name, &value);
        return value;
    };
    EXPECT_EQ(integer(GL_DRAW_FRAMEBUFFER_BINDING), static_cast<GLint>(framebuffer.id()));
    EXPECT_EQ(integer(GL_READ_FRAMEBUFFER_BINDING), static_cast<GLint>(framebuffer.id()));
    EXPECT_EQ(integer(GL_PIXEL_PACK_BUFFER_BINDING), 0);
    std::array<GLint, 4> viewport{};
    glGetIntegerv(GL_VIEWPORT, viewport.data());
    EXPECT_EQ(viewport, (std::array<GLint, 4>{0, 0, 31, 17}));
}

AlignedRows<std::uint32_t> noiseRows(Size size) {
    AlignedRows<std::uint32_t> rows(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const Colour c = noise(x, y);
            rows[y][x] = static_cast<std::uint32_t>(c[0] | c[1] << 8 | c[2] << 16 | 7 << 24);
        }
    return rows;
}

TEST_F(DisplayScaler, HostRowsAreDrawnLikeATexture) {
    const AlignedRows<std::uint32_t> small = noiseRows({96, 54}), large = noiseRows({230, 172});
    ScreenScaler scaler;
    const Size screen{128, 72};
    const gpu::Texture target(screen, gpu::TexelFormat::Rgba8);
    const gpu::Framebuffer framebuffer(target);
    const auto drawn = [&](const Picture& from) {
        scaler.draw(from, framebuffer.id(), screen, ScreenScaler::Order::Rgba);
        return target.readRgba8();
    };
    for (const auto* rows : {&small, &large, &small}) {
        const gpu::Texture texture = picture(rows->size(), noise);
        EXPECT_EQ(drawn(rows->rows()), drawn(GlImage{texture.id(), rows->size()}));
    }
}

TEST_F(DisplayScaler, ScreenReaderReadsTexturesAndHostRows) {
    const Size size{230, 172}, screen{128, 72};
    const gpu::Texture texture = picture(size, noise);
    const AlignedRows<std::uint32_t> rows = noiseRows(size);
    ScreenScaler scaler;
    ScreenReader reader(screen, scaler);
    reader.begin(GlImage{texture.id(), size});
    const ScreenPicture fromTexture = reader.last();
    reader.begin(rows.rows());
    std::vector<std::uint8_t> sent;
    reader.finish([&](const ImageView& view) {
        EXPECT_EQ(view.size, screen);
        ASSERT_EQ(view.format, PixelFormat::Rgba8);
        for (int y = 0; y < screen.height; ++y)
            sent.insert(sent.end(), view.data + y * view.stride,
                        view.data + y * view.stride + 4UL * screen.width);
    });
    const ScreenPicture fromRows = reader.last();
    ASSERT_EQ(sent.size(), fromRows.pixels.size());
    for (std::size_t i = 0; i < sent.size(); ++i) {
        if (i % 4 == 3) {
            EXPECT_EQ(fromRows.pixels[i], 255);
            continue;
        }
        ASSERT_EQ(fromRows.pixels[i], sent[i]);
        const std::size_t other = i / 4 * 4 + 2 - i % 4;
        ASSERT_NEAR(fromRows.pixels[i], fromTexture.pixels[other], 3) << i;
    }
    reader.begin(GlImage{texture.id(), size});
    EXPECT_EQ(reader.last().pixels, fromTexture.pixels);
}

TEST_F(DisplayScaler, ScreenReaderReturnsItsLastPicture) {
    const gpu::Texture from = picture({230, 172}, noise);
    ScreenScaler scaler;
    ScreenReader reader({128, 72}, scaler);
    reader.begin(GlImage{from.id(), from.size()});
    std::vector<std::uint8_t> sent;
    reader.finish(
        [&](const ImageView& view) { sent.assign(view.data, view.data + 128UL * 72 * 4); });
    EXPECT_EQ(reader.last().pixels, sent);
    EXPECT_EQ(reader.last().format, PixelFormat::Bgra8);
}

}  // namespace
}  // namespace mfar
