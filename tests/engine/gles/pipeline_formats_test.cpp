#include "tests/engine/gl_test.h"
#include "tests/engine/gles/pipeline_case.h"
#include "tests/unit/padded_picture.h"

#include <cmath>

namespace mfar {
namespace {

using PipelineFormats = GlTest;
using test::PaddedPicture;

void paint(const TestPicture& grey, YuvRange range, PaddedPicture& out) {
    const ImageView view = out.view();
    const int step = bytesPerPixel(view.format);
    std::fill(out.plane(0).begin(), out.plane(0).end(), std::uint8_t{128});
    for (int y = 0; y < grey.size.height; ++y)
        for (int x = 0; x < grey.size.width; ++x) {
            const std::uint8_t level =
                grey.bytes[static_cast<std::size_t>(y) * grey.size.width + x];
            const bool full = range == YuvRange::Full || step == 4;
            const auto luma =
                static_cast<std::uint8_t>(full ? level : std::lround(16 + level * 219.0 / 255));
            std::fill_n(&out.plane(0)[y * view.stride + 1UL * x * step], step == 4 ? 3 : 1, luma);
        }
    for (int i = 1; i < planeCount(view.format); ++i)
        std::fill(out.plane(i).begin(), out.plane(i).end(), std::uint8_t{128});
}

TEST_F(PipelineFormats, GreyPicturesInEveryFormatGiveTheSameOutput) {
    const PipelineCase c;
    const TestPicture video = c.waves.shoot(c.rig.video.size, {.format = PixelFormat::Gray8});
    const TestPicture still =
        c.waves.shoot(c.rig.still.size, {.step = 160.0 / 576, .format = PixelFormat::Gray8});
    const auto run = [&](const ImageView& s, const ImageView& v) {
        Pipeline p(c.rig, {});
        p.setStill(s, {});
        p.run(v, {});
        return p.readImage();
    };
    const auto expected = run(still.view(), video.view());
    for (const PixelFormat format : test::kEveryFormat)
        for (const YuvRange range : {YuvRange::Limited, YuvRange::Full}) {
            PaddedPicture s(format, still.size, 1), v(format, video.size, 2);
            paint(still, format == PixelFormat::Gray8 ? YuvRange::Full : range, s);
            paint(video, format == PixelFormat::Gray8 ? YuvRange::Full : range, v);
            const auto shown =
                run(s.view(YuvMatrix::Bt601, range), v.view(YuvMatrix::Bt601, range));
            EXPECT_GT(psnr(shown, expected), 45) << nameOf(format);
        }
}

TEST_F(PipelineFormats, InvalidViewsAreRefusedAndTheNextFrameIsProcessed) {
    const PipelineCase c;
    const PaddedPicture video(PixelFormat::Nv12, c.rig.video.size, 1);
    ImageView noChroma = video.view(), shortRows = video.view();
    noChroma.chroma[0].data = nullptr;
    shortRows.chroma[0].stride = 10;
    Pipeline p(c.rig, {});
    EXPECT_THROW(p.run(noChroma, {}), std::invalid_argument);
    EXPECT_THROW(p.run(shortRows, {}), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(flowBetween(video.view(), noChroma)), std::invalid_argument);
    const PaddedPicture still(PixelFormat::Yuv420, c.rig.still.size, 1);
    ImageView noV = still.view();
    noV.chroma[1].data = nullptr;
    EXPECT_THROW(p.setStill(noV, {}), std::invalid_argument);
    p.run(video.view(), {});
}

}  // namespace
}  // namespace mfar
