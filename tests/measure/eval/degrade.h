#pragma once

#include <opencv2/core.hpp>

#include <cstdint>
#include <string>

namespace mfar::eval {

/// Degradation of a picture, in the order of a real sensor: blur (lens), gain (exposure), gamma
/// (tone curve), noise (read-out).
struct Degradation {
    double gain = 1;   ///< factor of the pixel value, > 0
    double gamma = 1;  ///< exponent > 0: v -> v^gamma for pixel values v scaled to [0, 1]
    double blur = 0;   ///< standard deviation of a Gaussian [px], >= 0
    double noise = 0;  ///< standard deviation of white noise in each channel [grey levels], >= 0
    bool operator==(const Degradation&) const = default;
};

/// Parses a text like "gain=0.7,gamma=1.3,blur=0.7,noise=4". Parts may be missing or in another
/// order. Throws std::invalid_argument that names the faulty part.
[[nodiscard]] Degradation parseDegradation(const std::string& text,
                                           const std::string& option = "--degrade");

/// Returns a degraded copy of an 8-bit picture. Equal seeds give equal noise.
[[nodiscard]] cv::Mat degrade(const cv::Mat& picture, const Degradation& how, std::uint64_t seed);

}  // namespace mfar::eval
