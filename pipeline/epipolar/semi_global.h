#pragma once

#include "base/workers.h"
#include "base/zeroed_array.h"
#include "pipeline/flow/luma_image.h"
#include "pipeline/simd/path_costs.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace mfar {

/// Penalties that couple neighbouring pixels, in bits of the census cost.
struct Smoothness {
    int step = 12;     ///< penalty for a difference of one label
    int jump = 60;     ///< penalty for a larger difference in uniform areas; at most 60
    double noise = 0;  ///< larger differences of neighbours are edges [grey levels]
};

using simd::Valley;

/// Returns the label with a fractional part. Two straight lines are laid through the costs of the
/// label and of its neighbours; their vertex is the result. (A parabola would prefer whole labels
/// with such costs.)
float vertexOf(const Valley& valley);

/// Semi-global matching along four paths (left, right, up, down). Each pixel has a window of
/// labels, with its own first label. Path costs stay below 85 and fit into bytes. Source:
/// Hirschmueller, PAMI 2008; windows per pixel: Rothermel et al., LC3D 2012 (tSGM).
class SemiGlobal {
public:
    static constexpr int kLabels = simd::kLabels;  ///< labels per vector

    /// Writes the costs of row y: kLabels * vectors bytes per pixel, for its labels base, base + 1,
    /// ... Each cost is at most kCensusBits. May be called from several threads at once.
    using CostRow = std::function<void(int y, std::uint8_t* costs)>;

    /// Allocates memory for pictures that need up to this number of label vectors in total.
    explicit SemiGlobal(std::size_t vectors);

    /// `base`: first label of every pixel. `guide`: the picture whose edges allow jumps. `base` and
    /// `out` have one entry per pixel of `guide`.
    void run(const LumaImage& guide, const std::vector<std::int16_t>& base, int vectors,
             const Smoothness& smoothness, const CostRow& costs, Workers& workers,
             std::span<Valley> out);

private:
    ZeroedArray<std::uint8_t> costs_, sums_;
    std::vector<std::uint8_t> scratch_;      // used if the vectors do not fit into registers
    std::array<std::uint8_t, 256> jumps_{};  // jump penalty by difference of luma
};

}  // namespace mfar
