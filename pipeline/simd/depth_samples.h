#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// Thresholds for real depth samples, from CompositeOptions.
struct SampleBounds {
    float bias;    ///< [sigmas]
    float hidden;  ///< bias and softness together [sigmas]
};

/// A row of real depth and of the picture that it belongs to, at the video's resolution.
struct SampleSource {
    const float *inverse, *sigma;  ///< [1/m]
    bool squared;                  ///< `sigma` holds variances
    const std::uint8_t *red, *green, *blue;
};

/// The same in single precision, for weighing. `inverse`: of an unknown pixel, so far away that it
/// occludes nothing. `nearest`, `farthest`: inverse depth above which a virtual pixel is surely in
/// front of the sample, and below which it is surely behind; 0 for an unknown pixel.
struct SampleRow {
    float *inverse, *variance, *red, *green, *blue;
    float *nearest, *farthest;
};

/// Prepares pixels [first, last). A pixel whose values are not both finite and positive is unknown.
void prepareSamples(const SampleSource& from, const SampleBounds& bounds, int first, int last,
                    const SampleRow& to);

/// In place: entry i becomes the largest (farthest: the smallest) of entries i to i + 3.
void spreadSamples(float* nearest, float* farthest, int count);

/// Largest and smallest value of each column over four such rows.
struct FourRows {
    const float* row[4];
};
void rangeOfSamples(const FourRows& nearest, const FourRows& farthest, int count, float* greatest,
                    float* least);

}  // namespace mfar::simd
