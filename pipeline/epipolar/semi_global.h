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

/// How strongly neighbouring pixels hold together, in bits of the census cost.
struct Smoothness {
    int step = 12;     ///< penalty of one label's difference
    int jump = 60;     ///< penalty of more, where the picture is even; at most 60
    double noise = 0;  ///< difference between neighbours that is no edge [grey levels]
};

using simd::Valley;

/// The label with its sub-label part: the vertex of the two straight lines through it and its
/// neighbours (a parabola would lock to whole labels on such costs).
float vertexOf(const Valley& valley);

/// Semi-global matching over a window of labels that each pixel has for itself: four paths (left,
/// right, up, down). Path costs stay below 85, so that they fit in bytes.
/// Source: Hirschmueller, PAMI 2008; windows per pixel: Rothermel et al., LC3D 2012 (tSGM).
class SemiGlobal {
public:
    static constexpr int kLabels = simd::kLabels;  ///< labels come in vectors of so many

    /// Writes the costs of pixels [x0, x1) of row y: kLabels * vectors bytes a pixel, each at most
    /// kCensusBits, for labels base, base + 1, ... It may be called from several threads at once.
    using CostRow = std::function<void(int y, std::uint8_t* costs)>;

    /// Allocates for pictures whose pixels have up to so many vectors of labels together.
    explicit SemiGlobal(std::size_t vectors);

    /// `base`: first label of every pixel. `guide`: the picture whose edges allow jumps; its size
    /// is that of the fields. `out`: as many.
    void run(const LumaImage& guide, const std::vector<std::int16_t>& base, int vectors,
             const Smoothness& smoothness, const CostRow& costs, Workers& workers,
             std::span<Valley> out);

private:
    ZeroedArray<std::uint8_t> costs_, sums_;
    std::vector<std::uint8_t> scratch_;      // where several vectors do not stay in registers
    std::array<std::uint8_t, 256> jumps_{};  // by difference of luma
};

}  // namespace mfar
