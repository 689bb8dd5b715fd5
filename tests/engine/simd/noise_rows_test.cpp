#include "pipeline/simd/noise_rows.h"
#include "tests/engine/simd/kernel_input.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>

namespace mfar::simd {
namespace {

constexpr Size kPicture{71, 40};
constexpr std::size_t kPixels = 71 * 40;
constexpr float kCatcher = 3;  // NoiseRule::catcherId

/// The arrays of a picture by name, with their margins.
class Arrays {
public:
    std::vector<float>& operator[](const std::string& name) {
        std::vector<float>& out = arrays_[name];
        out.resize(kPixels + 2 * kNoiseMargin);
        return out;
    }
    float* of(const std::string& name) { return (*this)[name].data() + kNoiseMargin; }

    template <class Float>
    LightPart<Float> part(const std::string& name) {
        return {{of(name + "r"), of(name + "g"), of(name + "b")},
                of(name + "variance"),
                of(name + "count")};
    }

private:
    std::map<std::string, std::vector<float>> arrays_;
};

void fillPart(Arrays& arrays, const std::string& name, unsigned seed) {
    for (const char* channel : {"r", "g", "b"})
        arrays[name + channel] =
            test::randomValues<float>(kPixels + 2 * kNoiseMargin, 0.3, 0.7, ++seed);
    arrays[name + "variance"] =
        test::randomValues<float>(kPixels + 2 * kNoiseMargin, 0, 0.05, ++seed);
    std::vector<float>& counts = arrays[name + "count"];
    counts = test::randomValues<float>(kPixels + 2 * kNoiseMargin, -3, 8, ++seed);
    for (float& count : counts)
        count = std::max(count, 0.0F);
}

/// Fills a picture with three surfaces at two depths, whose normals are up to 37 degrees from the
/// optical axis. A twentieth of the pixels has no surface, and a twentieth must stay unfiltered
/// (`fixed`).
void fillSurfaces(Arrays& arrays) {
    const auto at = test::randomValues<float>(kPixels, 0, 1, 91);
    const auto x = test::randomValues<float>(kPixels, -0.6, 0.6, 92);
    for (std::size_t i = 0; i < kPixels; ++i) {
        arrays.of("id")[i] = at[i] < 0.05F ? 0 : static_cast<float>(1 + i / 9 % 3);
        arrays.of("fixed")[i] = at[i] > 0.95F ? 1 : 0;
        arrays.of("depth")[i] = i / 25 % 2 == 0 ? 1 : 1.03F;
        arrays.of("nx")[i] = x[i];
        arrays.of("ny")[i] = 0;
        arrays.of("nz")[i] = -std::sqrt(1 - x[i] * x[i]);
    }
}

double luminance(double r, double g, double b) {
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

struct Filtered {
    std::array<double, 3> light{};
    double variance = 0, weights = 0;
};

/// Factor of the weight of pixel `j` in the mean around pixel `i`: 1 if they show one surface with
/// equal normals, 0 if they show unrelated surfaces.
double surfaceWeight(Arrays& a, std::size_t i, std::size_t j, const NoiseRule& rule) {
    if (i == j) return 1;
    if (a.of("id")[i] != a.of("id")[j]) return 0;
    const double depth = a.of("depth")[i];
    const double slope = a.of("id")[i] == kCatcher ? rule.catcherDepthSlope : rule.depthSlope;
    if (std::abs(a.of("depth")[j] - depth) > slope * rule.step * depth) return 0;
    const double cosine = a.of("nx")[i] * a.of("nx")[j] + a.of("nz")[i] * a.of("nz")[j];
    return std::pow(std::max(cosine, 0.0), 8);
}

double likeness(const LightPart<const float>& part, std::size_t i, std::size_t j, double tolerance,
                const NoiseRule& rule) {
    if (!(part.count[i] > 0)) return 1;
    const double off =
        luminance(part.light[0][j] - part.light[0][i], part.light[1][j] - part.light[1][i],
                  part.light[2][j] - part.light[2][i]);
    const double noise = part.variance[i] + part.variance[j] + rule.leastVariance;
    return std::pow(std::max(0.0, 1 - off * off / (tolerance * tolerance * noise)), 2);
}

Filtered meanOf(Arrays& a, const LightPart<const float>& part, const NoiseRule& rule,
                const PixelRect& where, int x, int y) {
    const auto index = [](int u, int v) {
        return static_cast<std::size_t>(v) * kPicture.width + static_cast<std::size_t>(u);
    };
    const std::size_t i = index(x, y);
    const bool isCatcher = a.of("id")[i] == kCatcher;
    Filtered out;
    for (int v = y - rule.step; v <= y + rule.step; v += rule.step)
        for (int u = x - rule.step; u <= x + rule.step; u += rule.step) {
            if (u < where.x0 || u >= where.x1 || v < where.y0 || v >= where.y1) continue;
            const std::size_t j = index(u, v);
            if (!(part.count[j] > 0)) continue;
            const double spline = (u == x ? 0.5 : 0.25) * (v == y ? 0.5 : 0.25);
            const double weight =
                spline * surfaceWeight(a, i, j, rule) *
                likeness(part, i, j, isCatcher ? rule.catcherTolerance : rule.tolerance, rule);
            for (std::size_t c = 0; c < 3; ++c)
                out.light[c] += weight * part.light[c][j];
            out.variance += weight * weight * part.variance[j];
            out.weights += weight;
        }
    return out;
}

void expectMean(Arrays& a, const std::string& name, const NoiseRule& rule, const PixelRect& where,
                int x, int y) {
    const LightPart<const float> from = a.part<const float>(name),
                                 to = a.part<const float>(name + "to");
    const std::size_t i =
        static_cast<std::size_t>(y) * kPicture.width + static_cast<std::size_t>(x);
    const Filtered mean = meanOf(a, from, rule, where, x, y);
    if (a.of("id")[i] == 0 || a.of("fixed")[i] > 0 || !(mean.weights > 0)) {
        EXPECT_EQ(to.light[0][i], from.light[0][i]);
        EXPECT_EQ(to.variance[i], from.variance[i]);
        EXPECT_EQ(to.count[i], from.count[i]);
        return;
    }
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(to.light[c][i], mean.light[c] / mean.weights, 2e-5);
    EXPECT_NEAR(to.variance[i], mean.variance / (mean.weights * mean.weights), 2e-5);
    EXPECT_EQ(to.count[i], std::max(from.count[i], 1.0F));
}

TEST(FilterNoiseRow, AveragesPixelsWhoseDifferenceNoiseMayExplain) {
    Arrays a;
    fillSurfaces(a);
    fillPart(a, "first", 10);
    fillPart(a, "second", 20);
    for (const std::size_t width : test::kLengths) {
        const int left = width > 60 ? 0 : 5;
        const PixelRect where{left, 3, std::min(left + static_cast<int>(width), kPicture.width),
                              36};
        for (const int step : {1, 2, 8}) {
            const NoiseRule rule{step, 2.5F, 4, kCatcher, 1e-7F, 0.01F, 0.025F};
            for (const int y : {3, 20, 35}) {
                filterNoiseRow({{{a.of("nx"), a.of("ny"), a.of("nz")},
                                 a.of("depth"),
                                 a.of("id"),
                                 a.of("fixed")},
                                {a.part<const float>("first"), a.part<const float>("second")},
                                {a.part<float>("firstto"), a.part<float>("secondto")},
                                where,
                                kPicture.width,
                                y},
                               rule);
                for (int x = where.x0; x < where.x1; ++x) {
                    SCOPED_TRACE(testing::Message() << "width " << width << ", step " << step
                                                    << ", " << x << ", " << y);
                    expectMean(a, "first", rule, where, x, y);
                    expectMean(a, "second", rule, where, x, y);
                }
            }
        }
    }
}

}  // namespace
}  // namespace mfar::simd
