#include "pipeline/pipeline.h"
#include "tests/engine/gl_test.h"
#include "tests/learn/sensor_pair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace mfar {
namespace {

using twin::Grey;
using Bytes = std::vector<std::uint8_t>;

class NoisyStill : public GlTest, public testing::WithParamInterface<EngineKind> {
protected:
    /// Mean squared error of the drawn picture [grey levels^2]. `sigma`: standard deviation of the
    /// still's noise [grey levels].
    static double error(double sigma) {
        const Grey scene = sharpDiscs(1);
        std::mt19937 random(2);
        std::normal_distribution<double> noise(0, 1);
        Bytes still;
        for (const double level : scene.values)
            still.push_back(static_cast<std::uint8_t>(
                std::clamp(std::round(level + sigma * noise(random)), 0.0, 255.0)));
        const Bytes video = bytesOf(videoOf(scene, {}));
        Pipeline pipeline(discsRig(), {.output = {}, .engines = EngineChoice::all(GetParam())});
        pipeline.setStill(
            {still.data(), kDiscsStill, std::size_t(kDiscsStill.width), PixelFormat::Gray8}, {});
        pipeline.run(
            {video.data(), kDiscsVideo, std::size_t(kDiscsVideo.width), PixelFormat::Gray8}, {});
        const Bytes picture = pipeline.readImage();
        double sum = 0;
        for (std::size_t i = 0; i < scene.values.size(); ++i)
            sum += std::pow(picture[4 * i] - scene.values[i], 2);
        return sum / static_cast<double>(scene.values.size());
    }
};
INSTANTIATE_TEST_SUITE_P(Engines, NoisyStill, testing::Values(EngineKind::Simd, EngineKind::Gles),
                         [](const auto& tested) { return std::string(nameOf(tested.param)); });

TEST_P(NoisyStill, MostOfItsNoiseIsRemoved) {
    constexpr double kSigma = 6;
    EXPECT_LT(error(kSigma), error(0) + 0.4 * kSigma * kSigma);
}

}  // namespace
}  // namespace mfar
