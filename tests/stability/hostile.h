#pragma once

#include "base/geometry.h"
#include "base/se3.h"
#include "pipeline/flow/luma_image.h"
#include "tests/engine/pictures.h"

#include <array>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <vector>

namespace mfar::stress {

/// Makes random hostile inputs (extreme or invalid values), which depend only on the seed.
class Hostile {
public:
    explicit Hostile(std::uint64_t seed) : random_(seed) {}

    [[nodiscard]] int integer(int low, int high);  ///< `low` and `high` are included
    [[nodiscard]] double real(double low, double high);
    [[nodiscard]] double logarithmic(double low, double high);
    [[nodiscard]] bool chance(double probability) { return real(0, 1) < probability; }
    template <class T>
    [[nodiscard]] T pick(std::initializer_list<T> of) {
        return of.begin()[integer(0, static_cast<int>(of.size()) - 1)];
    }

    /// Returns a size such as 1x1, 1xN, with primes, or near a multiple of the tile size. Each side
    /// is from `least` to `most`.
    [[nodiscard]] Size size(int least, int most);
    /// Returns NaN, an infinity or one of extreme().
    [[nodiscard]] double bad();
    /// Returns a zero, a denormal, the largest or smallest float, or a huge or tiny number.
    [[nodiscard]] double extreme();

    /// A picture of a random pattern: constant, saturated, a checkerboard, columns at the Nyquist
    /// frequency, an impulse, noise, a ramp, or waves with usual or extreme gain.
    [[nodiscard]] TestPicture picture(Size size, PixelFormat format = PixelFormat::Rgba8);
    [[nodiscard]] LumaImage luma(Size size);

    /// A lens for a picture of this size, from undistorted to strong barrel or pincushion
    /// distortion. Its principal point is off-centre.
    [[nodiscard]] CameraModel camera(Size size);
    [[nodiscard]] Eigen::Vector3d direction();
    [[nodiscard]] Eigen::Quaterniond turn();
    /// A motion with small or large rotation. The translation leads sideways, forwards or
    /// backwards; its length is 0 to 1160 times `unit`. The epipole may be in the picture, at its
    /// border or near it.
    [[nodiscard]] RigidTransform motion(double unit = 1);
    /// A motion with a rotation of at most 0.08 rad and a translation of 0.01 to 0.3 times `unit`.
    [[nodiscard]] RigidTransform gentle(double unit = 1);
    /// Returns `T` with an invalid or extreme number, rotation or translation.
    [[nodiscard]] RigidTransform spoilt(RigidTransform T);
    [[nodiscard]] Matrix6 covariance();

    [[nodiscard]] std::mt19937_64& generator() { return random_; }

private:
    [[nodiscard]] int greyAt(int kind, int x, int y, Size size, int level);

    std::mt19937_64 random_;
};

}  // namespace mfar::stress
