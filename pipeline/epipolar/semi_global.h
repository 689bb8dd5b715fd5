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

/// How strongly neighbouring pixels are coupled, in bits of the census cost.
struct Smoothness {
    int step = 12;     ///< penalty for a difference of one label
    int jump = 60;     ///< penalty for a larger one in uniform areas; at most 60
    double noise = 0;  ///< differences between neighbours up to this are no edges [grey levels]
};

using simd::Valley;

/// The label with sub-label precision: the vertex of the two straight lines through the label's
/// cost and those of its neighbours (with such costs, a parabola would lock to whole labels).
float vertexOf(const Valley& valley);

/// Semi-global matching over a window of labels that each pixel places individually; four paths
/// (left, right, up, down). Path costs stay below 85 and fit in bytes.
/// Source: Hirschmueller, PAMI 2008; windows per pixel: Rothermel et al., LC3D 2012 (tSGM).
class SemiGlobal {
public:
    static constexpr int kLabels = simd::kLabels;  ///< labels per vector

    /// Writes the costs of pixels [x0, x1) of row y: kLabels * vectors bytes a pixel, each at most
    /// kCensusBits, for labels base, base + 1, ... It may be called from several threads at once.
    using CostRow = std::function<void(int y, std::uint8_t* costs)>;

    /// Allocates for pictures that need up to this number of label vectors in total.
    explicit SemiGlobal(std::size_t vectors);

    /// `base`: first label of every pixel. `guide`: the picture whose edges allow jumps. The fields
    /// `base` and `out` have its size.
    void run(const LumaImage& guide, const std::vector<std::int16_t>& base, int vectors,
             const Smoothness& smoothness, const CostRow& costs, Workers& workers,
             std::span<Valley> out);

private:
    ZeroedArray<std::uint8_t> costs_, sums_;
    std::vector<std::uint8_t> scratch_;      // used when several vectors do not fit in registers
    std::array<std::uint8_t, 256> jumps_{};  // jump penalty by difference of luma
};

}  // namespace mfar
