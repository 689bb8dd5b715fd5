#pragma once

#include "base/image_view.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mfar {

/// A picture in CPU memory, owned by this object, with one plane of bytes for each of red, green
/// and blue. The planes are padded to whole tiles by repeating the border pixels.
class RgbPlanes {
public:
    explicit RgbPlanes(Size size);

    /// Converts a valid picture of this size, in any format. Colours differ from those of
    /// picture_from_yuv.frag by at most one grey level.
    void take(const ImageView& picture);
    void takeTile(const RgbPlanes& from, int column, int row);

    [[nodiscard]] Size size() const { return size_; }
    [[nodiscard]] Size tiles() const { return tiles_; }
    [[nodiscard]] int pitch() const { return pitch_; }
    /// Channels: 0 red, 1 green, 2 blue.
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
