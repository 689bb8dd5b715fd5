#include "hal/gl_context.h"
#include "pipeline/pipeline.h"
#include "tests/scene/scene_shots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mfar::test {
namespace {

using synthetic::Path;

double psnr(const Pipeline& pipeline, const StoredImage& truth, const std::vector<bool>& in) {
    const auto out = pipeline.readImage();
    const Size size = pipeline.outputSize();
    const double scale = size.width / 640.0;
    double sum = 0;
    std::size_t n = 0;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const int column = static_cast<int>(x / scale) / kTileSize;
            const int row = static_cast<int>(y / scale) / kTileSize;
            if (!in[static_cast<std::size_t>(row) * (640 / kTileSize) + column]) continue;
            const std::size_t i = 4 * (static_cast<std::size_t>(y) * size.width + x);
            for (std::size_t k = 0; k < 3; ++k)
                sum += std::pow(out[i + k] - truth.pixels[i + k], 2);
            n += 3;
        }
    return 10 * std::log10(255.0 * 255.0 * static_cast<double>(n) / sum);
}

class SceneTest : public testing::Test {
protected:
    void SetUp() override { context_->makeCurrent(); }

    static Pipeline ran(const SceneShots& s, SuperResMode mode) {
        Pipeline pipeline(s.board->rig(), {.mode = mode, .output = {}});
        pipeline.setStill(s.still.view(), s.still.time(), s.board->pose(s.still.time()));
        pipeline.run(s.frame.view(), s.frame.time(), s.board->pose(s.frame.time()));
        return pipeline;
    }

private:
    std::unique_ptr<GlContext> context_ = createGlContext();
};

TEST_F(SceneTest, MovingObjectsAreMatchedInBothDimensions) {
    const SceneShots s(synthetic::Scene::Moving, Path::Handheld, 8);
    const auto moving = s.movingTiles();
    const Pipeline detail = ran(s, SuperResMode::Detail), off = ran(s, SuperResMode::Off);
    const auto searched = detail.readSearchedTiles();
    ASSERT_EQ(moving.size(), searched.size());
    int movingCount = 0, movingSearched = 0, othersSearched = 0;
    for (std::size_t i = 0; i < moving.size(); ++i) {
        movingCount += moving[i] ? 1 : 0;
        movingSearched += moving[i] && searched[i] ? 1 : 0;
        othersSearched += !moving[i] && searched[i] ? 1 : 0;
    }
    ASSERT_GT(movingCount, 15);
    EXPECT_GE(movingSearched, 0.9 * movingCount);
    EXPECT_LE(othersSearched, 0.15 * static_cast<double>(moving.size()));
    EXPECT_EQ(detail.readStats().searched2d, movingSearched + othersSearched);

    const StoredImage truth = s.board->highRes(s.frame.time());
    EXPECT_GT(psnr(detail, truth, moving), psnr(off, truth, moving));
}

/// Tests with two camera paths. On Path::Forward, the epipole is in the picture. On Path::Rotate,
/// only the distance between the sensors causes parallax.
class Motion : public SceneTest, public testing::WithParamInterface<Path> {};

TEST_P(Motion, DetailIsAddedWhileTheCameraMoves) {
    const SceneShots s(synthetic::Scene::Outdoor, GetParam(), 8);
    const std::vector<bool> all(s.movingTiles().size(), true);
    const Pipeline detail = ran(s, SuperResMode::Detail), off = ran(s, SuperResMode::Off);
    EXPECT_LE(detail.readStats().searched2d, 0.15 * static_cast<double>(all.size()));
    const StoredImage truth = s.board->highRes(s.frame.time());
    EXPECT_GT(psnr(detail, truth, all), psnr(off, truth, all) + 2);
}

INSTANTIATE_TEST_SUITE_P(Paths, Motion, testing::Values(Path::Forward, Path::Rotate),
                         [](const auto& path) {
                             return path.param == Path::Forward ? "Forward" : "Rotate";
                         });

}  // namespace
}  // namespace mfar::test
