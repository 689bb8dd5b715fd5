#include "pipeline/epipolar/epipolar_lens.h"
#include "pipeline/simd/census_rows.h"
#include "pipeline/simd/depth_rows.h"
#include "pipeline/simd/label_lines.h"
#include "pipeline/simd/turned_rows.h"
#include "tests/engine/simd/kernel_input.h"
#include "tests/stability/cases.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace mfar::stress {
namespace {

using simd::Valley;
using Row = std::vector<float>;

Row rowOf(Context& c, std::size_t count, double low, double high, double spoilt = 0) {
    Row out(count);
    for (float& v : out)
        v = static_cast<float>(c.hostile.chance(spoilt) ? c.hostile.bad()
                                                        : c.hostile.real(low, high));
    return out;
}

std::size_t lengthOf(Context& c) {
    return static_cast<std::size_t>(c.hostile.integer(1, c.scale == Scale::Product ? 700 : 90));
}

std::array<float, 9> rowMajor(const Eigen::Quaterniond& rotation) {
    std::array<float, 9> out{};
    Eigen::Map<Eigen::Matrix<float, 3, 3, Eigen::RowMajor>>(out.data()) =
        rotation.toRotationMatrix().cast<float>();
    return out;
}

void turnedPoints(Context& c) {
    const CameraModel camera = c.hostile.camera(c.size(2, 120));
    const EpipolarLens whole(camera, 0);
    const double rim = std::sqrt(whole.lens().rim2) * c.hostile.real(0.5, 1);
    const simd::TurnedLens lens{whole.lens(), rowMajor(c.hostile.turn()), static_cast<float>(rim)};
    const std::size_t count = lengthOf(c);
    const Row raysX = rowOf(c, count, -2, 2, 0.02), raysY = rowOf(c, count, -2, 2, 0.02);
    Row x(count), y(count);
    simd::turnedPoints(lens, raysX.data(), raysY.data(), count, x.data(), y.data());
    for (std::size_t i = 0; i < count; ++i) {
        const auto p = test::turned(lens.turn, {raysX[i], raysY[i], 1});
        const double radius = std::hypot(p.x, p.y) / p.z;
        const bool isShown = p.z > 0.05 && p.z < 1e30 && radius < rim;
        // `rim` is the radius of the outermost visible ray. Near it, and near the least depth
        // 0.05, rounding decides whether a ray counts as shown.
        if (std::abs(radius / rim - 1) < 1e-3 || std::abs(p.z - 0.05) < 1e-3) continue;
        if (std::abs(p.z / 1e30 - 1) < 1e-3) continue;
        if (!isShown) {
            c.checks.within(x[i], -1e7, -1e5, "column of a ray that the source does not show");
            continue;
        }
        // The kernel rounds the rotated ray, divides by its z, and the lens may stretch the error.
        const double u = p.x / p.z, v = p.y / p.z;
        const double rounded =
            1e-6 * (std::abs(raysX[i]) + std::abs(raysY[i]) + 1) * (1 + radius) / p.z;
        const auto q = test::project(lens.lens, u, v);
        const auto further =
            test::project(lens.lens, u + std::copysign(rounded, u), v + std::copysign(rounded, v));
        const double slack = 1e-3 + 1e-5 * camera.fx + std::hypot(further.x - q.x, further.y - q.y);
        c.checks.within(x[i] - q.x, -slack, slack, "column of a turned ray");
        c.checks.within(y[i] - q.y, -slack, slack, "row of a turned ray");
    }
    c.checks.through("turnedPoints", static_cast<long>(count));
}

void turnedRow(Context& c) {
    Size size = c.size(2, 60);
    size = {std::max(size.width, 2), std::max(size.height, 2)};
    // The rows have no padding. So no byte behind the last pixel may be read.
    const LumaImage picture = c.hostile.luma(size);
    const std::size_t width = lengthOf(c), cells = width / simd::kTurnedCell + 2;
    const double right = size.width + 2, bottom = size.height + 2;
    const Row x = rowOf(c, cells, -3, right), y = rowOf(c, cells, -3, bottom);
    const Row nextX = rowOf(c, cells, -3, right), nextY = rowOf(c, cells, -3, bottom);
    const auto v = static_cast<float>(c.hostile.integer(0, 7)) / 8;
    std::vector<std::uint8_t> grey(width), seen(width);
    simd::turnedRow({picture.pixels.data(), size.width, size},
                    {x.data(), y.data(), nextX.data(), nextY.data()}, v, width, grey.data(),
                    seen.data());
    for (std::size_t i = 0; i < width; ++i) {
        const std::size_t cell = i / simd::kTurnedCell;
        const double u = static_cast<double>(i % simd::kTurnedCell) / simd::kTurnedCell;
        const auto at = [&](const Row& row, const Row& next) {
            return std::lerp(std::lerp(row[cell], next[cell], v),
                             std::lerp(row[cell + 1], next[cell + 1], v), u);
        };
        const double px = at(x, nextX), py = at(y, nextY);
        const double lastX = size.width - 1.0, lastY = size.height - 1.0;
        const double beyond = std::max({-0.5 - px, -0.5 - py, px - lastX - 0.5, py - lastY - 0.5});
        if (std::abs(beyond) > 0.01)
            c.checks.require(seen[i] == (beyond < 0 ? 1 : 0),
                             "the mark that tells whether the source shows a pixel is wrong");
        const double sx = std::clamp(px, 0.0, lastX), sy = std::clamp(py, 0.0, lastY);
        const int ix = std::min(static_cast<int>(sx), size.width - 2);
        const int iy = std::min(static_cast<int>(sy), size.height - 2);
        const std::uint8_t* p = &picture.pixels[static_cast<std::size_t>(iy) * size.width + ix];
        const double wanted =
            std::lerp(std::lerp(p[0], p[1], sx - ix),
                      std::lerp(p[size.width], p[size.width + 1], sx - ix), sy - iy);
        // Tolerance: the result is rounded, and the kernel clamps positions to 0.001 px before the
        // last column and row.
        c.checks.within(grey[i] - wanted, -1.1, 1.1, "error of a turned pixel [grey levels]");
    }
    c.checks.through("turnedRow", static_cast<long>(width));
}

/// Epipolar lines of a lens without distortion. The candidates (labels) of a pixel are whole pixels
/// apart along a row or a column, in either direction. So the costs of a pixel are known without
/// following the line. The pixel's foot is also known: the point of the line nearest to the pixel.
struct WholeLabels {
    simd::LabelLines lines{};
    Row raysX, raysY;
    /// For each pixel of the row, the pixel of the still (whose size is `canvas`) nearest to the
    /// point of label 0.
    std::vector<std::array<int, 2>> pixels;
    std::vector<double> feet;  ///< position of each pixel's foot (see above) on its line [labels]
    std::array<int, 2> way{};  ///< step per label [px]

    WholeLabels(Context& c, std::size_t count, Size canvas) {
        const double focal = c.hostile.integer(60, 120);
        lines.lens.fx = lines.lens.fy = static_cast<float>(focal);
        lines.lens.rim2 = 100;
        lines.originX = static_cast<float>(c.hostile.integer(-8, 8));
        lines.originY = static_cast<float>(c.hostile.integer(-8, 8));
        const int sign = c.hostile.pick({-1, 1});
        way = c.hostile.chance(0.5) ? std::array{sign, 0} : std::array{0, sign};
        const double s = 1 / 64.0;
        lines.perLabel = static_cast<float>(s);
        lines.tx = static_cast<float>(way[0] / (s * focal));
        lines.ty = static_cast<float>(way[1] / (s * focal));
        for (std::size_t i = 0; i < count; ++i) {
            const std::array at{c.hostile.integer(0, canvas.width - 1),
                                c.hostile.integer(0, canvas.height - 1)};
            const double foot = c.hostile.real(-0.4, 0.4), aside = c.hostile.real(-0.4, 0.4);
            const double x = at[0] - (way[0] != 0 ? foot * way[0] : aside);
            const double y = at[1] - (way[1] != 0 ? foot * way[1] : aside);
            raysX.push_back(static_cast<float>((x + lines.originX) / focal));
            raysY.push_back(static_cast<float>((y + lines.originY) / focal));
            pixels.push_back(at);
            feet.push_back(foot);
        }
    }
    [[nodiscard]] simd::LabelRow row() const { return {raysX.data(), raysY.data(), raysX.size()}; }
};

Valley valleyOf(Context& c) {
    Valley out{c.hostile.integer(-20, 20), {}};
    for (std::uint8_t& rise : out.rise)
        rise = static_cast<std::uint8_t>(c.hostile.chance(0.2) ? c.hostile.pick({0, 254, 255})
                                                               : c.hostile.integer(0, 60));
    return out;
}

/// Returns the expected result of labelVertices() minus the best label. The result is where two
/// lines with opposite slopes meet, which pass through the costs of this label and of its two
/// neighbours. Returns 0 if the three costs are equal or if a neighbour's cost is unknown.
double bottomOf(const Valley& v) {
    const int left = v.rise[1], right = v.rise[2], most = std::max(left, right);
    if (most == 0 || most == Valley::kUnknown) return 0;
    return 0.5 * (left - right) / most;
}

void labelPlaces(Context& c) {
    const std::size_t count = lengthOf(c);
    const WholeLabels labels(c, count, {100, 80});
    std::vector<Valley> valleys(count);
    std::ranges::generate(valleys, [&] { return valleyOf(c); });
    Row places(count), vertices(count);
    simd::labelPlaces(labels.lines, labels.row(), valleys.data(), places.data());
    simd::labelVertices(valleys.data(), count, vertices.data());
    for (std::size_t i = 0; i < count; ++i) {
        const double label = valleys[i].label, bottom = bottomOf(valleys[i]);
        c.checks.within(vertices[i] - label - bottom, -1e-4, 1e-4,
                        "error of the vertex of a cost valley [labels]");
        c.checks.within(places[i] - label - labels.feet[i] - bottom, -2e-3, 2e-3,
                        "error of a cost valley's position on its line");
    }
    c.checks.through("labelPlaces", static_cast<long>(count));
}

struct CensusCosts {
    Size size;
    std::vector<std::uint32_t> census;

    CensusCosts(Context& c, Size of) : size(of) {
        for (long i = pixelsOf(of); i > 0; --i)
            census.push_back(c.hostile.chance(0.1)
                                 ? simd::kNoCensus
                                 : static_cast<std::uint32_t>(c.hostile.generator()()) &
                                       ((1U << simd::kCensusBits) - 1));
    }
    [[nodiscard]] int at(int x, int y, std::uint32_t own) const {
        if (x < 0 || y < 0 || x >= size.width || y >= size.height) return simd::kCensusBits / 2;
        const std::uint32_t seen = census[static_cast<std::size_t>(y) * size.width + x];
        return seen == simd::kNoCensus ? simd::kCensusBits / 2 : std::popcount(own ^ seen);
    }
};

void labelCosts(Context& c) {
    const std::size_t count = lengthOf(c);
    const Size canvas{c.hostile.integer(1, 70), c.hostile.integer(1, 60)};
    const WholeLabels labels(c, count, canvas);
    const CensusCosts still(c, canvas);
    const int vectors = c.hostile.integer(1, 3);
    const bool slack = c.hostile.chance(0.5);
    std::vector<std::int16_t> base(count);
    for (auto& b : base)
        b = static_cast<std::int16_t>(c.hostile.integer(-40, 20));
    std::vector<std::uint32_t> own(count);
    for (auto& v : own)
        v = static_cast<std::uint32_t>(c.hostile.integer(0, (1 << simd::kCensusBits) - 1));
    const auto [dx, dy] = labels.way;
    const auto costs = static_cast<std::size_t>(simd::kLabels) * vectors;
    std::vector<std::uint8_t> got(costs * count);
    simd::labelCosts(labels.lines, labels.row(), base.data(), own.data(),
                     {still.census.data(), canvas}, vectors, slack, got.data());
    for (std::size_t i = 0; i < got.size(); ++i) {
        const std::size_t pixel = i / costs;
        const int label = base[pixel] + static_cast<int>(i % costs);
        const int x = labels.pixels[pixel][0] + label * dx;
        const int y = labels.pixels[pixel][1] + label * dy;
        int wanted = still.at(x, y, own[pixel]);
        for (const int side : {-1, 1})
            if (slack)
                wanted = std::min(wanted, still.at(x + side * dy, y + side * dx, own[pixel]));
        c.checks.require(got[i] == wanted, "a label's cost differs from its definition");
    }
    c.checks.through("labelCosts", static_cast<long>(count));
}

void landedRow(Context& c) {
    const CameraModel camera = c.hostile.camera(c.size(2, 120));
    const simd::Lens lens = EpipolarLens(camera, 0).lens();
    const RigidTransform T = c.hostile.gentle();
    const simd::Motion motion{rowMajor(T.rotation), {0.4F, -0.2F, 0.3F}};
    const std::size_t count = lengthOf(c);
    const double reach = 0.5 * std::sqrt(lens.rim2);
    const Row x = rowOf(c, count, -reach, reach), y = rowOf(c, count, -reach, reach);
    const Row s = rowOf(c, count, -0.2, 0.6, 0.05);
    std::vector<std::int32_t> landing(count);
    simd::landRow(lens, camera.size, motion, x.data(), y.data(), s.data(), count, landing.data());
    for (std::size_t i = 0; i < count; ++i) {
        const long last = pixelsOf(camera.size) - 1;
        c.checks.within(landing[i], -1, static_cast<double>(last),
                        "index of the pixel onto which a pixel is projected");
        if (std::isnan(s[i]))
            c.checks.require(landing[i] == -1,
                             "a pixel of unknown depth is projected onto another");
        if (!(std::abs(s[i]) < 1)) continue;
        const auto& [tx, ty, tz] = motion.move;
        const auto p = test::turned(
            motion.turn, {x[i] + s[i] * (tx - x[i] * tz), y[i] + s[i] * (ty - y[i] * tz), 1});
        const double u = p.x / p.z, v = p.y / p.z;
        if (p.z < 0.06 || u * u + v * v > 0.99 * lens.rim2) continue;
        const auto q = test::project(lens, u, v);
        if (test::isBetween(q.x) || test::isBetween(q.y)) continue;
        const int column = static_cast<int>(std::floor(q.x + 0.5));
        const int row = static_cast<int>(std::floor(q.y + 0.5));
        const bool inside =
            q.x > -0.5 && q.y > -0.5 && column < camera.size.width && row < camera.size.height;
        c.checks.require(landing[i] == (inside ? row * camera.size.width + column : -1),
                         "a pixel is projected onto a wrong pixel");
    }
    c.checks.through("landRow", static_cast<long>(count));
}

void measuredRow(Context& c) {
    const simd::MeasureRule rule{{static_cast<float>(c.hostile.real(-1, 1)),
                                  static_cast<float>(c.hostile.real(-1, 1)),
                                  static_cast<float>(c.hostile.real(-1, 1))},
                                 0.05F,
                                 0.05F,
                                 0.003F,
                                 static_cast<float>(c.hostile.logarithmic(1e-3, 1e3))};
    const std::size_t count = lengthOf(c);
    const Row raysX = rowOf(c, count, -1, 1), raysY = rowOf(c, count, -1, 1);
    const Row s = rowOf(c, count, -0.5, 3, 0.05), nearest = rowOf(c, 16, -0.5, 3);
    std::vector<std::int32_t> landing(count);
    for (auto& to : landing)
        to = c.hostile.integer(-1, 15);
    Row inverseDepth(count), variance(count);
    simd::measureRow({raysX.data(), raysY.data(), s.data(), landing.data(), nearest.data()}, rule,
                     count, inverseDepth.data(), variance.data());
    for (std::size_t i = 0; i < count; ++i) {
        const double depth = 1 - static_cast<double>(s[i]) * rule.t[2];
        const double over =
            landing[i] < 0 ? -1.0 : static_cast<double>(s[i]) + rule.slack - nearest[landing[i]];
        if (std::abs(over) < 1e-5 || std::abs(depth - rule.leastDepth) < 1e-3) continue;
        if (!(over > 0 && depth > rule.leastDepth)) {
            c.checks.require(inverseDepth[i] == 0, "unknown inverse depth is not 0");
            c.checks.require(variance[i] == std::numeric_limits<float>::infinity(),
                             "variance of unknown depth is not infinite");
            continue;
        }
        if (!(std::abs(s[i]) < 10)) continue;
        const double way =
            std::hypot(rule.t[0] - raysX[i] * rule.t[2], rule.t[1] - raysY[i] * rule.t[2]);
        if (way < 1e-2) continue;
        const double sigma = rule.error / way / (depth * depth) * rule.perUnit;
        const double wanted = std::max(s[i] / depth * rule.perUnit, 0.0);
        c.checks.within(inverseDepth[i] - wanted, -1e-4 * (rule.perUnit + wanted),
                        1e-4 * (rule.perUnit + wanted), "measured inverse depth");
        c.checks.within(variance[i] / (sigma * sigma), 0.998, 1.002, "measured variance");
    }
    c.checks.through("measureRow", static_cast<long>(count));
}

}  // namespace

std::vector<Case> rowCases() {
    return {{"turned-points", turnedPoints, true}, {"turned-row", turnedRow, true},
            {"label-places", labelPlaces, true},   {"label-costs", labelCosts, true},
            {"landed-row", landedRow, true},       {"measured-row", measuredRow, true}};
}

}  // namespace mfar::stress
