#include "pipeline/epipolar/epipolar_flow.h"

#include "base/image_layout.h"
#include "pipeline/epipolar/near_plane.h"
#include "pipeline/flow/cell_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace mfar {
namespace {

constexpr float kNowhere = 1e4F;
// Near the epipole, a change of s hardly moves a pixel, and its epipolar line counts as a point. A
// pixel is near the epipole if it moves by at most kLeastWay [px] when s is changed by the step
// that moves the fastest pixel of the picture by 1 px.
constexpr float kLeastWay = 0.05F;
// Several cells can match the same cell of the still. The one nearest to the camera occludes the
// others, except those whose parallax differs from its parallax by at most this distance [px]. They
// count as parts of the same slanted surface.
constexpr float kSlope = 1.0F;
// Width of the margin that is searched around the requested rectangle [px]. It is needed for census
// windows, for the cost aggregation, and for the motion until the next frame.
constexpr int kRoom = 16;

/// Returns the rectangle that is searched if `where` is requested. It includes a margin. Its edges
/// are at multiples of kRoom or at the picture's border.
PixelRect searchedFor(const PixelRect& where, Size video) {
    const PixelRect around = widened(where, kRoom, video);
    const auto down = [](int x) { return x / kRoom * kRoom; };
    const auto up = [](int x, int most) { return std::min((x + kRoom - 1) / kRoom * kRoom, most); };
    return {down(around.x0), down(around.y0), up(around.x1, video.width),
            up(around.y1, video.height)};
}

struct Middle {
    int first, last;
    [[nodiscard]] float middle() const { return 0.5F * static_cast<float>(first + last); }
};

Middle middleOf(int cell, int pixels) {
    const int first = std::clamp(kCell * cell + 1, 0, std::max(pixels - 2, 0));
    return {first, std::min(first + 1, pixels - 1)};
}

}  // namespace

EpipolarFlow::EpipolarFlow(const StereoRig& rig, std::shared_ptr<Workers> workers,
                           const EpipolarOptions& options)
    : rig_(rig), cells_(cellsOf(rig.video.size)), search_(rig, workers, options),
      workers_(std::move(workers)), mostPredicted_(options.mostPredicted), prediction_(rig.video),
      lens_(search_.videoLens()), cellRays_(rig.video, 2), rotation_(Eigen::Matrix3f::Identity()) {
    const std::size_t count = static_cast<std::size_t>(cells_.width) * cells_.height;
    forward_.resize(count);
    hidden_.resize(count);
    landing_.resize(count);
    const Size video = rig.video.size;
    for (int i = 0; i < cells_.width; ++i)
        middlesX_.push_back(middleOf(i, video.width).middle());
    for (int j = 0; j < cells_.height; ++j)
        middlesY_.push_back(middleOf(j, video.height).middle());
    for (int j = 0; j < cells_.height; ++j) {
        const Middle y = middleOf(j, video.height);
        for (int i = 0; i < cells_.width; ++i) {
            const Middle x = middleOf(i, video.width);
            const auto pixel = [&](int u, int v) {
                return static_cast<std::size_t>(v) * video.width + u;
            };
            const std::size_t first = pixel(x.first, y.first), last = pixel(x.last, y.last);
            middleRaysX_.push_back(0.5F * (lens_.rayX(first) + lens_.rayX(last)));
            middleRaysY_.push_back(0.5F * (lens_.rayY(first) + lens_.rayY(last)));
        }
    }
    s_.resize(count);
    nearest_.resize(count);
}

void EpipolarFlow::setStill(const ImageView& still, const Pose& pose) {
    search_.setStill(still);
    stillPose_ = pose;
    prediction_.forget();
}

void EpipolarFlow::setStill(const Rows<const std::uint8_t>& still, const Pose& pose) {
    search_.setStill(still);
    stillPose_ = pose;
    prediction_.forget();
}

void EpipolarFlow::setOptions(const EpipolarOptions& options) {
    search_.setOptions(options);
    mostPredicted_ = options.mostPredicted;
}

void EpipolarFlow::dropStill() {
    stillPose_.reset();
    prediction_.forget();
}

void EpipolarFlow::run(const ImageView& video, const Pose& pose, const PixelRect& where,
                       bool rests) {
    if (const auto plane = lumaPlane(video)) {
        run(Rows<const std::uint8_t>{plane->data, static_cast<std::ptrdiff_t>(plane->stride),
                                     plane->size},
            pose, where, rests);
        return;
    }
    lumaOf(video, luma_);
    run(luma_.rows(), pose, where, rests);
}

void EpipolarFlow::run(const Rows<const std::uint8_t>& video, const Pose& pose,
                       const PixelRect& where, bool rests) {
    frame_ = video;
    const UnitPose relative = rests ? restingPose(rig_.T_still_video, *stillPose_, pose)
                                    : unitPose(rig_.T_still_video, *stillPose_, pose);
    unit_ = relative.unit;
    lengthError_ = relative.lengthError;
    search(relative, where);
    // rotation_ rotates rays of the frame into the orientation that the video camera had when the
    // still was taken. It is computed from search_.pose(), because the search used this pose when
    // it resampled the still in the frame's orientation.
    rotation_ = (rig_.T_still_video.rotation.conjugate() * search_.pose().rotation)
                    .toRotationMatrix()
                    .cast<float>();
    fillForward();
    testDepth();
    if (search_.pixelsPerUnit() > 0)
        prediction_.keep(s_, search_.pose(), unit_);
    else
        prediction_.forget();
}

void EpipolarFlow::search(const UnitPose& relative, const PixelRect& where) {
    const PixelRect wanted = searchedFor(where, rig_.video.size);
    // A predicted search misses objects that enter the picture or move by themselves, because the
    // prediction does not contain them. They are found only by a search from coarse to fine.
    const bool isNew = around(search_.area(), wanted) != search_.area();
    const auto predicted = predictedFrames_ < mostPredicted_ && !isNew
                               ? prediction_.in(relative.T_other_frame, relative.unit)
                               : std::span<const float>();
    predictedFrames_ = predicted.empty() ? 0 : predictedFrames_ + 1;
    if (predicted.empty()) search_.setArea(wanted);
    search_.run(frame_, relative.T_other_frame, relative.covariance, ofArea(predicted));
}

std::span<const float> EpipolarFlow::ofArea(std::span<const float> cells) {
    if (cells.empty()) return cells;
    const PixelRect& area = search_.area();
    const auto cell = [](int pixel) { return (pixel + kCell - 1) / kCell; };
    predicted_.clear();
    for (int j = cell(area.y0); j < cell(area.y1); ++j) {
        const auto row = cells.subspan(static_cast<std::size_t>(j) * cells_.width, cells_.width);
        predicted_.insert(predicted_.end(), row.begin() + cell(area.x0),
                          row.begin() + cell(area.x1));
    }
    return predicted_;
}

float EpipolarFlow::sAt(int x, int y) const {
    const PixelRect& area = search_.area();
    const int column = std::clamp(x, area.x0, area.x1 - 1) - area.x0;
    const int row = std::clamp(y, area.y0, area.y1 - 1) - area.y0;
    return search_.s()[static_cast<std::size_t>(row) * (area.x1 - area.x0) + column];
}

// Returns where the still shows the point with inverse depth s on a ray of the frame. The result is
// a pixel position in the still after its resampling with the video's lens. It is far outside the
// picture if the point is behind the still camera, or if the still camera's ray to the point is
// almost parallel to the image plane.
EpipolarLens::Point EpipolarFlow::endOf(float rayX, float rayY, float s) const {
    const Eigen::Vector3f& t = search_.translation();
    const Eigen::Vector3f p = rotation_ * Eigen::Vector3f(rayX + s * (t.x() - rayX * t.z()),
                                                          rayY + s * (t.y() - rayY * t.z()), 1);
    if (!(p.z() > kNearPlane)) return {kNowhere, kNowhere};
    const auto q = lens_.project(p.x() / p.z(), p.y() / p.z());
    const bool isNear = std::abs(q.x) < kNowhere && std::abs(q.y) < kNowhere;
    return isNear ? q : EpipolarLens::Point{kNowhere, kNowhere};
}

std::vector<float> EpipolarFlow::flow() const {
    const Size size = rig_.video.size;
    std::vector<float> out;
    out.reserve(2UL * size.width * size.height);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * size.width + x;
            const auto q = endOf(lens_.rayX(i), lens_.rayY(i), sAt(x, y));
            out.push_back(q.x - static_cast<float>(x));
            out.push_back(q.y - static_cast<float>(y));
        }
    }
    return out;
}

simd::FlowEnds EpipolarFlow::flowEnds() const {
    const Eigen::Vector3f& t = search_.translation();
    simd::FlowEnds out{
        lens_.lens(), {{}, {t.x(), t.y(), t.z()}}, static_cast<float>(kNearPlane), kNowhere};
    for (int i = 0; i < 9; ++i)
        out.motion.turn[i] = rotation_(i / 3, i % 3);
    return out;
}

simd::CellRow EpipolarFlow::cellRow(int j, const float* raysX, const float* raysY) const {
    const std::size_t first = static_cast<std::size_t>(j) * cells_.width;
    return {raysX + first, raysY + first, middlesX_.data(), middlesY_[j],
            static_cast<std::size_t>(cells_.width)};
}

const std::vector<float>& EpipolarFlow::sOf(const Cells& flow) {
    aligned_ = s_;
    if (!(search_.pixelsPerUnit() > 0)) return aligned_;
    const auto pixel = static_cast<float>(1 / search_.pixelsPerUnit());
    const simd::FlowEnds ends = flowEnds();
    workers_->forRange(cells_.height, 8, [&](int first, int last) {
        for (int j = first; j < last; ++j) {
            const std::size_t cell = static_cast<std::size_t>(j) * cells_.width;
            simd::alignCells(ends, cellRow(j, cellRays_.raysX().data(), cellRays_.raysY().data()),
                             flow.data() + cell, forward_.data() + cell, pixel, kLeastWay,
                             aligned_.data() + cell);
        }
    });
    return aligned_;
}

float EpipolarFlow::offLine(int x, int y, float flowX, float flowY) const {
    const std::size_t i = static_cast<std::size_t>(y) * rig_.video.size.width + x;
    const float s = sAt(x, y);
    const auto on = endOf(lens_.rayX(i), lens_.rayY(i), s);
    const float dx = static_cast<float>(x) + flowX - on.x,
                dy = static_cast<float>(y) + flowY - on.y;
    if (!(search_.pixelsPerUnit() > 0)) return std::hypot(dx, dy);
    const auto pixel = static_cast<float>(1 / search_.pixelsPerUnit());
    const auto next = endOf(lens_.rayX(i), lens_.rayY(i), s + pixel);
    const float wayX = next.x - on.x, wayY = next.y - on.y, way = std::hypot(wayX, wayY);
    // Near the epipole, a change of depth hardly moves the pixel, so the line counts as a point.
    if (!(way > kLeastWay)) return std::hypot(dx, dy);
    return std::abs(dx * wayY - dy * wayX) / way;
}

void EpipolarFlow::fillForward() {
    const simd::FlowEnds ends = flowEnds();
    workers_->forRange(cells_.height, 8, [&](int first, int last) {
        for (int j = first; j < last; ++j) {
            fillDepths(j);
            const std::size_t cell = static_cast<std::size_t>(j) * cells_.width;
            simd::cellFlow(ends, cellRow(j, middleRaysX_.data(), middleRaysY_.data()),
                           s_.data() + cell, forward_.data() + cell);
            simd::cellLandings(forward_.data() + cell, j, cells_, landing_.data() + cell);
        }
    });
}

// Returns s of a cell from its four central pixels: the mean of the two middle values. A pixel that
// a depth edge separates from the other three does not distort this mean.
float EpipolarFlow::depthOf(int i, int j) const {
    const Middle x = middleOf(i, rig_.video.size.width), y = middleOf(j, rig_.video.size.height);
    std::array<float, 4> s{sAt(x.first, y.first), sAt(x.last, y.first), sAt(x.first, y.last),
                           sAt(x.last, y.last)};
    std::sort(s.begin(), s.end());
    return 0.5F * (s[1] + s[2]);
}

void EpipolarFlow::fillDepths(int j) {
    const PixelRect& area = search_.area();
    float* out = s_.data() + static_cast<std::size_t>(j) * cells_.width;
    const int y = kCell * j;
    int first = (area.x0 + kCell - 1) / kCell, last = area.x1 / kCell;
    if (y < area.y0 || y + kCell > area.y1 || first >= last) first = last = 0;
    for (int i = 0; i < first; ++i)
        out[i] = depthOf(i, j);
    for (int i = last; i < cells_.width; ++i)
        out[i] = depthOf(i, j);
    if (first == last) return;
    const std::ptrdiff_t pitch = area.x1 - area.x0;
    const float* pixels = search_.s().data() + (y - area.y0 + 1) * pitch + kCell * first - area.x0;
    simd::cellDepths(pixels, pixels + pitch, last - first, out + first);
}

void EpipolarFlow::testDepth() {
    std::fill(nearest_.begin(), nearest_.end(), -kNowhere);
    for (std::size_t cell = 0; cell < landing_.size(); ++cell) {
        if (landing_[cell] < 0) continue;
        float& nearest = nearest_[static_cast<std::size_t>(landing_[cell])];
        nearest = std::max(nearest, s_[cell]);
    }
    simd::cellsHidden(landing_.data(), nearest_.data(), s_.data(),
                      {static_cast<float>(search_.pixelsPerUnit()), kSlope, kNowhere},
                      hidden_.size(), hidden_.data());
}

}  // namespace mfar
