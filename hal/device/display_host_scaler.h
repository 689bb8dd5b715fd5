#pragma once

#include "base/rows.h"
#include "base/workers.h"
#include "hal/device/display_spec.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace mfar {

/// Scales pictures on the host as ScreenScaler does on the GPU: aspect kept (letterbox()), black
/// around them; the mean over each pixel's footprint where they shrink, linear interpolation where
/// they grow, exact at equal size. Starts threads when it first has to scale.
class HostScaler {
public:
    explicit HostScaler(Size screen) : screen_(screen) {}

    /// Rows of the screen's size, alpha undefined; valid until the next call, or, where the picture
    /// has that size already, as long as the picture's, which they are. Sizes must be positive.
    [[nodiscard]] Rows<const std::uint32_t> scaled(const Rows<const std::uint32_t>& picture);

private:
    /// Which pixels of the picture a row or column of the screen is the mean of.
    struct Footprint {
        int first = 0;        ///< pixel
        int taps = 0;         ///< pixels, all inside the picture
        std::size_t begin{};  ///< of their weights
    };
    struct Axis {
        Axis() = default;
        Axis(int from, int to);
        std::vector<Footprint> footprints;
        std::vector<float> weights;        ///< of each footprint, sum 1
        std::vector<std::uint16_t> fixed;  ///< the same, sum 65535
    };
    /// What one of the threads needs for a row.
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
