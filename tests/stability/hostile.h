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

/// Draws hostile inputs, each a function of the seed alone.
class Hostile {
public:
    explicit Hostile(std::uint64_t seed) : random_(seed) {}

    [[nodiscard]] int integer(int low, int high);  ///< both limits included
    [[nodiscard]] double real(double low, double high);
    [[nodiscard]] double logarithmic(double low, double high);
    [[nodiscard]] bool chance(double probability) { return real(0, 1) < probability; }
    template <class T>
    [[nodiscard]] T pick(std::initializer_list<T> of) {
        return of.begin()[integer(0, static_cast<int>(of.size()) - 1)];
    }

    /// 1x1, 1xN, primes, near multiples of the tile, up to about `most` in each direction.
    [[nodiscard]] Size size(int least, int most);
    /// NaN, infinities, the ends of float's range, denormals, zeros.
    [[nodiscard]] double bad();
    /// The same without NaN and infinities.
    [[nodiscard]] double extreme();

    /// Constant, saturated, checkerboard and columns at Nyquist, impulse, noise, extreme gain,
    /// ramp, photograph-like.
    [[nodiscard]] TestPicture picture(Size size, PixelFormat format = PixelFormat::Rgba8);
    [[nodiscard]] LumaImage luma(Size size);

    /// A lens for such a picture: undistorted to strong barrel or pincushion distortion, off
    /// centre.
    [[nodiscard]] CameraModel camera(Size size);
    [[nodiscard]] Eigen::Vector3d direction();
    /// Rotations from zero to all orientations.
    [[nodiscard]] Eigen::Quaterniond turn();
    /// Small and large rotations; translations from zero to a thousand units sideways, forwards,
    /// backwards; with the epipole in, on and near the border.
    [[nodiscard]] RigidTransform motion(double unit = 1);
    /// A small motion, as of a hand-held camera.
    [[nodiscard]] RigidTransform gentle(double unit = 1);
    /// With an invalid number in one place, or an invalid rotation.
    [[nodiscard]] RigidTransform spoilt(RigidTransform T);
    [[nodiscard]] Matrix6 covariance();

    [[nodiscard]] std::mt19937_64& generator() { return random_; }

private:
    [[nodiscard]] int greyAt(int kind, int x, int y, Size size, int level);

    std::mt19937_64 random_;
};

}  // namespace mfar::stress
