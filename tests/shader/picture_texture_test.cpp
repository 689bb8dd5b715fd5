#include "pipeline/gpu/picture_texture.h"
#include "tests/shader/gl_test.h"
#include "tests/shader/pictures.h"
#include "tests/shader/twins/yuv.h"
#include "tests/unit/padded_picture.h"

namespace mfar {
namespace {

using test::kEveryFormat;
using test::PaddedPicture;
using PictureTexture = GlTest;

constexpr Size kEvenSize{54, 38};
// Of a result in 8 bits.
constexpr double kConverted = 0.501;
// A grey level that a bilinear filter of 8-bit weights may lose in both chroma channels.
constexpr double kChroma = kConverted + 2.2;

void expectTwin(const gpu::PictureTexture& picture, const ImageView& view, double tolerance) {
    const auto pixels = sampled(picture.texture());
    ASSERT_EQ(picture.texture().size(), view.size);
    double worst = 0;
    for (int y = 0; y < view.size.height; ++y)
        for (int x = 0; x < view.size.width; ++x) {
            const auto rgb = twin::rgbAt(view, x, y);
            const std::size_t i = 4 * (static_cast<std::size_t>(y) * view.size.width + x);
            for (std::size_t c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(pixels[i + c] - rgb[c]));
        }
    EXPECT_LE(worst, tolerance) << nameOf(view.format);
}

bool isYuv(PixelFormat format) {
    return format == PixelFormat::Yuyv || format == PixelFormat::Nv12 ||
           format == PixelFormat::Yuv420;
}

TEST_F(PictureTexture, EveryFormatWithPaddedRowsMatchesTheTwin) {
    for (const PixelFormat format : kEveryFormat) {
        const PaddedPicture source(format, kEvenSize, 3);
        for (const YuvMatrix matrix : {YuvMatrix::Bt601, YuvMatrix::Bt709})
            for (const YuvRange range : {YuvRange::Limited, YuvRange::Full}) {
                gpu::PictureTexture picture;
                const ImageView view = source.view(matrix, range);
                picture.upload(view);
                expectTwin(picture, view, isYuv(format) ? kChroma : 0);
            }
    }
}

TEST_F(PictureTexture, RowsMayHaveAnyNumberOfBytes) {
    for (const PixelFormat format : kEveryFormat) {
        const PaddedPicture source(format, kEvenSize, 3, 5);
        gpu::PictureTexture picture;
        picture.upload(source.view());
        expectTwin(picture, source.view(), isYuv(format) ? kChroma : 0);
    }
}

// Constant chroma needs no filter, so that nothing hides behind its tolerance.
TEST_F(PictureTexture, LumaIsExact) {
    for (const PixelFormat format : {PixelFormat::Yuyv, PixelFormat::Nv12, PixelFormat::Yuv420}) {
        PaddedPicture source(format, kEvenSize, 4);
        if (format == PixelFormat::Yuyv)
            for (std::size_t i = 1; i < source.plane(0).size(); i += 2)
                source.plane(0)[i] = 140;
        else
            for (int i = 1; i < planeCount(format); ++i)
                std::fill(source.plane(i).begin(), source.plane(i).end(), std::uint8_t{140});
        gpu::PictureTexture picture;
        picture.upload(source.view());
        expectTwin(picture, source.view(), kConverted);
    }
}

TEST_F(PictureTexture, FormatAndSizeMayChangeFromPictureToPicture) {
    gpu::PictureTexture picture;
    for (const Size size : {kEvenSize, Size{26, 50}})
        for (const PixelFormat format : {PixelFormat::Nv12, PixelFormat::Bgra8, PixelFormat::Gray8,
                                         PixelFormat::Yuyv, PixelFormat::Rgba8}) {
            const PaddedPicture source(format, size, 5);
            picture.upload(source.view());
            expectTwin(picture, source.view(), isYuv(format) ? kChroma : 0);
        }
}

TEST_F(PictureTexture, ThePictureOfEachUploadIsTheNewOne) {
    gpu::PictureTexture picture;
    GLuint id = 0;
    for (unsigned seed = 1; seed < 4; ++seed) {
        const PaddedPicture source(PixelFormat::Yuv420, kEvenSize, seed);
        picture.upload(source.view());
        expectTwin(picture, source.view(), kChroma);
        EXPECT_TRUE(id == 0 || id == picture.texture().id()) << "allocated again";
        id = picture.texture().id();
    }
}

}  // namespace
}  // namespace mfar
