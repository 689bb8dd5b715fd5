#include "daemon/picture_size.h"

#include "pipeline/pipeline.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace mfar {
namespace {

constexpr int kMostPixels = 16384;  // across or down

std::optional<int> pixels(std::string_view digits) {
    int out = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), out);
    const bool whole = error == std::errc() && end == digits.data() + digits.size();
    if (!whole || out < 1 || out > kMostPixels) return std::nullopt;
    return out;
}

}  // namespace

std::optional<PictureSize> pictureSize(std::string_view words) {
    using Fits = PictureSize::Fits;
    if (words == "screen") return PictureSize{Fits::Screen};
    if (words == "still") return PictureSize{Fits::Still};
    const std::size_t cross = words.find('x');
    if (cross == std::string_view::npos) return std::nullopt;
    const auto width = pixels(words.substr(0, cross)), height = pixels(words.substr(cross + 1));
    if (!width || !height) return std::nullopt;
    return PictureSize{Fits::Given, {*width, *height}};
}

std::optional<std::string> pictureSizeFault(std::string_view words) {
    if (pictureSize(words)) return std::nullopt;
    return "must be \"screen\", \"still\" or a size of 1 to 16384 pixels like \"1280x720\"";
}

Size outputSizeFor(const PictureSize& wanted, const StereoRig& rig,
                   const std::optional<Size>& screen) {
    const Size full = Pipeline::fullSize(rig);
    std::optional<Size> within = wanted.given;
    if (wanted.fits == PictureSize::Fits::Screen) within = screen;
    if (wanted.fits == PictureSize::Fits::Still || !within || within->width < 1) return full;
    const double fitting = std::min(static_cast<double>(within->width) / full.width,
                                    static_cast<double>(within->height) / full.height);
    const double least = static_cast<double>(rig.video.size.width) / full.width;
    const double scale = std::min(1.0, std::max(fitting, least));
    const auto side = [scale](int length) {
        return std::max(1, static_cast<int>(std::lround(length * scale)));
    };
    return {side(full.width), side(full.height)};
}

}  // namespace mfar
