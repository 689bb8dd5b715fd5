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

/// Sampling of a pattern: pixel (x, y) shows the pattern around ((x, y) + 0.5) step - 0.5 + shift,
/// averaged over a square of `footprint` pattern units.
struct Shot {
    double step = 1;
    Eigen::Vector2d shift{0, 0};
    double footprint = 1;
    double gain = 1, offset = 0;  ///< of the grey levels
    PixelFormat format = PixelFormat::Rgba8;
};

/// A random pattern with known values at every position: a sum of plane waves, in grey levels.
/// Wavelengths are distributed uniformly in the logarithm.
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
/// Alternating black and white pixels.
[[nodiscard]] TestPicture checkerboard(Size size);
/// Adds the same Gaussian noise to all channels of each pixel.
void addNoise(TestPicture& picture, double sigma, unsigned seed);
/// Peak signal-to-noise ratio [dB] for a peak of 255.
[[nodiscard]] double psnr(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b);

/// Two ideal cameras at the same place: the still shows the video's view at another resolution.
[[nodiscard]] StereoRig plainRig(Size video, Size still);
/// Two different lenses, rotated by some degrees relative to each other.
[[nodiscard]] StereoRig bentRig(Size video, Size still);

[[nodiscard]] gpu::Texture uploaded(const TestPicture& p, gpu::Filter f = gpu::Filter::Nearest);
[[nodiscard]] RgbPlanes planesOf(const TestPicture& p);
/// The values that shaders sample, including the swizzle: RGBA8.
[[nodiscard]] std::vector<std::uint8_t> sampled(const gpu::Texture& texture);
/// A texture from four floats a texel.
[[nodiscard]] gpu::Texture floatTexture(Size size, gpu::TexelFormat format,
                                        const std::vector<float>& values,
                                        gpu::Filter f = gpu::Filter::Nearest);

}  // namespace mfar
