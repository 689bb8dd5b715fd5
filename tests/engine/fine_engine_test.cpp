#include "pipeline/gles/device_copies.h"
#include "pipeline/gles/fine_check.h"
#include "pipeline/simd/fine_check.h"
#include "tests/engine/gl_test.h"
#include "tests/engine/simd/detail_case.h"
#include "tests/oracle/fine.h"
#include "tests/oracle/superres.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mfar {
namespace {

using simd::DetailCase;
using Shares = std::vector<float>;

constexpr FineMatch kMatch{5, 0.02F};

/// Weights before the comparison, from 0.25 to 1.75.
float weightAt(std::size_t cell) {
    return 0.25F + 0.25F * static_cast<float>(cell % 7);
}
double raised(double weight) {
    return weight < 1 ? 1 - std::pow(1 - weight, 4) : weight;
}

struct FineInput {
    explicit FineInput(Size video, Size stillSize)
        : frame(video, stillSize), still(frame.rig, stillSize, std::make_shared<Workers>(2)),
          kink(frame.cells), variance(frame.cells) {
        still.set(frame.stillView());
        flow.size = frame.cells;
        statistics.size = frame.cells;
        for (int y = 0; y < frame.cells.height; ++y)
            for (int x = 0; x < frame.cells.width; ++x) {
                for (const double value : {flowAt(x), 2.0, 0.0, 0.0})
                    flow.values.push_back(static_cast<float>(value));
                const double patch = params::kPatchPixels * std::pow(10.0, 1 + y % 7 / 3.0);
                for (const double value : {0.0, patch, 0.0, 0.5})
                    statistics.values.push_back(static_cast<float>(value));
            }
        for (int y = 0; y < frame.cells.height; ++y)
            for (int x = 0; x < frame.cells.width; ++x) {
                kink[y][x] = static_cast<float>(twin::kinkAt(flow, x, y));
                variance[y][x] = static_cast<float>(varianceAt(x, y));
            }
        for (std::size_t i = 0; i < frame.work.flags.size(); ++i)
            frame.work.flags[i].matched = i % 4 != 1;
    }
    [[nodiscard]] Rows<const LookUpCell> lookUps() const {
        return {frame.lookUps.data(), frame.cells.width, frame.cells};
    }
    /// The flow is constant in the left third, linear in x in the middle third, and curved in the
    /// right third.
    [[nodiscard]] double flowAt(int x) const {
        const double third = frame.cells.width / 3.0;
        const double bent = std::max(x - third, 0.0), curved = std::max(x - 2 * third, 0.0);
        return 0.3 * bent + 0.02 * std::pow(curved, 3);
    }
    [[nodiscard]] double varianceAt(int x, int y) const {
        double sum = 0;
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i)
                sum +=
                    (2 - std::abs(i)) * (2 - std::abs(j)) / 16.0 * statistics.at(x + i, y + j)[1];
        return sum / params::kPatchPixels;
    }
    [[nodiscard]] std::vector<double> wanted() const {
        const Size video = frame.rig.video.size, size = frame.rig.still.size;
        const simd::StillPairs pairs = still.pairs();
        const auto field = [&](auto member) {
            return twin::greyOf(frame.cells, [&](int x, int y) {
                return double(frame.lookUps[y * frame.cells.width + x].*member);
            });
        };
        const twin::Grey offX = field(&LookUpCell::x), offY = field(&LookUpCell::y),
                         codes = field(&LookUpCell::confidenceAndJumps);
        const twin::Grey luma = twin::greyOf(
            size, [&](int x, int y) { return double((pairs.data + y * pairs.pitch)[x] & 255); });
        const twin::FineCase in{
            twin::greyOf(video,
                         [&](int x, int y) {
                             return 0.299 * frame.video.row(0, y)[x] +
                                    0.587 * frame.video.row(1, y)[x] +
                                    0.114 * frame.video.row(2, y)[x];
                         }),
            [&](double x, double y) {
                const double u = (x + 0.5) / 4 - 0.5, v = (y + 0.5) / 4 - 0.5;
                const double px = (x + 0.5) * frame.rig.still.fx / frame.rig.video.fx - 0.5 +
                                  twin::lookedUp(offX, codes, u, v),
                             py = (y + 0.5) * frame.rig.still.fy / frame.rig.video.fy - 0.5 +
                                  twin::lookedUp(offY, codes, u, v);
                return luma.bilinear(std::clamp(px, 0.0, size.width - 1.0),
                                     std::clamp(py, 0.0, size.height - 1.0));
            },
            [&](int x, int y) { return frame.work.at(x / 4, y / 4).matched != 0; },
            [&](int x, int y) { return twin::kinkAt(flow, x, y); },
            [&](int x, int y) { return varianceAt(x, y); }};
        return twin::fineShares(in, frame.cells, kMatch);
    }

    DetailCase frame;
    simd::StillPreparation still;
    twin::Cells flow, statistics;
    AlignedRows<float> kink, variance;
};

Shares onHost(const FineInput& in) {
    simd::FineCheck check(in.still.rig(), std::make_shared<Workers>(2));
    Shares out;
    for (int run = 0; run < 2; ++run) {
        const Rows<const float> rows =
            check.run(in.frame.video, in.still.pairs(), in.lookUps(),
                      {in.kink.rows(), in.variance.rows()}, in.frame.work, kMatch);
        out.clear();
        for (int y = 0; y < rows.size.height; ++y)
            out.insert(out.end(), rows[y], rows[y] + rows.size.width);
    }
    return out;
}

template <class Cell>
gpu::Texture uploaded(const std::vector<Cell>& cells, Size size, gpu::TexelFormat format,
                      bool floats = false) {
    gpu::Texture out(size, format, gpu::Filter::Linear);
    TextureCopy(out, floats)
        .upload(cells.data(), static_cast<std::ptrdiff_t>(sizeof(Cell)) * size.width);
    return out;
}

gpu::Texture uploadedLuma(const simd::StillPairs& pairs) {
    std::vector<std::uint8_t> luma;
    for (int y = 0; y < pairs.size.height; ++y)
        for (int x = 0; x < pairs.size.width; ++x)
            luma.push_back(static_cast<std::uint8_t>((pairs.data + y * pairs.pitch)[x] & 255));
    return uploaded(luma, pairs.size, gpu::TexelFormat::R8);
}

Shares onGpu(const FineInput& in) {
    const Size cells = in.frame.cells, video = in.frame.rig.video.size;
    std::vector<WeighedCell> cellsIn(in.frame.weighed.size());
    std::vector<LookUpCell> lookUps = in.frame.lookUps;
    std::vector<TrustCell> trust(cellsIn.size(), {1, 0.5F, 0.25F, 1});
    std::vector<std::array<float, 4>> statistics(cellsIn.size());
    for (std::size_t i = 0; i < cellsIn.size(); ++i) {
        cellsIn[i] = {in.flow.values[4 * i], in.flow.values[4 * i + 1], weightAt(i), 0.5F};
        std::copy_n(&in.statistics.values[4 * i], 4, statistics[i].begin());
        lookUps[i].weight = weightAt(i);
    }
    gpu::Texture picture(video, gpu::TexelFormat::Rgba8);
    TextureCopy(picture).upload(in.frame.videoPixels.data(), 4L * video.width);
    const gpu::Texture still = uploadedLuma(in.still.pairs()),
                       weighed = uploaded(cellsIn, cells, gpu::TexelFormat::Rgba32F),
                       looked = uploaded(lookUps, cells, gpu::TexelFormat::Rgba16F),
                       trusted = uploaded(trust, cells, gpu::TexelFormat::Rgba8, true),
                       measured = uploaded(statistics, cells, gpu::TexelFormat::Rgba32F);
    TileBuffer tiles(video);
    tiles.set(in.frame.work);
    FineCheck check(in.still.rig());
    check.run(picture, still, {weighed, looked, trusted}, measured, tiles, kMatch);
    const std::vector<float> got = check.weights().weighed.readRgba32F(),
                             gotLooked = check.weights().lookUps.readRgba32F();
    const std::vector<std::uint8_t> gotTrust = check.weights().trust.readRgba8();
    Shares out;
    for (std::size_t i = 0; i < cellsIn.size(); ++i) {
        const float weight = got[4 * i + 2];
        out.push_back(static_cast<float>(weight / raised(weightAt(i))));
        EXPECT_EQ(got[4 * i], cellsIn[i].x);
        EXPECT_EQ(got[4 * i + 1], 2);
        EXPECT_EQ(got[4 * i + 3], 0.5F);
        EXPECT_NEAR(gotLooked[4 * i], lookUps[i].x, 1e-3 * std::abs(lookUps[i].x) + 1e-3);
        EXPECT_NEAR(gotLooked[4 * i + 2], weight, 1e-3);
        EXPECT_NEAR(gotLooked[4 * i + 3], lookUps[i].confidenceAndJumps, 4e-3);
        EXPECT_NEAR(gotTrust[4 * i] / 255.0, std::min(weight / 2, 1.0F), 3e-3);
        EXPECT_NEAR(gotTrust[4 * i + 2] / 255.0, 0.25, 3e-3);
        EXPECT_EQ(gotTrust[4 * i + 3], 255);
    }
    return out;
}

class FineEngines : public GlTest {
protected:
    static void expectTheOracles(const std::function<Shares(const FineInput&)>& sharesOf) {
        for (const auto& [video, still] :
             {std::pair{Size{160, 96}, Size{576, 346}}, {Size{83, 61}, Size{211, 155}}}) {
            const FineInput in(video, still);
            const Shares got = sharesOf(in);
            const std::vector<double> wanted = in.wanted();
            ASSERT_EQ(got.size(), wanted.size());
            int whole = 0, part = 0;
            for (std::size_t i = 0; i < got.size(); ++i) {
                ASSERT_NEAR(got[i], wanted[i], 0.02)
                    << i % in.frame.cells.width << ", " << i / in.frame.cells.width;
                whole += wanted[i] == 1 ? 1 : 0;
                part += wanted[i] < 0.7 ? 1 : 0;
            }
            EXPECT_GT(whole, 20);
            EXPECT_GT(part, 20);
        }
    }
};

TEST_F(FineEngines, SimdFineCheckMatchesTheOracle) {
    expectTheOracles(onHost);
}

TEST_F(FineEngines, GlesFineCheckMatchesTheOracle) {
    expectTheOracles(onGpu);
}

}  // namespace
}  // namespace mfar
