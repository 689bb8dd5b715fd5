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

/// Penalties for different labels of neighbouring pixels. The unit is a bit of the census cost.
/// `step` is for a difference of one label. `jump` (at most 60) is for a larger difference in
/// uniform areas.
struct Smoothness {
    int step = 12;
    int jump = 60;
    /// Two neighbours are at an edge if their luma differs by more than this [grey levels].
    double noise = 0;
};

using simd::Valley;

/// Returns the position of the lowest cost, which usually lies between two labels. It is the vertex
/// of two lines with opposite slopes through the costs of the best label and of its neighbours.
/// (The vertex of a parabola through these costs would be too close to whole labels.)
float vertexOf(const Valley& valley);

/// Semi-global matching with costs aggregated from left, right, top and bottom. Each pixel has its
/// own window of labels with its own first label. Costs aggregated along one path are at most 84
/// (kCensusBits + Smoothness::jump), so the sum over three directions fits into a byte. (The fourth
/// is added when the best label is found.) Source: Hirschmueller, PAMI 2008; windows per pixel:
/// Rothermel et al., LC3D 2012 (tSGM).
class SemiGlobal {
public:
    static constexpr int kLabels = simd::kLabels;

    /// A function that writes the matching costs of row y to `costs`: for each pixel, one byte for
    /// each label that run() searches there, from the pixel's first label on. Each cost is at most
    /// kCensusBits. run() calls the function from several threads at once.
    using CostRow = std::function<void(int y, std::uint8_t* costs)>;

    /// `vectors`: the largest number of SIMD vectors that a picture needs for the costs of all its
    /// pixels. A vector holds the costs of kLabels labels of one pixel.
    explicit SemiGlobal(std::size_t vectors);

    /// Finds the best label of every pixel among kLabels * `vectors` labels; here, `vectors` is the
    /// number of SIMD vectors per pixel. `base` is the first label of each pixel. At edges of
    /// `guide`, Smoothness::jump is reduced. `base` and `out` have one entry per pixel of `guide`.
    void run(const LumaImage& guide, const std::vector<std::int16_t>& base, int vectors,
             const Smoothness& smoothness, const CostRow& costs, Workers& workers,
             std::span<Valley> out);

private:
    ZeroedArray<std::uint8_t> costs_, sums_;
    std::vector<std::uint8_t> scratch_;  // memory for vectors that do not fit into registers
    std::array<std::uint8_t, 256> jumps_{};
};

}  // namespace mfar
