#include "pipeline/enlarge/matched_pictures.h"

#include "pipeline/simd/enlarge_rows.h"

#include <algorithm>
#include <cassert>

namespace mfar {
namespace {

template <class T>
void copy(Rows<const T> from, AlignedRows<T>& to) {
    if (to.size() != from.size) to = AlignedRows<T>(from.size);
    for (int y = 0; y < from.size.height; ++y)
        std::copy_n(from[y], from.size.width, to[y]);
}

}  // namespace

void MatchedPictures::take(const RgbPlanes& planes, Rows<const std::uint8_t> stillLuma,
                           Rows<const LookUpCell> cells, const LookedUp& lookedUp) {
    video = planes.size();
    const Size withMargin{video.width + 2 * kMargin, video.height};
    if (luma.size() != withMargin) luma = AlignedRows<std::int16_t>(withMargin);
    for (int y = 0; y < video.height; ++y) {
        std::int16_t* to = luma[y] + kMargin;
        simd::lumaEighthsRow({planes.row(0, y), planes.row(1, y), planes.row(2, y)}, 0, video.width,
                             to);
        std::fill_n(to - kMargin, kMargin, to[0]);
        std::fill_n(to + video.width, kMargin, to[video.width - 1]);
    }
    copy(stillLuma, still);
    copy(cells, lookUps);
    scaleX = lookedUp.scaleX;
    scaleY = lookedUp.scaleY;
    tone = lookedUp.tone;
    stillPerX = double(stillLuma.size.width) / lookedUp.size.width;
    stillPerY = double(stillLuma.size.height) / lookedUp.size.height;
}

void MatchedPictures::apply(const StillTone& curve) {
    assert(tone.isIdentity());
    const auto [width, height] = still.size();
    for (int y = 0; y < height; ++y)
        curve.apply({still[y], static_cast<std::size_t>(width)});
    tone = curve;
}

const std::int16_t* MatchedPictures::row(int y) const {
    return luma[std::clamp(y, 0, video.height - 1)] + kMargin;
}

}  // namespace mfar
