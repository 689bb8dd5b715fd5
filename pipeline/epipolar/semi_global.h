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

/// Penalties for different labels of neighbouring pixels, in bits of the census cost.
struct Smoothness {
    int step = 12;     ///< penalty for a difference of one label
    int jump = 60;     ///< penalty for a larger difference in uniform areas; at most 60
    double noise = 0;  ///< neighbours whose luma differs by more than this are at an edge [grey
                       ///< levels]
};

using simd::Valley;

/// Returns the position of the lowest cost between labels. It is the vertex of two straight lines
/// with opposite slopes through the costs of the best label and of its two neighbours. (With such
/// costs, the vertex of a parabola would be too close to whole labels.)
float vertexOf(const Valley& valley);

/// Semi-global matching. Costs are aggregated along four directions (left, right, up, down). Each
/// pixel has its own window of labels, which begins at its own first label. Aggregated costs stay
/// below 85 and fit into bytes. Source: Hirschmueller, PAMI 2008; windows per pixel: Rothermel et
/// al., LC3D 2012 (tSGM).
class SemiGlobal {
public:
    static constexpr int kLabels = simd::kLabels;  ///< number of labels in a vector

    /// A function that writes the costs of row y: kLabels * vectors bytes per pixel, for the
    /// pixel's labels base, base + 1, ... Each cost is at most kCensusBits. May be called from
    /// several threads at once.
    using CostRow = std::function<void(int y, std::uint8_t* costs)>;

    /// Allocates memory for pictures that need up to this number of label vectors in total.
    explicit SemiGlobal(std::size_t vectors);

    /// Finds the best label of every pixel. `base`: first label of each pixel. `guide`: the picture
    /// at whose edges jumps between labels cost less. `vectors`: number of vectors of labels per
    /// pixel. `base` and `out` have one entry per pixel of `guide`.
    void run(const LumaImage& guide, const std::vector<std::int16_t>& base, int vectors,
             const Smoothness& smoothness, const CostRow& costs, Workers& workers,
             std::span<Valley> out);

private:
    ZeroedArray<std::uint8_t> costs_, sums_;
    std::vector<std::uint8_t> scratch_;      // memory for vectors that do not fit into registers
    std::array<std::uint8_t, 256> jumps_{};  // penalty of a jump, by the difference of both pixels'
                                             // luma
};

}  // namespace mfar
