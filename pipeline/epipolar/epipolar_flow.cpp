#include "pipeline/epipolar/epipolar_flow.h"

#include "pipeline/epipolar/near_plane.h"
#include "pipeline/flow/cell_field.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr float kNowhere = 1e4F;
constexpr float kLeastWay = 0.05F;  // of a pixel, when the others' longest is one [px]
// Neighbours on one slanted surface that land on the same cell differ by this much [px].
constexpr float kSlope = 1.0F;
// What is searched around what is asked for: room for census windows, paths, and a frame's motion.
constexpr int kRoom = 16;  // [px]

/// What is searched for `where`, in whole cells of 4x4 pixels but at the picture's end.
PixelRect searchedFor(const PixelRect& where, Size video) {
    const PixelRect around = widened(where, kRoom, video);
    const auto down = [](int x) { return x / kRoom * kRoom; };
    const auto up = [](int x, int most) { return std::min((x + kRoom - 1) / kRoom * kRoom, most); };
    return {down(around.x0), down(around.y0), up(around.x1, video.width),
            up(around.y1, video.height)};
}

}  // namespace

EpipolarFlow::EpipolarFlow(const StereoRig& rig, std::shared_ptr<Workers> workers,
                           const EpipolarOptions& options)
    : rig_(rig), cells_(cellsOf(rig.video.size)), search_(rig, workers, options),
      mostPredicted_(options.mostPredicted), prediction_(rig.video), lens_(rig.video, 0),
      cellRays_(rig.video, 2), rotation_(Eigen::Matrix3f::Identity()) {
    if (options.bothWays) twoWay_.emplace(rig, std::move(workers), options);
    const std::size_t count = static_cast<std::size_t>(cells_.width) * cells_.height;
    forward_.resize(count);
    hidden_.resize(count);
    nearness_.resize(count);
    nearest_.resize(count);
}

void EpipolarFlow::setStill(const ImageView& still, const Pose& pose) {
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

void EpipolarFlow::run(const ImageView& video, const Pose& pose, const PixelRect& where) {
    lumaOf(video, luma_);
    const UnitPose relative = unitPose(rig_.T_still_video, *stillPose_, pose);
    unit_ = relative.unit;
    lengthError_ = relative.lengthError;
    search(relative, where);
    // At the video's geometry the still keeps the video's orientation.
    rotation_ = (rig_.T_still_video.rotation.conjugate() * search_.pose().rotation)
                    .toRotationMatrix()
                    .cast<float>();
    fillForward();
    if (twoWay_)
        testBothWays(video);
    else
        testDepth();
    if (search_.pixelsPerUnit() > 0)
        prediction_.keep(nearness_, search_.pose(), unit_);
    else
        prediction_.forget();
}

void EpipolarFlow::search(const UnitPose& relative, const PixelRect& where) {
    const PixelRect wanted = searchedFor(where, rig_.video.size);
    // What comes into the picture, or moves by itself, is found by a search from coarse to fine.
    const bool isNew = around(search_.area(), wanted) != search_.area();
    const auto predicted = predictedFrames_ < mostPredicted_ && !isNew
                               ? prediction_.in(relative.T_other_frame, relative.unit)
                               : std::span<const float>();
    predictedFrames_ = predicted.empty() ? 0 : predictedFrames_ + 1;
    if (predicted.empty()) search_.setArea(wanted);
    search_.run(luma_, relative.T_other_frame, relative.covariance, ofArea(predicted));
}

// The cells of the search's area, of all.
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

// Where nothing was searched, as beside it.
float EpipolarFlow::nearnessAt(int x, int y) const {
    const PixelRect& area = search_.area();
    const int column = std::clamp(x, area.x0, area.x1 - 1) - area.x0;
    const int row = std::clamp(y, area.y0, area.y1 - 1) - area.y0;
    return search_.inverseDepth()[static_cast<std::size_t>(row) * (area.x1 - area.x0) + column];
}

// Where the still, at the video's geometry, shows a ray's point; far outside when it is behind, or
// so close to beside the camera that no number of pixels means anything.
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
            const auto q = endOf(lens_.rayX(i), lens_.rayY(i), nearnessAt(x, y));
            out.push_back(q.x - static_cast<float>(x));
            out.push_back(q.y - static_cast<float>(y));
        }
    }
    return out;
}

const std::vector<float>& EpipolarFlow::inverseDepthOf(const Cells& flow) {
    aligned_ = nearness_;
    if (!(search_.pixelsPerUnit() > 0)) return aligned_;
    const auto pixel = static_cast<float>(1 / search_.pixelsPerUnit());
    for (std::size_t cell = 0; cell < aligned_.size(); ++cell) {
        const float rx = cellRays_.rayX(cell), ry = cellRays_.rayY(cell), s = aligned_[cell];
        const auto next = endOf(rx, ry, s + pixel), on = endOf(rx, ry, s);
        const float wayX = next.x - on.x, wayY = next.y - on.y;
        const float square = wayX * wayX + wayY * wayY;
        if (!(square > kLeastWay * kLeastWay)) continue;
        // Both start in the middle of the cell.
        const float offX = flow[cell][0] - forward_[cell][0],
                    offY = flow[cell][1] - forward_[cell][1];
        aligned_[cell] += pixel * (offX * wayX + offY * wayY) / square;
    }
    return aligned_;
}

float EpipolarFlow::offLine(int x, int y, float flowX, float flowY) const {
    const std::size_t i = static_cast<std::size_t>(y) * rig_.video.size.width + x;
    const float s = nearnessAt(x, y);
    const auto on = endOf(lens_.rayX(i), lens_.rayY(i), s);
    const float dx = static_cast<float>(x) + flowX - on.x,
                dy = static_cast<float>(y) + flowY - on.y;
    if (!(search_.pixelsPerUnit() > 0)) return std::hypot(dx, dy);
    const auto pixel = static_cast<float>(1 / search_.pixelsPerUnit());
    const auto next = endOf(lens_.rayX(i), lens_.rayY(i), s + pixel);
    const float wayX = next.x - on.x, wayY = next.y - on.y, way = std::hypot(wayX, wayY);
    // By the epipole no depth moves the pixel.
    if (!(way > kLeastWay)) return std::hypot(dx, dy);
    return std::abs(dx * wayY - dy * wayX) / way;
}

// The middle two of a cell's four central pixels: an edge between them does not pull it off.
void EpipolarFlow::fillForward() {
    const Size video = rig_.video.size;
    for (int j = 0; j < cells_.height; ++j) {
        for (int i = 0; i < cells_.width; ++i) {
            const int x = std::clamp(kCell * i + 1, 0, std::max(video.width - 2, 0));
            const int y = std::clamp(kCell * j + 1, 0, std::max(video.height - 2, 0));
            const int right = video.width > 1 ? 1 : 0, below = video.height > 1 ? 1 : 0;
            const std::size_t p = static_cast<std::size_t>(y) * video.width + x;
            const std::size_t last = p + static_cast<long>(below) * video.width + right;
            std::array<float, 4> s{nearnessAt(x, y), nearnessAt(x + right, y),
                                   nearnessAt(x, y + below), nearnessAt(x + right, y + below)};
            std::sort(s.begin(), s.end());
            const float nearness = 0.5F * (s[1] + s[2]);
            const float rx = 0.5F * (lens_.rayX(p) + lens_.rayX(last));
            const float ry = 0.5F * (lens_.rayY(p) + lens_.rayY(last));
            const auto q = endOf(rx, ry, nearness);
            const std::size_t cell = static_cast<std::size_t>(j) * cells_.width + i;
            nearness_[cell] = nearness;
            forward_[cell] = {q.x - static_cast<float>(x) - 0.5F * static_cast<float>(right),
                              q.y - static_cast<float>(y) - 0.5F * static_cast<float>(below), 0, 0};
        }
    }
}

// The still's cell that a cell of the video lands on.
std::optional<std::size_t> EpipolarFlow::landing(int i, int j) const {
    const auto& u = forward_[static_cast<std::size_t>(j) * cells_.width + i];
    const float x = static_cast<float>(i) + u[0] / kCell, y = static_cast<float>(j) + u[1] / kCell;
    if (!(x > -0.5F && y > -0.5F && x < static_cast<float>(cells_.width) - 0.5F &&
          y < static_cast<float>(cells_.height) - 0.5F))
        return std::nullopt;
    return static_cast<std::size_t>(std::lround(y)) * cells_.width + std::lround(x);
}

void EpipolarFlow::testDepth() {
    std::fill(nearest_.begin(), nearest_.end(), -kNowhere);
    for (int j = 0; j < cells_.height; ++j)
        for (int i = 0; i < cells_.width; ++i)
            if (const auto to = landing(i, j))
                nearest_[*to] = std::max(nearest_[*to],
                                         nearness_[static_cast<std::size_t>(j) * cells_.width + i]);
    const auto pixels = static_cast<float>(search_.pixelsPerUnit());
    for (int j = 0; j < cells_.height; ++j) {
        for (int i = 0; i < cells_.width; ++i) {
            const std::size_t cell = static_cast<std::size_t>(j) * cells_.width + i;
            const auto to = landing(i, j);
            const float error = to ? (nearest_[*to] - nearness_[cell]) * pixels - kSlope : kNowhere;
            hidden_[cell] = {std::clamp(error, 0.0F, kNowhere), 0, 0, 0};
        }
    }
}

void EpipolarFlow::testBothWays(const ImageView& video) {
    twoWay_->run(search_, video);
    for (int j = 0; j < cells_.height; ++j) {
        for (int i = 0; i < cells_.width; ++i) {
            const std::size_t cell = static_cast<std::size_t>(j) * cells_.width + i;
            const Eigen::Vector2d centre = Eigen::Vector2d(i, j) * kCell;
            const Eigen::Vector2d ray = rig_.video.unproject(centre.array() + 0.5 * (kCell - 1));
            const float error = twoWay_->error(ray, nearness_[cell]).value_or(kNowhere);
            hidden_[cell] = {std::min(error, kNowhere), 0, 0, 0};
        }
    }
}

}  // namespace mfar
