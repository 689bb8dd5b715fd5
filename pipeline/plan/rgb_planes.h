#pragma once

#include "base/image_view.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mfar {

/// Red, green and blue of a picture on the host, a plane of bytes each, made larger to whole tiles
/// by its border pixels. Picture coordinates. Owns its pixels.
class RgbPlanes {
public:
    /// Black.
    explicit RgbPlanes(Size size);

    /// Takes over a sound picture of this size, in any format; colours as picture_from_yuv.frag
    /// makes them, to a grey level.
    void take(const ImageView& picture);
    /// Takes over one tile of planes of the same size.
    void takeTile(const RgbPlanes& from, int column, int row);

    [[nodiscard]] Size size() const { return size_; }
    [[nodiscard]] Size tiles() const { return tiles_; }
    /// Bytes of a row: those of whole tiles.
    [[nodiscard]] int pitch() const { return pitch_; }
    /// `channel`: 0 red, 1 green, 2 blue.
    [[nodiscard]] const std::uint8_t* row(int channel, int y) const {
        return planes_[channel].data() + static_cast<std::size_t>(y) * pitch_;
    }

private:
    using ChannelRows = std::array<std::uint8_t*, 3>;
    [[nodiscard]] ChannelRows rowsAt(int y);
    void repeatBorder();

    Size size_, tiles_;
    int pitch_;
    std::array<std::vector<std::uint8_t>, 3> planes_;
};

}  // namespace mfar
