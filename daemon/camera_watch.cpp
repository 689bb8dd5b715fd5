#include "daemon/camera_watch.h"

#include "base/image_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>

namespace mfar {
namespace {

constexpr int kChecksumRows = 16;

}  // namespace

std::uint64_t sparseChecksum(const ImageView& picture) {
    const PlaneSize plane = planeSize(picture.format, picture.size, 0);
    const int step = std::max(1, (plane.rows + kChecksumRows - 1) / kChecksumRows);
    std::uint64_t sum = 0x9e3779b97f4a7c15;
    for (int y = step / 2; y < plane.rows; y += step) {
        const std::uint8_t* row = picture.data + picture.stride * static_cast<std::size_t>(y);
        for (std::size_t x = 0; x < plane.rowBytes; x += sizeof sum) {
            std::uint64_t word = 0;
            std::memcpy(&word, row + x, std::min(sizeof word, plane.rowBytes - x));
            // The factor is odd, so the multiplication is invertible and no bit of a word is lost.
            sum = (sum ^ word) * 0x2545f4914f6cdd1d;
            sum ^= sum >> 29;
        }
    }
    return sum;
}

CameraWatch::CameraWatch(const CameraInfo& info, CameraKind kind) : name_(info.name), kind_(kind) {
    state_.configuredHz = info.rateHz;
}

void CameraWatch::add(const Frame& frame, Timestamp now) {
    ++frames_;
    state_.lastFrame = now;
    if (kind_ == CameraKind::Stored) return;
    drops_.add(frame.time());
    if (const auto period = drops_.period())
        state_.rateHz = 1e9 / static_cast<double>(period->count());
    if (kind_ != CameraKind::Sensor) return;
    checkRate(now);
    checkRepeats(frame, now);
}

void CameraWatch::add(const CameraCounters& counters) {
    state_.counters = counters;
    if (counters.missed) return;
    state_.counters.delivered = frames_;
    // Missing frames show in the intervals between frames only if the camera has a configured frame
    // rate.
    if (kind_ != CameraKind::Stored && state_.configuredHz > 0)
        state_.counters.missed = drops_.dropped();
}

void CameraWatch::checkRate(Timestamp now) {
    const double wanted = state_.configuredHz;
    const bool wrong = wanted > 0 && state_.rateHz > 0 &&
                       std::abs(state_.rateHz - wanted) > kRateTolerance * wanted;
    if (!wrong) {
        wrongSince_.reset();
        return;
    }
    if (!wrongSince_) wrongSince_ = now;
    if (rateTold_ || now - *wrongSince_ < kRateTime) return;
    rateTold_ = true;
    warnings_.push_back(
        fmt::format("{}: sends {:.1f} frames per second instead of the configured {:g}", name_,
                    state_.rateHz, wanted));
}

void CameraWatch::checkRepeats(const Frame& frame, Timestamp now) {
    const std::uint64_t checksum = sparseChecksum(frame.view());
    if (std::exchange(checksum_, checksum) != checksum) {
        // The frame's own time is used, not `now`, because the frame may have waited in the driver.
        state_.lastDistinct = std::min(now, frame.time());
        state_.repeats = false;
        repeats_ = 0;
        return;
    }
    ++state_.repeated;
    if (state_.repeats || ++repeats_ < kRepeats || now - *state_.lastDistinct < kRepeatTime) return;
    state_.repeats = true;
    warnings_.push_back(fmt::format(
        "{}: repeats the same picture (for {} s)", name_,
        std::chrono::duration_cast<std::chrono::seconds>(now - *state_.lastDistinct).count()));
}

std::vector<std::string> CameraWatch::takeWarnings() {
    return std::exchange(warnings_, {});
}

}  // namespace mfar
