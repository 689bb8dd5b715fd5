#include "pipeline/pipeline.h"
#include "tests/stability/cases.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace mfar::stress {
namespace {

double medianErrorOf(const std::vector<float>& flow, Size size, const Eigen::Vector2d& shift) {
    constexpr int kBorder = 24;
    std::vector<double> errors;
    for (int y = kBorder; y < size.height - kBorder; ++y)
        for (int x = kBorder; x < size.width - kBorder; ++x) {
            const std::size_t i = 2 * (static_cast<std::size_t>(y) * size.width + x);
            errors.push_back(std::hypot(flow[i] - shift.x(), flow[i + 1] - shift.y()));
        }
    std::sort(errors.begin(), errors.end());
    return errors[errors.size() / 2];
}

void checkFlow(Context& c, const std::vector<float>& flow, Size size) {
    c.checks.require(flow.size() == 2UL * size.width * size.height,
                     "the flow has a wrong number of vectors");
    for (const float v : flow)
        c.checks.within(v, -2e4, 2e4, "component of a flow vector [px]");
    c.gl.frame(c.checks, pixelsOf(size));
}

void hostileFlow(Context& c) {
    const Size size = c.size(16, 200);
    const TestPicture a = c.hostile.picture(size);
    const TestPicture b =
        c.hostile.picture(size, c.hostile.chance(0.3) ? PixelFormat::Gray8 : PixelFormat::Rgba8);
    checkFlow(c, flowBetween(a.view(), b.view()), size);
}

// The flow from a picture to itself must be zero, whatever the picture shows.
void samePicture(Context& c) {
    const Size size = c.hostile.size(16, 150);
    const TestPicture a = c.hostile.picture(size);
    const auto flow = flowBetween(a.view(), a.view());
    checkFlow(c, flow, size);
    for (const float v : flow)
        c.checks.within(v, -0.02, 0.02, "flow of a picture to itself");
}

TestPicture mirrored(const TestPicture& p) {
    TestPicture out = p;
    for (int y = 0; y < p.size.height; ++y)
        for (int x = 0; x < p.size.width; ++x) {
            const std::size_t from =
                4 * (static_cast<std::size_t>(y) * p.size.width + p.size.width - 1 - x);
            std::copy_n(p.bytes.begin() + static_cast<std::ptrdiff_t>(from), 4, out.at(x, y));
        }
    return out;
}

// A shift within the reach of the search and of sub-pixel steps must be found, also if the two
// pictures are exchanged or mirrored.
void shiftedPicture(Context& c) {
    const Size size = c.size(101, 180);
    const Waves waves(static_cast<unsigned>(c.hostile.integer(1, 1 << 30)), 6, 60, 35);
    const Eigen::Vector2d shift(c.hostile.real(-6, 6), c.hostile.real(-6, 6));
    const double gain = c.hostile.real(0.6, 1.2), offset = c.hostile.real(-15, 15);
    const TestPicture a = waves.shoot(size, {});
    const TestPicture b = waves.shoot(size, {.shift = -shift, .gain = gain, .offset = offset});
    const auto there = flowBetween(a.view(), b.view());
    checkFlow(c, there, size);
    c.checks.within(medianErrorOf(there, size, shift), 0, 0.08, "error of a shift [px]");
    const auto back = flowBetween(b.view(), a.view());
    checkFlow(c, back, size);
    c.checks.within(medianErrorOf(back, size, -shift), 0, 0.08,
                    "error of a shift with exchanged pictures [px]");
    const auto mirror = flowBetween(mirrored(a).view(), mirrored(b).view());
    checkFlow(c, mirror, size);
    c.checks.within(medianErrorOf(mirror, size, {-shift.x(), shift.y()}), 0, 0.08,
                    "error of a shift of mirrored pictures [px]");
}

}  // namespace

std::vector<Case> flowCases() {
    return {{"flow2d", hostileFlow, true},
            {"flow2d-same", samePicture},
            {"flow2d-shift", shiftedPicture}};
}

}  // namespace mfar::stress
