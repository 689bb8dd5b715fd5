#pragma once

#include <opencv2/core.hpp>

#include <cstdint>
#include <string>

namespace mfar::eval {

/// How the recorded still is degraded. The steps follow the order of a real sensor: blur (lens),
/// gain (exposure), gamma (tone curve), noise (read-out).
struct Degradation {
    double gain = 1;   ///< factor by which the pixel value is multiplied, > 0
    double gamma = 1;  ///< v -> v^gamma with v in [0, 1], > 0
    double blur = 0;   ///< sigma of a Gaussian [still px], >= 0
    double noise = 0;  ///< sigma of white noise, independent in each channel [grey levels], >= 0
    bool operator==(const Degradation&) const = default;
};

/// Parses a text like "gain=0.7,gamma=1.3,blur=0.7,noise=4": any subset, in any order. An empty
/// text means no degradation. Throws std::invalid_argument that names the faulty part.
[[nodiscard]] Degradation parseDegradation(const std::string& text,
                                           const std::string& option = "--degrade");

/// A degraded copy of an 8-bit picture. Equal seeds give equal noise.
[[nodiscard]] cv::Mat degrade(const cv::Mat& picture, const Degradation& how, std::uint64_t seed);

}  // namespace mfar::eval
