#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// The comparison of a sample with a virtual pixel uses the sample's inverse depth, reduced by a
/// multiple of its standard deviation. This struct contains the factors; see CompositeOptions.
struct SampleBounds {
    float bias;    ///< for SampleRow::nearest: CompositeOptions::bias
    float hidden;  ///< for SampleRow::farthest: bias + softness
};

/// A row of real depth and of the video's colours, at the video's resolution.
struct SampleSource {
    const float *inverse, *sigma;  ///< inverse depth and its standard deviation [1/m]
    bool squared;                  ///< true: `sigma` contains the variance instead
    const std::uint8_t *red, *green, *blue;
};

/// A row of SampleSource, with all values as floats. A virtual pixel with inverse depth i is
/// certainly in front of the sample if i >= `nearest`. It is certainly behind the sample if
/// i * (1 + SampleBounds::hidden * CompositeOptions::virtualSigma) <= `farthest`. In an unknown
/// sample, `nearest` and `farthest` are 0, and `inverse` is negative, so that the sample hides
/// nothing.
struct SampleRow {
    float *inverse, *variance, *red, *green, *blue;
    float *nearest, *farthest;
};

/// Prepares the samples of pixels [first, last). A sample is known if its inverse depth and its
/// standard deviation are within limits (params::kLeastInverseDepth and the constants next to it).
void prepareSamples(const SampleSource& from, const SampleBounds& bounds, int first, int last,
                    const SampleRow& to);

/// Replaces nearest[i] by the largest of nearest[i] to nearest[i + 3], and farthest[i] by the
/// smallest of farthest[i] to farthest[i + 3]. Reads three entries after the last result.
void spreadSamples(float* nearest, float* farthest, int count);

/// Four successive rows of `nearest` or of `farthest` values, after spreadSamples().
/// rangeOfSamples() writes the largest `nearest` of each column to `greatest`, and the smallest
/// `farthest` of each column to `least`.
struct FourRows {
    const float* row[4];
};
void rangeOfSamples(const FourRows& nearest, const FourRows& farthest, int count, float* greatest,
                    float* least);

}  // namespace mfar::simd
