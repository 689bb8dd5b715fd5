#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Thresholds for samples of real depth, from CompositeOptions.
struct SampleBounds {
    float bias;    ///< CompositeOptions::bias [standard deviations of the sample]
    float hidden;  ///< bias + softness [standard deviations of the sample]
};

/// A row of real depth, and of the picture that it belongs to, at the video's resolution.
struct SampleSource {
    const float *inverse, *sigma;  ///< inverse depth and its standard deviation [1/m]
    bool squared;                  ///< true: `sigma` holds variances instead
    const std::uint8_t *red, *green, *blue;
};

/// A row of SampleSource in single precision, prepared for weighing. `inverse` of an unknown pixel
/// is so small that the pixel occludes nothing. A virtual pixel with more inverse depth than
/// `nearest` is certainly in front of the sample; one with less than `farthest` is certainly behind
/// it. `nearest` and `farthest` are 0 for an unknown pixel.
struct SampleRow {
    float *inverse, *variance, *red, *green, *blue;
    float *nearest, *farthest;
};

/// Prepares pixels [first, last). A pixel is unknown unless its inverse depth and sigma are finite
/// and positive.
void prepareSamples(const SampleSource& from, const SampleBounds& bounds, int first, int last,
                    const SampleRow& to);

/// Replaces entry i of `nearest` by the largest of entries i to i + 3, and entry i of `farthest` by
/// the smallest of entries i to i + 3.
void spreadSamples(float* nearest, float* farthest, int count);

/// Four rows that spreadSamples() has processed. rangeOfSamples() writes the largest value of each
/// column of `nearest` to `greatest`, and the smallest value of each column of `farthest` to
/// `least`.
struct FourRows {
    const float* row[4];
};
void rangeOfSamples(const FourRows& nearest, const FourRows& farthest, int count, float* greatest,
                    float* least);

}  // namespace mfar::simd
