#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Thresholds for samples of real depth, from CompositeOptions.
struct SampleBounds {
    float bias;    ///< [sigmas]
    float hidden;  ///< bias and softness together [sigmas]
};

/// A row of real depth, and of the picture that it belongs to, at the video's resolution.
struct SampleSource {
    const float *inverse, *sigma;  ///< [1/m]
    bool squared;                  ///< `sigma` holds variances
    const std::uint8_t *red, *green, *blue;
};

/// The same row in single precision, prepared for weighing. `inverse` of an unknown pixel is so
/// small that the pixel occludes nothing. A virtual pixel with more inverse depth than `nearest` is
/// certainly in front of the sample; one with less than `farthest` is certainly behind it. Both are
/// 0 for an unknown pixel.
struct SampleRow {
    float *inverse, *variance, *red, *green, *blue;
    float *nearest, *farthest;
};

/// Prepares pixels [first, last). A pixel is unknown unless its inverse depth and sigma are finite
/// and positive.
void prepareSamples(const SampleSource& from, const SampleBounds& bounds, int first, int last,
                    const SampleRow& to);

/// Works in place: entry i becomes the largest (of `farthest`: the smallest) of entries i to i + 3.
void spreadSamples(float* nearest, float* farthest, int count);

/// Computes the largest and smallest value of each column over four rows of spreadSamples().
struct FourRows {
    const float* row[4];
};
void rangeOfSamples(const FourRows& nearest, const FourRows& farthest, int count, float* greatest,
                    float* least);

}  // namespace mfar::simd
