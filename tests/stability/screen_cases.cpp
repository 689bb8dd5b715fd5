#include "hal/device/display_scaler.h"
#include "tests/oracle/area_mean.h"
#include "tests/stability/cases.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace mfar::stress {
namespace {

// Largest error of a pixel that the GPU scales. A GPU interpolates between two pixels with at least
// 8 bits: this loses up to one grey level along x and one along y. Rounding adds half a grey level.
constexpr double kSampling = 2.5;  // [grey levels]

Size sizeFor(Context& c, Size screen) {
    const auto side = [&](int pixels) {
        const double times = c.hostile.pick({1.0, c.hostile.real(0.2, 1), c.hostile.real(1, 4)});
        return std::max(1, static_cast<int>(std::lround(pixels * times)));
    };
    return {side(screen.width), side(screen.height)};
}

// Checks the picture that the host scales. An error of one grey level is allowed, because the host
// rounds weights to 16 bits and truncates their products.
void onTheHost(Context& c, const TestPicture& picture, Size screen, const ScreenRect& to) {
    AlignedRows<std::uint32_t> rows(picture.size);
    for (int y = 0; y < picture.size.height; ++y)
        std::memcpy(rows[y], &picture.bytes[std::size_t{4} * y * picture.size.width],
                    std::size_t{4} * picture.size.width);
    HostScaler scaler(screen);
    const Rows<const std::uint32_t> shown = scaler.scaled(rows.rows());
    const auto colour = [&](int x, int y) {
        const std::uint32_t p = rows[y][x];
        return std::array<int, 3>{int(p & 255), int(p >> 8 & 255), int(p >> 16 & 255)};
    };
    for (int y = 0; y < to.size.height; ++y)
        for (int x = 0; x < to.size.width; ++x) {
            const auto wanted = twin::scaledPixel(picture.size, colour, to, x, y);
            const std::uint32_t got = shown[y + to.y][x + to.x];
            for (std::size_t k = 0; k < 3; ++k)
                c.checks.within((got >> (8 * k) & 255) - wanted[k], -1, 1,
                                "error of a pixel that the host scales");
        }
}

// Each screen pixel must be the mean of the area that it covers. The screen outside the picture
// must be black.
void screens(Context& c) {
    const Size screen = c.size(1, 120), size = sizeFor(c, screen);
    const TestPicture picture = c.hostile.picture(size);
    const gpu::Texture texture = uploaded(picture);
    ScreenScaler scaler;
    ScreenReader reader(screen, scaler);
    reader.begin(GlImage{texture.id(), size});
    const ScreenPicture shown = reader.last();
    const ScreenRect to = letterbox(size, screen);
    const auto colour = [&](int x, int y) {
        const auto* p = &picture.bytes[4 * (static_cast<std::size_t>(y) * size.width + x)];
        return std::array<int, 3>{p[0], p[1], p[2]};
    };
    for (int y = 0; y < screen.height; ++y)
        for (int x = 0; x < screen.width; ++x) {
            const int u = x - to.x, v = y - to.y;
            const bool inside = u >= 0 && v >= 0 && u < to.size.width && v < to.size.height;
            const auto wanted =
                inside ? twin::scaledPixel(size, colour, to, u, v) : std::array<double, 3>{};
            const auto* got = &shown.pixels[4 * (static_cast<std::size_t>(y) * screen.width + x)];
            for (std::size_t k = 0; k < 3; ++k)
                c.checks.within(got[2 - k] - wanted[k], -kSampling, kSampling,
                                "error of a pixel on the screen");
        }
    onTheHost(c, picture, screen, to);
    c.checks.through("display_scale.frag", pixelsOf(screen));
    c.gl.frame(c.checks, pixelsOf(screen));
}

}  // namespace

std::vector<Case> screenCases() {
    return {{"screen", screens, true}};
}

}  // namespace mfar::stress
