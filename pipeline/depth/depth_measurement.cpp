#include "pipeline/depth/depth_measurement.h"

#include "pipeline/flow/cell_field.h"
#include "pipeline/simd/depth_rows.h"

#include <algorithm>

namespace mfar {
namespace {

// Standard deviation of a match along its epipolar line [px], measured with ground truth in smooth
// areas.
constexpr float kMatchError = 0.3F;
// Several points can be matched with the same pixel of the other picture. Two of them count as one
// slanted surface if their displacements between the pictures differ by at most this distance [px].
// Otherwise, the nearer point occludes the other.
constexpr float kSlope = 1.5F;
// Cells and a pixel show the same surface if the match interpolated between the cells differs from
// the pixel's own match by less than this [px].
constexpr double kSameSurface = 0.5;
// A pixel is measured only if the depth of its point in the video camera exceeds this fraction of
// the point's depth in the other camera.
constexpr float kLeastDepth = 0.05F;
constexpr float kNothing = -1e9F;

}  // namespace

DepthMeasurement::DepthMeasurement(const CameraModel& video, EpipolarLens lens,
                                   std::shared_ptr<Workers> workers)
    : lens_(std::move(lens)), focal_(static_cast<float>(std::min(video.fx, video.fy))),
      workers_(std::move(workers)) {
    const auto pixels = static_cast<std::size_t>(video.size.width) * video.size.height;
    landing_.resize(pixels);
    nearest_.resize(pixels);
    s_.resize(pixels);
}

// Sets s_ to the more accurate s of the cells where possible. Matches of cells are accurate to a
// fraction of a pixel, but do not show on which side of a depth edge a pixel lies. Matches of
// single pixels show this. Therefore, a pixel takes the value interpolated between the cells if
// this value agrees with the pixel's own match, and keeps its own value otherwise.
void DepthMeasurement::takeField(const EpipolarSearch& search, std::span<const float> cells,
                                 const PixelRect& where) {
    const int width = lens_.size().width;
    const PixelRect& area = search.area();
    const std::vector<float>& searched = search.s();
    const auto same = static_cast<float>(kSameSurface / search.pixelsPerUnit());
    const simd::CellField field{cells.data(), cellsOf(lens_.size())};
    const auto count = static_cast<std::size_t>(where.x1 - where.x0);
    workers_->forRange(where.y1 - where.y0, 16, [&](int first, int last) {
        for (int y = where.y0 + first; y < where.y0 + last; ++y) {
            const float* own = searched.data() +
                               static_cast<std::ptrdiff_t>(y - area.y0) * (area.x1 - area.x0) +
                               where.x0 - area.x0;
            float* to = s_.data() + static_cast<std::size_t>(y) * width + where.x0;
            if (cells.empty())
                std::copy_n(own, count, to);
            else
                simd::takeCells(field, where.x0, y, own, same, count, to);
        }
    });
}

void DepthMeasurement::land(const EpipolarSearch& search, const Eigen::Matrix3f& R,
                            const PixelRect& where) {
    const Eigen::Vector3f& t = search.translation();
    simd::Motion motion{{}, {t.x(), t.y(), t.z()}};
    for (int i = 0; i < 9; ++i)
        motion.turn[i] = R(i / 3, i % 3);
    const int width = lens_.size().width;
    workers_->forRange(where.y1 - where.y0, 16, [&](int first, int last) {
        for (int y = where.y0 + first; y < where.y0 + last; ++y) {
            const std::size_t i = static_cast<std::size_t>(y) * width + where.x0;
            const auto count = static_cast<std::size_t>(where.x1 - where.x0);
            simd::landRow(lens_.lens(), lens_.size(), motion, lens_.raysX().data() + i,
                          lens_.raysY().data() + i, s_.data() + i, count, landing_.data() + i);
            // landRow() assumes that the other picture is as large as the video, but it may be
            // smaller. dropUnseen() removes the points outside of it.
            search.dropUnseen(where.x0, y, std::span(s_).subspan(i, count),
                              std::span(landing_).subspan(i, count));
        }
    });
    findNearest(where);
}

// Finds the nearest point at each pixel of the other picture (nearest_). Each thread has its own
// part of the other picture, so that no two threads write to the same pixel.
void DepthMeasurement::findNearest(const PixelRect& where) {
    const auto [width, height] = lens_.size();
    const int parts = std::min(workers_->count(), height);
    workers_->forRange(parts, 1, [&](int firstPart, int lastPart) {
        const int first = firstPart * height / parts * width;
        const int last = lastPart * height / parts * width;
        std::fill(nearest_.begin() + first, nearest_.begin() + last, kNothing);
        for (int y = where.y0; y < where.y1; ++y) {
            const auto row = static_cast<std::size_t>(y) * width;
            for (std::size_t i = row + where.x0; i < row + where.x1; ++i) {
                if (landing_[i] < first || landing_[i] >= last) continue;
                float& nearest = nearest_[static_cast<std::size_t>(landing_[i])];
                nearest = std::max(nearest, s_[i]);
            }
        }
    });
}

void DepthMeasurement::run(const EpipolarSearch& search, const Eigen::Matrix3f& R_other_video,
                           double unit, std::span<const float> cells, const PixelRect& where,
                           InverseDepthField& out) {
    if (!(search.pixelsPerUnit() > 0 && unit > 0)) {
        for (int y = where.y0; y < where.y1; ++y)
            out.forgetRow(y, where.x0, where.x1);
        return;
    }
    takeField(search, cells, where);
    land(search, R_other_video, where);
    const Eigen::Vector3f& t = search.translation();
    const simd::MeasureRule rule{{t.x(), t.y(), t.z()},
                                 static_cast<float>(kSlope / search.pixelsPerUnit()),
                                 kLeastDepth,
                                 kMatchError / focal_,
                                 static_cast<float>(1 / unit)};
    const auto count = static_cast<std::size_t>(where.x1 - where.x0);
    workers_->forRange(where.y1 - where.y0, 16, [&](int first, int last) {
        for (int y = where.y0 + first; y < where.y0 + last; ++y) {
            const std::size_t i = static_cast<std::size_t>(y) * lens_.size().width + where.x0;
            simd::measureRow({lens_.raysX().data() + i, lens_.raysY().data() + i, s_.data() + i,
                              landing_.data() + i, nearest_.data()},
                             rule, count, out.inverseDepth.data() + i, out.variance.data() + i);
            std::fill_n(out.filled.begin() + static_cast<std::ptrdiff_t>(i), count,
                        std::uint8_t{0});
        }
    });
}

}  // namespace mfar
