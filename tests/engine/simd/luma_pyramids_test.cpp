#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/simd/luma_pyramids.h"
#include "tests/engine/simd/flow_pictures.h"

#include <gtest/gtest.h>

namespace mfar::simd {
namespace {

// Tolerance: half a grey level, plus rounding errors of single precision.
constexpr double kRounding = 0.501;

/// A pyramid level as it is stored; its columns begin at x = -8.
class Stored {
public:
    Stored(const LumaPyramids& pyramids, const LumaLevel& level)
        : bytes_(reinterpret_cast<const std::uint8_t*>(pyramids.words().data() + level.offset)),
          level_(level) {}
    [[nodiscard]] int at(int x, int y) const {
        return bytes_[std::ptrdiff_t{4} * y * level_.pitch + x + 8];
    }
    [[nodiscard]] int held(int x, int y) const {
        return at(std::clamp(x, 0, level_.width - 1), std::clamp(y, 0, level_.height - 1));
    }
    void checkMargins() const {
        for (int y = 0; y < level_.height; ++y)
            for (int x = -8; x < 4 * level_.pitch - 8; ++x)
                ASSERT_EQ(at(x, y), held(x, y)) << x << ", " << y;
    }

private:
    const std::uint8_t* bytes_;
    LumaLevel level_;
};

TEST(LumaPyramids, FinestLevelIsSmoothed) {
    for (const Size size : {Size{640, 48}, Size{101, 59}, Size{16, 16}, Size{273, 33}}) {
        const FlowPicture first = noiseOf(size, 1), second = noiseOf(size, 2);
        LumaPyramids pyramids(size, twoWorkers());
        pyramids.buildFirst(first.rows());
        pyramids.buildSecond(second.rows());
        const Stored video(pyramids, pyramids.video()[0]), still(pyramids, pyramids.still()[0]);
        const twin::Grey wanted = twin::smoothed(greyOf(first)),
                         wantedStill = twin::smoothed(greyOf(second));
        video.checkMargins();
        still.checkMargins();
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x) {
                ASSERT_NEAR(video.at(x, y), wanted.at(x, y), kRounding) << x << ", " << y;
                ASSERT_NEAR(still.at(x, y), wantedStill.at(x, y), kRounding) << x << ", " << y;
            }
    }
}

TEST(LumaPyramids, LumaOfColoursFollowsRec601) {
    constexpr Size kSize{33, 17};
    std::vector<std::uint8_t> texels(4UL * kSize.width * kSize.height);
    for (std::size_t i = 0; i < texels.size(); ++i)
        texels[i] = std::array<std::uint8_t, 4>{200, 100, 30, 255}[i % 4];
    RgbPlanes planes(kSize);
    planes.take({texels.data(), kSize, 4UL * kSize.width, PixelFormat::Rgba8});
    LumaPyramids pyramids(kSize, twoWorkers());
    pyramids.buildVideo(planes);
    const Stored level(pyramids, pyramids.video()[0]);
    for (int y = 0; y < kSize.height; ++y)
        for (int x = 0; x < kSize.width; ++x)
            ASSERT_EQ(level.at(x, y), std::lround(0.299 * 200 + 0.587 * 100 + 0.114 * 30));
}

TEST(LumaPyramids, ThePyramidOfAVideoFrameEqualsThatOfItsLuma) {
    const FlowPicture picture = noiseOf({101, 59}, 3);
    LumaPyramids fromPlanes(picture.size, twoWorkers()), fromLuma(picture.size, twoWorkers());
    fromPlanes.buildVideo(planesOf(picture));
    fromLuma.buildFirst(picture.rows());
    for (std::size_t i = 0; i < fromLuma.video().size(); ++i) {
        const LumaLevel& level = fromLuma.video()[i];
        const Stored a(fromPlanes, level), b(fromLuma, level);
        for (int y = 0; y < level.height; ++y)
            for (int x = 0; x < level.width; ++x)
                ASSERT_NEAR(a.at(x, y), b.at(x, y), 1) << x << ", " << y;
    }
}

TEST(LumaPyramids, CoarserLevelsAreExactMeans) {
    const FlowPicture picture = noiseOf({213, 119}, 1);
    LumaPyramids pyramids(picture.size, twoWorkers());
    pyramids.buildFirst(picture.rows());
    ASSERT_EQ(pyramids.video().size(), 3U);
    for (std::size_t i = 1; i < 3; ++i) {
        const LumaLevel& level = pyramids.video()[i];
        const Stored fine(pyramids, pyramids.video()[i - 1]), coarse(pyramids, level);
        coarse.checkMargins();
        for (int y = 0; y < level.height; ++y)
            for (int x = 0; x < level.width; ++x)
                ASSERT_EQ(coarse.at(x, y),
                          (fine.held(2 * x, 2 * y) + fine.held(2 * x + 1, 2 * y) +
                           fine.held(2 * x, 2 * y + 1) + fine.held(2 * x + 1, 2 * y + 1) + 2) /
                              4);
    }
}

StereoRig bentRigOf(Size video, Size still) {
    StereoRig rig = rigOf(video, still);
    rig.video.distortion = {-0.12, 0.03, 0.001, -0.0005, 0.002};
    rig.still.distortion = {0.06, -0.02, -0.0008, 0.0006, -0.001};
    rig.still.cx += 7.3;
    rig.T_still_video.rotation =
        Eigen::AngleAxisd(0.03, Eigen::Vector3d(0.3, -0.5, 0.8).normalized());
    return rig;
}

TEST(LumaPyramids, StillsAreResampledToPixelsOfTheVideo) {
    // With the largest still, a video pixel's footprint does not fit into the kernel's window.
    for (const Size size : {Size{345, 259}, Size{96, 72}, Size{1000, 750}}) {
        const FlowPicture still = wavesMoved(size, {0, 0});
        const Size video{96, 72};
        for (const StereoRig& rig : {rigOf(video, size), bentRigOf(video, size)})
            for (const float light : {0.0F, 0.7F, Guidance::kMost}) {
                LumaPyramids pyramids(video, twoWorkers());
                pyramids.buildStill(still.rows(), rig, light);
                const Stored level(pyramids, pyramids.still()[0]);
                const twin::Grey wanted = twin::lumaFromStill(greyOf(still), rig, light);
                level.checkMargins();
                for (int y = 0; y < video.height; ++y)
                    for (int x = 0; x < video.width; ++x)
                        ASSERT_NEAR(level.at(x, y), wanted.at(x, y), kRounding + 0.15)
                            << x << ", " << y << " of " << size.width << ", " << light;
            }
    }
}

TEST(LumaPyramids, RaysBehindTheStillCameraGetTheValueOfTheBorder) {
    const Size video{64, 48};
    StereoRig rig = rigOf(video, video);
    rig.T_still_video.rotation = Eigen::AngleAxisd(3, Eigen::Vector3d::UnitY());
    LumaPyramids pyramids(video, twoWorkers());
    FlowPicture still(video, 10);
    for (int y = 0; y < video.height; ++y)
        for (int x = 0; x < video.width; ++x)
            if (x == 0 || y == 0 || x == video.width - 1 || y == video.height - 1)
                still.at(x, y) = 91;
    pyramids.buildStill(still.rows(), rig, 1);
    const Stored level(pyramids, pyramids.still()[0]);
    for (int y = 0; y < video.height; ++y)
        for (int x = 0; x < video.width; ++x)
            ASSERT_EQ(level.at(x, y), 91);
}

TEST(LumaPyramids, BlackAndWhiteAreKept) {
    for (const std::uint8_t fill : {0, 255}) {
        const FlowPicture flat({70, 60}, fill);
        LumaPyramids pyramids(flat.size, twoWorkers());
        pyramids.buildFirst(flat.rows());
        for (const LumaLevel& level : pyramids.video())
            for (int y = 0; y < level.height; ++y)
                for (int x = 0; x < level.width; ++x)
                    ASSERT_EQ(Stored(pyramids, level).at(x, y), fill);
    }
}

}  // namespace
}  // namespace mfar::simd
