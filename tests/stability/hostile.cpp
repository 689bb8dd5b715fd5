#include "tests/stability/hostile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mfar::stress {
namespace {

using Limits = std::numeric_limits<float>;

constexpr int kPatterns = 9;

}  // namespace

int Hostile::integer(int low, int high) {
    const auto span = static_cast<std::uint64_t>(high - low) + 1;
    return low + static_cast<int>(random_() % span);
}

double Hostile::real(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
}

double Hostile::logarithmic(double low, double high) {
    return std::exp(real(std::log(low), std::log(high)));
}

Size Hostile::size(int least, int most) {
    const auto side = [&] {
        const int odd = pick({1, 2, 3, 7, 13, 15, 16, 17, 31, 37, 61, 64, 97, 113, 127, 129, 239});
        const int any = chance(0.5) ? odd : integer(least, most);
        return std::clamp(any, least, most);
    };
    const int width = side();
    return {width, side()};
}

double Hostile::bad() {
    if (!chance(0.5)) return extreme();
    return pick<double>({Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()});
}

double Hostile::extreme() {
    return pick<double>({Limits::max(), -Limits::max(), Limits::min(), Limits::denorm_min(),
                         -Limits::denorm_min(), 0.0, -0.0, 1e30, -1e30, 1e9, -1e9, 1e-30});
}

int Hostile::greyAt(int kind, int x, int y, Size size, int level) {
    switch (kind) {
    case 0: return level;
    case 1: return 255;
    case 2: return (x + y) % 2 * 255;
    case 3: return x % 2 * 255;
    case 4: return x == size.width / 2 && y == size.height / 2 ? 255 : 0;
    case 5: return chance(0.5) ? 255 : 0;
    case 6: return integer(0, 255);
    case 7: return 255 * x / size.width;
    default: return x / 8 % 2 == y / 8 % 2 ? level : 255 - level;
    }
}

TestPicture Hostile::picture(Size size, PixelFormat format) {
    const int kind = integer(0, kPatterns), level = integer(0, 255);
    if (kind == kPatterns) {
        const double gain = pick({0.05, 1.0, 1.0, 30.0});
        const Waves waves(static_cast<unsigned>(random_()), 2, 40, 40, 24);
        return waves.shoot(size, {.shift = {real(0, 50), real(0, 50)},
                                  .gain = gain,
                                  .offset = 128 * (1 - gain),
                                  .format = format});
    }
    TestPicture out(size, format, 255);
    const int channels = std::min(bytesPerPixel(format), 3);
    const bool grey = chance(0.7);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const int value = greyAt(kind, x, y, size, level);
            for (int c = 0; c < channels; ++c)
                out.at(x, y)[c] = static_cast<std::uint8_t>(grey || c == 0 ? value : 255 - value);
        }
    return out;
}

LumaImage Hostile::luma(Size size) {
    LumaImage out(size);
    out.pixels = picture(size, PixelFormat::Gray8).bytes;
    return out;
}

CameraModel Hostile::camera(Size size) {
    CameraModel c;
    c.size = size;
    const double side = std::max(size.width, size.height);
    c.fx = side * logarithmic(0.5, 3);
    c.fy = c.fx * real(0.9, 1.1);
    c.cx = 0.5 * (size.width - 1) + side * real(-0.1, 0.1);
    c.cy = 0.5 * (size.height - 1) + side * real(-0.1, 0.1);
    const int kind = integer(0, 2);
    if (kind == 1) c.distortion = {-0.3, 0.09, 0.001, -0.002, 0};
    if (kind == 2)
        c.distortion = {real(-0.15, 0.15), real(-0.03, 0.03), real(-2e-3, 2e-3), real(-2e-3, 2e-3),
                        real(-5e-3, 5e-3)};
    return c;
}

Eigen::Vector3d Hostile::direction() {
    Eigen::Vector3d v;
    do {
        v = {real(-1, 1), real(-1, 1), real(-1, 1)};
    } while (!(v.norm() > 1e-3 && v.norm() < 1));
    return v.normalized();
}

Eigen::Quaterniond Hostile::turn() {
    const double angle = pick({0.0, 1e-9, 1e-4, 0.01, 0.1, 0.5, 1.57, 3.1, std::numbers::pi});
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle * real(0.5, 1), direction()));
}

RigidTransform Hostile::motion(double unit) {
    RigidTransform T{turn(), Eigen::Vector3d::Zero()};
    const Eigen::Vector3d axes[] = {direction(),   {1, 0, 0},    {0, -1, 0},
                                    {0, 0, 1},     {0, 0, -1},   {0.5, 0.3, 1},
                                    {0.5, 0, 1.0}, {1e-7, 0, 1}, {1, 0, 1e-6}};
    const double length = pick({0.0, 1e-12, 1e-6, 0.01, 0.1, 0.3, 1.0, 30.0, 1000.0});
    T.translation = unit * length * axes[integer(0, 8)];
    return T;
}

RigidTransform Hostile::gentle(double unit) {
    const Eigen::AngleAxisd turned(real(0, 0.08), direction());
    return {Eigen::Quaterniond(turned), unit * real(0.01, 0.3) * direction()};
}

RigidTransform Hostile::spoilt(RigidTransform T) {
    switch (integer(0, 4)) {
    case 0: T.translation[integer(0, 2)] = bad(); break;
    case 1: T.rotation.coeffs()[integer(0, 3)] = bad(); break;
    case 2: T.rotation.coeffs() *= pick({0.0, 1e-20, 0.9, 1.001, 1.3, 1e20}); break;
    case 3: T.translation *= pick({1e30, 1e-30, 1e300}); break;
    default: T.rotation.coeffs().setConstant(bad()); break;
    }
    return T;
}

Matrix6 Hostile::covariance() {
    Matrix6 out = Matrix6::Zero();
    if (chance(0.3)) return out;
    const double scale = logarithmic(1e-12, 1);
    out.diagonal().setConstant(scale);
    if (chance(0.1)) out(integer(0, 5), integer(0, 5)) = bad();
    return out;
}

}  // namespace mfar::stress
