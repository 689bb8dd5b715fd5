#include "pipeline/simd/luma_pyramids.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace mfar::simd {
namespace {

constexpr int kMargin = 4 * kLumaMarginWords;
// Pyramid levels with fewer rows are processed in one thread, because waking other threads would
// take longer than the work.
constexpr int kSharedRows = 200;

StillLens lensOf(const StereoRig& rig) {
    StillLens out{};
    const auto put = [](const CameraModel& camera, float* pinhole, float* distortion) {
        const double values[] = {camera.fx, camera.fy, camera.cx, camera.cy};
        std::ranges::transform(values, pinhole, [](double v) { return static_cast<float>(v); });
        std::ranges::transform(camera.distortion, distortion,
                               [](double v) { return static_cast<float>(v); });
    };
    put(rig.video, out.videoPinhole, out.videoDistortion);
    put(rig.still, out.stillPinhole, out.stillDistortion);
    const Eigen::Matrix3d r = rig.T_still_video.rotation.toRotationMatrix();
    for (int i = 0; i < 9; ++i)
        out.rotation[i] = static_cast<float>(r(i / 3, i % 3));
    return out;
}

}  // namespace

LumaPyramids::LumaPyramids(Size video, std::shared_ptr<Workers> workers)
    : workers_(std::move(workers)), stillX_(video), stillY_(video) {
    std::int32_t words = 0;
    video_ = lumaLayout(video, words);
    still_ = lumaLayout(video, words);
    words_.resize(static_cast<std::size_t>(words) + kLumaSpareWords);
}

std::uint8_t* LumaPyramids::rowOf(const LumaLevel& level, int y) {
    const std::size_t word = static_cast<std::size_t>(level.offset) +
                             static_cast<std::size_t>(y) * level.pitch + kLumaMarginWords;
    return reinterpret_cast<std::uint8_t*>(words_.data() + word);
}

void LumaPyramids::fillMargins(const LumaLevel& level, int y) {
    std::uint8_t* row = rowOf(level, y);
    std::memset(row - kMargin, row[0], kMargin);
    const int behind = 4 * level.pitch - kMargin - level.width;
    std::memset(row + level.width, row[level.width - 1], static_cast<std::size_t>(behind));
}

void LumaPyramids::buildVideo(const RgbPlanes& video) {
    const LumaLevel& level = video_[0];
    const auto planes = [&](int y) {
        const int row = std::clamp(y, 0, level.height - 1);
        return SmoothRows::Planes{video.row(0, row), video.row(1, row), video.row(2, row)};
    };
    workers_->forRange(level.height, 8, [&](int first, int last) {
        for (int y = first; y < last; ++y) {
            smoothLumaRow({planes(y - 1), planes(y), planes(y + 1)}, level.width, kLumaSmoothing,
                          rowOf(level, y));
            fillMargins(level, y);
        }
    });
    buildCoarse(video_);
}

void LumaPyramids::smooth(Rows<const std::uint8_t> luma, const std::vector<LumaLevel>& levels) {
    const LumaLevel& level = levels[0];
    const auto planes = [&](int y) {
        return SmoothRows::Planes{luma[std::clamp(y, 0, level.height - 1)], nullptr, nullptr};
    };
    workers_->forRange(level.height, 8, [&](int first, int last) {
        for (int y = first; y < last; ++y) {
            smoothLumaRow({planes(y - 1), planes(y), planes(y + 1)}, level.width, kLumaSmoothing,
                          rowOf(level, y));
            fillMargins(level, y);
        }
    });
    buildCoarse(levels);
}

void LumaPyramids::buildFirst(Rows<const std::uint8_t> luma) {
    smooth(luma, video_);
}

void LumaPyramids::buildSecond(Rows<const std::uint8_t> luma) {
    smooth(luma, still_);
}

void LumaPyramids::findStillPixels(const StillLens& lens) {
    if (lens_ == lens) return;
    lens_ = lens;
    workers_->forRange(stillX_.size().height, 8, [&](int first, int last) {
        for (int y = first; y < last; ++y)
            stillPixelRow(lens, y, stillX_.size().width, stillX_[y], stillY_[y]);
    });
}

void LumaPyramids::buildStill(Rows<const std::uint8_t> luma, const StereoRig& rig, float light) {
    findStillPixels(lensOf(rig));
    const LumaLevel& level = still_[0];
    const StillPicture still{luma.data, luma.pitch, luma.size.width, luma.size.height};
    const double width = lumaBoxWidening() * rig.still.fx / rig.video.fx;
    const Footprint footprint{static_cast<float>(width), light};
    workers_->forRange(level.height, 8, [&](int first, int last) {
        for (int y = first; y < last; ++y) {
            footprintRow(still, footprint, stillX_[y], stillY_[y], level.width, rowOf(level, y));
            fillMargins(level, y);
        }
    });
    buildCoarse(still_);
}

// If the width of `fine` is odd, its last column is averaged with the first margin column, which
// contains the same values.
void LumaPyramids::halve(const LumaLevel& fine, const LumaLevel& coarse, int first, int last) {
    for (int y = first; y < last; ++y) {
        halveLumaRow(rowOf(fine, 2 * y), rowOf(fine, std::min(2 * y + 1, fine.height - 1)),
                     coarse.width, rowOf(coarse, y));
        fillMargins(coarse, y);
    }
}

void LumaPyramids::buildCoarse(const std::vector<LumaLevel>& levels) {
    for (std::size_t i = 1; i < levels.size(); ++i) {
        const LumaLevel &fine = levels[i - 1], &coarse = levels[i];
        const auto part = [&](int first, int last) { halve(fine, coarse, first, last); };
        forRange(coarse.height >= kSharedRows ? workers_.get() : nullptr, coarse.height, 32, part);
    }
}

}  // namespace mfar::simd
