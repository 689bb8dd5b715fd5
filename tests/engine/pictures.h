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

/// How a picture is taken from a pattern: pixel (x, y) shows the pattern around
/// ((x, y) + 0.5) step - 0.5 + shift, averaged over a square of `footprint` pattern units.
struct Shot {
    double step = 1;
    Eigen::Vector2d shift{0, 0};
    double footprint = 1;
    double gain = 1, offset = 0;  ///< of the grey levels
    PixelFormat format = PixelFormat::Rgba8;
};

/// A random pattern that is known at every position: a sum of plane waves, in grey levels. The
/// wavelengths are spread evenly in their logarithm.
class Waves {
public:
    /// Wavelengths in pattern units; contrast = standard deviation [grey levels].
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
/// One pixel black, one white.
[[nodiscard]] TestPicture checkerboard(Size size);
/// Adds the same Gaussian noise to all channels of each pixel.
void addNoise(TestPicture& picture, double sigma, unsigned seed);
/// Root of the mean squared difference, turned into decibels against 255.
[[nodiscard]] double psnr(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b);

/// Two ideal cameras at the same place: the still is the video's view at another resolution.
[[nodiscard]] StereoRig plainRig(Size video, Size still);
/// Two different lenses, rotated by some degrees against each other.
[[nodiscard]] StereoRig bentRig(Size video, Size still);

[[nodiscard]] gpu::Texture uploaded(const TestPicture& p, gpu::Filter f = gpu::Filter::Nearest);
[[nodiscard]] RgbPlanes planesOf(const TestPicture& p);
/// What shaders sample, swizzled as it is: RGBA8.
[[nodiscard]] std::vector<std::uint8_t> sampled(const gpu::Texture& texture);
/// Four floats a texel.
[[nodiscard]] gpu::Texture floatTexture(Size size, gpu::TexelFormat format,
                                        const std::vector<float>& values,
                                        gpu::Filter f = gpu::Filter::Nearest);

}  // namespace mfar
