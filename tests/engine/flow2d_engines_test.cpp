#include "pipeline/gles/flow2d.h"
#include "pipeline/gles/luma_pyramids.h"
#include "pipeline/simd/flow2d.h"
#include "pipeline/simd/luma_pyramids.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/pictures.h"

#include <opencv2/imgcodecs.hpp>

#include <algorithm>
#include <cstring>
#include <filesystem>

namespace mfar {
namespace {

using Flow2dEngines = GlTest;
using Cell = std::array<float, 4>;

class Engines {
public:
    Engines(const TestPicture& now, const TestPicture& then)
        : size_(now.size), tiles_(size_), glPyramids_(size_), glFlow_(size_),
          workers_(std::make_shared<Workers>()), pyramids_(size_, workers_),
          flow_(size_, {}, workers_) {
        glPyramids_.buildVideo(uploaded(now));
        glPyramids_.buildSecond(uploaded(then));
    }

    /// Copies the pyramids of the shaders to the search on the host, so that both searches read the
    /// same bytes.
    void sharePyramids() {
        const auto words = glPyramids_.words().read<std::uint32_t>(pyramids_.words().size());
        std::ranges::copy(words, pyramids_.words().begin());
    }
    void run(bool usePrior) {
        glFlow_.run(glPyramids_.luma(), tiles_, usePrior);
        flow_.run(luma(), tiles_.work(), usePrior);
    }
    void refine(const std::vector<Cell>& forward, const std::vector<Cell>& errors) {
        glFlow_.refine(glPyramids_.luma(), tiles_, forward, errors);
        flow_.refine(luma(), tiles_.work(), forward, errors, false);
    }
    [[nodiscard]] simd::Flow2d::Luma luma() const {
        return {pyramids_.video(), pyramids_.still(), pyramids_.words()};
    }
    [[nodiscard]] std::vector<Cell> read(const Flow2d::Field& field) const {
        return glFlow_.cells().read<Cell>(static_cast<std::size_t>(field.cells.width) *
                                              field.cells.height,
                                          sizeof(Cell) * field.offset);
    }
    [[nodiscard]] std::vector<Cell> glForward() const { return read(glFlow_.forward()); }
    [[nodiscard]] std::vector<Cell> glBackward() const { return read(glFlow_.backward()); }
    [[nodiscard]] const simd::Flow2d& flow() const { return flow_; }
    [[nodiscard]] const Flow2d& glFlow() const { return glFlow_; }

private:
    Size size_;
    TileBuffer tiles_;
    LumaPyramids glPyramids_;
    Flow2d glFlow_;
    std::shared_ptr<Workers> workers_;
    simd::LumaPyramids pyramids_;
    simd::Flow2d flow_;
};

struct Difference {
    double close = 0;   ///< share of cells that differ by less than kClose
    double median = 0;  ///< median difference [px]
    double cost = 0;    ///< mean difference of the matching cost
};
constexpr double kClose = 0.02;  // largest difference of two flows that count as close [px]

Difference differenceOf(const std::vector<Cell>& gl, Rows<const FlowCell> host) {
    std::vector<double> off;
    double cost = 0;
    for (int y = 0; y < host.size.height; ++y)
        for (int x = 0; x < host.size.width; ++x) {
            const Cell& a = gl[static_cast<std::size_t>(y) * host.size.width + x];
            const FlowCell& b = host[y][x];
            EXPECT_TRUE(std::isfinite(b.x) && std::isfinite(b.y));
            off.push_back(std::hypot(a[0] - b.x, a[1] - b.y));
            cost += std::abs(a[2] - b.cost);
        }
    Difference d;
    const auto count = static_cast<double>(off.size());
    d.close = static_cast<double>(std::ranges::count_if(off, [](double v) { return v < kClose; })) /
              count;
    std::ranges::nth_element(off, off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2));
    d.median = off[off.size() / 2];
    d.cost = cost / count;
    return d;
}

// If a candidate vector or a Gauss-Newton step hardly changes a cell's cost, rounding decides
// whether the search accepts it. So a few cells may get different vectors of the same cost.
void expectAlike(const Difference& d, double leastClose) {
    EXPECT_GT(d.close, leastClose);
    EXPECT_LT(d.median, 0.003);
    EXPECT_LT(d.cost, 0.003);
}

TEST_F(Flow2dEngines, BothEnginesFindTheSameFlow) {
    for (const Size size : {Size{320, 240}, Size{213, 119}}) {
        const Waves waves(1, 8, 120, 35);
        Engines e(waves.shoot(size, {}), waves.shoot(size, {.shift = {-4.3, 2.7}, .gain = 0.8}));
        e.sharePyramids();
        for (const bool usePrior : {false, true}) {
            e.run(usePrior);
            expectAlike(differenceOf(e.glForward(), e.flow().forward()), 0.94);
            expectAlike(differenceOf(e.glBackward(), e.flow().backward()), 0.94);
        }
    }
}

TEST_F(Flow2dEngines, BothEnginesFindTheSameFlowOnAPhotograph) {
    const std::filesystem::path folder = std::filesystem::path(MFAR_SHARED_DATA) / "rubberwhale";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " does not exist";
    const auto load = [&](const char* name) {
        const cv::Mat grey = cv::imread((folder / name).string(), cv::IMREAD_GRAYSCALE);
        TestPicture out({grey.cols, grey.rows}, PixelFormat::Gray8);
        std::memcpy(out.bytes.data(), grey.data, out.bytes.size());
        return out;
    };
    Engines e(load("frame10.png"), load("frame11.png"));
    e.sharePyramids();
    for (const bool usePrior : {false, true}) {
        e.run(usePrior);
        expectAlike(differenceOf(e.glForward(), e.flow().forward()), 0.88);
        expectAlike(differenceOf(e.glBackward(), e.flow().backward()), 0.88);
    }
    const std::vector<Cell> found = e.glForward();
    e.refine(found, std::vector<Cell>(found.size()));
    expectAlike(differenceOf(e.glForward(), e.flow().forward()), 0.88);
    const std::vector<bool> gl = e.glFlow().searched().read(), &host = e.flow().searchedTiles();
    int differing = 0;
    for (std::size_t i = 0; i < gl.size(); ++i)
        differing += gl[i] != host[i] ? 1 : 0;
    EXPECT_GT(e.flow().searchedCount(), 0);
    EXPECT_LE(differing, e.flow().searchedCount() / 20 + 1);
}

}  // namespace
}  // namespace mfar
