#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Thresholds for samples of real depth, from CompositeOptions [standard deviations of the sample].
struct SampleBounds {
    float bias;
    float hidden;  ///< bias + softness
};

/// A row of real depth and of the video's colours, at the video's resolution.
struct SampleSource {
    /// Inverse depth and its standard deviation [1/m]; with `squared`, its variance.
    const float *inverse, *sigma;
    bool squared;
    const std::uint8_t *red, *green, *blue;
};

/// A row of SampleSource in single precision, prepared for weighing. A virtual pixel is certainly
/// in front of the sample if its inverse depth exceeds `nearest`. It is certainly behind the sample
/// if its inverse depth is less than `farthest`. Both are 0 for an unknown pixel, whose `inverse`
/// is so small that the pixel occludes nothing.
struct SampleRow {
    float *inverse, *variance, *red, *green, *blue;
    float *nearest, *farthest;
};

/// Prepares pixels [first, last). A pixel is unknown unless its inverse depth and sigma are finite
/// and positive.
void prepareSamples(const SampleSource& from, const SampleBounds& bounds, int first, int last,
                    const SampleRow& to);

/// Replaces nearest[i] by the largest of nearest[i] to nearest[i + 3], and farthest[i] by the
/// smallest of farthest[i] to farthest[i + 3].
void spreadSamples(float* nearest, float* farthest, int count);

/// Four rows that spreadSamples() has processed. rangeOfSamples() writes the largest `nearest` of
/// each column to `greatest`, and the smallest `farthest` to `least`.
struct FourRows {
    const float* row[4];
};
void rangeOfSamples(const FourRows& nearest, const FourRows& farthest, int count, float* greatest,
                    float* least);

}  // namespace mfar::simd
