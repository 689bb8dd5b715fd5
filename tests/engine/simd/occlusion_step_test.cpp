#include "pipeline/simd/occlusion_step.h"
#include "tests/oracle/visibility.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <random>

namespace mfar::simd {
namespace {

constexpr Size kCoarse{53, 37};
constexpr Size kFine{191, 133};
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TestPicture wavyPicture(Size size) {
    TestPicture out(size, PixelFormat::Rgba8, 255);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const double u = (x + 0.5) * kCoarse.width / size.width;
            const double v = (y + 0.5) * kCoarse.height / size.height;
            for (int c = 0; c < 3; ++c)
                out.at(x, y)[c] = static_cast<std::uint8_t>(
                    128 + 60 * std::sin(0.8 * u + c) * std::cos(0.6 * v - c) +
                    30 * std::sin(0.1 * u * v));
        }
    return out;
}

struct Layer {
    std::array<std::uint8_t, 4> colour{200, 100, 50, 255};
    std::function<double(int, int)> z = [](int, int) { return 2.0; };
    PixelRect bounds{0, 0, 1000, 1000};
};

class Occlusion {
public:
    Occlusion(Size video, Size output) : video_(video), output_(output) {}

    void run(const twin::Scene& scene, const Layer& layer, int threads = 0, bool squared = false) {
        AlignedRows<float> inverseDepth(video_), sigma(video_), z(output_);
        AlignedRows<std::uint32_t> colour(output_);
        for (int y = 0; y < video_.height; ++y)
            for (int x = 0; x < video_.width; ++x) {
                const twin::RealSample& s = scene.real[1UL * y * video_.width + x];
                inverseDepth[y][x] = static_cast<float>(s.inverseDepth);
                sigma[y][x] = static_cast<float>(squared ? s.sigma * s.sigma : s.sigma);
            }
        for (int y = 0; y < output_.height; ++y)
            for (int x = 0; x < output_.width; ++x) {
                z[y][x] = static_cast<float>(layer.z(x, y));
                std::memcpy(&colour[y][x], layer.colour.data(), 4);
            }
        RgbPlanes planes(video_);
        planes.take(scene.video.view());
        shown_ = scene.picture.bytes;
        OcclusionStep step(video_, output_, output_, CompositeOptions{},
                           threads > 0 ? std::make_shared<Workers>(threads) : nullptr);
        step.run({colour.rows(), z.rows(), layer.bounds},
                 {inverseDepth.rows(), sigma.rows(), squared}, planes,
                 {reinterpret_cast<std::uint32_t*>(shown_.data()), output_.width, output_});
        visibility_.clear();
        for (int y = 0; y < output_.height; ++y)
            visibility_.insert(visibility_.end(), step.visibility()[y],
                               step.visibility()[y] + output_.width);
    }

    [[nodiscard]] double visibleAt(int x, int y) const {
        return visibility_[1UL * y * output_.width + x] / 255.0;
    }
    [[nodiscard]] const std::vector<std::uint8_t>& shown() const { return shown_; }

private:
    Size video_, output_;
    std::vector<std::uint8_t> shown_, visibility_;
};

struct Sides {
    Size video, output;
};

class OcclusionSizes : public testing::TestWithParam<Sides> {
protected:
    [[nodiscard]] twin::Scene roughScene() const {
        const auto& [video, output] = GetParam();
        std::mt19937 random(5);
        std::uniform_real_distribution<double> inverseDepth(0.3, 0.7), sigma(0.002, 0.05),
            unit(0, 1);
        twin::Scene scene{wavyPicture(video), wavyPicture(output), {}};
        for (int i = 0; i < video.width * video.height; ++i) {
            scene.real.push_back({inverseDepth(random), sigma(random)});
            if (unit(random) < 0.1) scene.real.back().inverseDepth = kNan;
            if (unit(random) < 0.1) scene.real.back().sigma = 0;
        }
        return scene;
    }
};

TEST_P(OcclusionSizes, PixelsInsideTheBoundsDoNotDependOnBoundsOrThreads) {
    const auto& [video, output] = GetParam();
    const twin::Scene scene = roughScene();
    Layer layer;
    layer.z = [](int x, int y) { return 2 + 0.6 * std::sin(0.05 * x) * std::cos(0.04 * y); };
    Occlusion whole(video, output), part(video, output);
    whole.run(scene, layer);
    layer.bounds = {output.width / 3, output.height / 4, output.width - 1, output.height - 3};
    for (const int threads : {0, 2, 3}) {
        part.run(scene, layer, threads, threads == 2);
        for (int y = 0; y < output.height; ++y)
            for (int x = 0; x < output.width; ++x) {
                const PixelRect& b = layer.bounds;
                const bool in = x >= b.x0 && x < b.x1 && y >= b.y0 && y < b.y1;
                if (in) {
                    // Tolerance: given a rounded sigma^2, the step computes sigma as its square
                    // root.
                    ASSERT_NEAR(part.visibleAt(x, y), whole.visibleAt(x, y),
                                threads == 2 ? 1.01 / 255 : 0);
                }
                for (std::size_t c = 0; c < 4; ++c) {
                    const std::size_t i = 4 * (1UL * y * output.width + x) + c;
                    ASSERT_NEAR(part.shown()[i], in ? whole.shown()[i] : scene.picture.bytes[i],
                                in && threads == 2 ? 2 : 0)
                        << x << ", " << y;
                }
            }
    }
}

INSTANTIATE_TEST_SUITE_P(Sides, OcclusionSizes,
                         testing::Values(Sides{kCoarse, kFine}, Sides{{16, 16}, {16, 16}},
                                         Sides{{17, 31}, {601, 40}}, Sides{{64, 48}, {33, 21}},
                                         Sides{{40, 30}, {160, 120}}));

}  // namespace
}  // namespace mfar::simd
