#pragma once

#include "base/rows.h"
#include "base/workers.h"
#include "hal/device/display_spec.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace mfar {

/// Scales pictures on the host as ScreenScaler does on the GPU: keeps the aspect (letterbox()),
/// black borders; area average when shrinking, linear interpolation when enlarging, exact at equal
/// size. Starts threads at the first scaling.
class HostScaler {
public:
    explicit HostScaler(Size screen) : screen_(screen) {}

    /// Rows of the screen's size, alpha undefined; valid until the next call. A picture of the
    /// screen's size is returned as it is. Sizes must be positive.
    [[nodiscard]] Rows<const std::uint32_t> scaled(const Rows<const std::uint32_t>& picture);

private:
    /// The pixels of the picture that one row or column of the screen averages.
    struct Footprint {
        int first = 0;        ///< first pixel
        int taps = 0;         ///< number of pixels, all inside the picture
        std::size_t begin{};  ///< index of their first weight
    };
    struct Axis {
        Axis() = default;
        Axis(int from, int to);
        std::vector<Footprint> footprints;
        /// Weights of all footprints, one after the other; those of each footprint add up to 1.
        std::vector<float> weights;
        std::vector<std::uint16_t> fixed;  ///< the weights as integers, sum 65535
    };
    /// Scratch memory of one thread for a row.
    struct Line {
        explicit Line(int width)
            : fixed(static_cast<std::size_t>(width) * 4),
              real(static_cast<std::size_t>(width) * 4) {}
        std::vector<std::uint16_t> fixed;
        std::vector<float> real;
    };

    void prepare(Size picture);
    void scaleRow(const Rows<const std::uint32_t>& picture, int row, Line& line);

    Size screen_, picture_;
    ScreenRect to_;
    Axis columns_, rows_;
    std::vector<Line> lines_;
    AlignedRows<std::uint32_t> out_;
    std::unique_ptr<Workers> workers_;
};

}  // namespace mfar
