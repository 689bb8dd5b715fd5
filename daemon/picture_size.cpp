#include "daemon/picture_size.h"

#include <charconv>

namespace mfar {
namespace {

constexpr int kMostPixels = 16384;

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
    return "must be \"screen\", \"still\" or a width and height like \"1280x720\", each from 1 to "
           "16384 pixels";
}

}  // namespace mfar
