#include "hal/device/field_of_view.h"

#include <algorithm>

namespace mfar {
namespace {

/// A crop shows the whole field if each of its sides has at least this share of the pixels of the
/// largest possible crop. Even full sensor modes leave out a few pixels, because sizes must be
/// multiples of some number.
constexpr double kAlike = 0.98;

bool isPositive(Size size) {
    return size.width > 0 && size.height > 0;
}

}  // namespace

bool showsWholeField(Size crop, Size active, Size output) {
    if (!isPositive(crop) || !isPositive(active) || !isPositive(output)) return false;
    const double scale = std::min(static_cast<double>(active.width) / output.width,
                                  static_cast<double>(active.height) / output.height);
    return crop.width >= kAlike * scale * output.width &&
           crop.height >= kAlike * scale * output.height;
}

}  // namespace mfar
