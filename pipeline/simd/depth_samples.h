#pragma once

#include <cstddef>
#include <cstdint>

namespace mfar::simd {

/// What counts of a real depth sample, as CompositeOptions has it.
struct SampleBounds {
    float bias;    ///< [sigmas]
    float hidden;  ///< bias and softness together [sigmas]
};

/// A row of real depth and of the picture it belongs to, video resolution.
struct SampleSource {
    const float *inverse, *sigma;  ///< [1/m]
    bool squared;                  ///< `sigma` holds variances
    const std::uint8_t *red, *green, *blue;
};

/// The same as single precision for weighing. `inverse`: where nothing is known so far away that
/// it hides nothing. `nearest`, `farthest`: the greatest and the least inverse depth that the
/// sample may be in front of or behind; 0 where nothing is known.
struct SampleRow {
    float *inverse, *variance, *red, *green, *blue;
    float *nearest, *farthest;
};

/// Prepares pixels [first, last). A pixel whose values are not both finite and positive is unknown.
void prepareSamples(const SampleSource& from, const SampleBounds& bounds, int first, int last,
                    const SampleRow& to);

/// In place: entry i becomes the greatest (farthest: the least) of entries i to i + 3.
void spreadSamples(float* nearest, float* farthest, int count);

/// Of four such rows the greatest and the least, column by column.
struct FourRows {
    const float* row[4];
};
void rangeOfSamples(const FourRows& nearest, const FourRows& farthest, int count, float* greatest,
                    float* least);

}  // namespace mfar::simd
