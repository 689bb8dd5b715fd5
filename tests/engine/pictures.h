#pragma once

#include "base/geometry.h"
#include "base/gl/texture.h"
#include "pipeline/plan/rgb_planes.h"
#include "tests/oracle/picture.h"

#include <Eigen/Core>

#include <cstdint>
#include <random>
#include <vector>

namespace mfar {

/// Defines how a pattern is sampled. Pixel (x, y) is the mean over a square with a side of
/// `footprint` pattern units around ((x, y) + 0.5) step - 0.5 + shift.
struct Shot {
    double step = 1;
    Eigen::Vector2d shift{0, 0};
    double footprint = 1;
    double gain = 1, offset = 0;
    PixelFormat format = PixelFormat::Rgba8;
};

/// A random pattern that is known at every position: a sum of plane waves, in grey levels. The
/// logarithms of their wavelengths are uniformly distributed.
class Waves {
public:
    /// `shortest`, `longest`: wavelengths [pattern units]. `contrast`: standard deviation [grey
    /// levels].
    Waves(unsigned seed, double shortest, double longest, double contrast, int count = 48);
    [[nodiscard]] TestPicture shoot(Size size, const Shot& shot) const;

private:
    struct Wave {
        double kx, ky, phase, amplitude;
    };
    std::vector<Wave> waves_;
};

[[nodiscard]] TestPicture randomPicture(Size size, unsigned seed,
                                        PixelFormat f = PixelFormat::Rgba8);
[[nodiscard]] TestPicture checkerboard(Size size);
/// Adds Gaussian noise. All channels of a pixel get the same noise.
void addNoise(TestPicture& picture, double sigma, unsigned seed);
/// Peak signal-to-noise ratio for a peak of 255 [dB].
[[nodiscard]] double psnr(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b);

[[nodiscard]] StereoRig plainRig(Size video, Size still);
/// Two cameras with different lens distortion, rotated against each other by 1.7 degrees.
[[nodiscard]] StereoRig bentRig(Size video, Size still);

[[nodiscard]] gpu::Texture uploaded(const TestPicture& p, gpu::Filter f = gpu::Filter::Nearest);
[[nodiscard]] RgbPlanes planesOf(const TestPicture& p);
/// The values that a shader gets when it samples the texture, as RGBA8. The texture's swizzle is
/// applied.
[[nodiscard]] std::vector<std::uint8_t> sampled(const gpu::Texture& texture);
[[nodiscard]] gpu::Texture floatTexture(Size size, gpu::TexelFormat format,
                                        const std::vector<float>& values,
                                        gpu::Filter f = gpu::Filter::Nearest);

}  // namespace mfar
