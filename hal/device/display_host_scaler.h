#pragma once

#include "base/rows.h"
#include "base/workers.h"
#include "hal/device/display_spec.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace mfar {

/// Scales pictures on the CPU, as ScreenScaler does on the GPU. The aspect ratio is kept, with
/// black borders (letterbox()). A picture is reduced by averaging areas and enlarged by linear
/// interpolation. The first scaling starts threads.
class HostScaler {
public:
    explicit HostScaler(Size screen) : screen_(screen) {}

    /// Returns the picture in the screen's size, valid until the next call. Alpha is undefined. A
    /// picture of the screen's size is returned without a copy. Width and height must be positive.
    [[nodiscard]] Rows<const std::uint32_t> scaled(const Rows<const std::uint32_t>& picture);

private:
    /// The rows (or columns) of the picture whose weighted mean is one row (or column) of the
    /// screen. All of them are inside the picture. `begin` is the index of their first weight in
    /// Axis::weights and Axis::fixed.
    struct Footprint {
        int first = 0;
        int taps = 0;
        std::size_t begin{};
    };
    struct Axis {
        Axis() = default;
        Axis(int from, int to);
        std::vector<Footprint> footprints;
        /// Weights of all footprints, one after the other. Those of one footprint add up to 1 in
        /// `weights` and to 65535 in `fixed`.
        std::vector<float> weights;
        std::vector<std::uint16_t> fixed;
    };
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
