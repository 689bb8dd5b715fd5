#include "pipeline/depth/depth_stage.h"

#include "pipeline/flow/cell_field.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr int kSampleStep = 5;  // distance between the pixels that summaryOf() samples [px]
// Largest width and height of a part of the picture [px]. Each part has its own keyframe.
constexpr int kPart = 160;
// The searched area is larger than the requested one by this margin on each side [px], because
// pixels of the margin influence the results at the border of the requested area.
constexpr int kSupport = 24;
constexpr double kSameView = 0.3;  // smallest motion of the picture that counts as a new view [px]
constexpr double kNearest = 0.01;  // smallest distance that is assumed for the scene [m]
// A keyframe is used only if its parallax exceeds this multiple of the parallax between frame and
// still.
constexpr double kWorth = 2;
// Depth is measured only if the relative error of the baseline (the distance between the two camera
// positions) is below this. Depth has the same relative error as the baseline.
constexpr double kMostLengthError = 0.15;
// If at least this share of the pixels has a known depth, a search starts from the known depths.
constexpr double kMostlyKnown = 0.97;

double medianOf(std::vector<float>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

DepthStage::DepthStage(const CameraModel& video, std::shared_ptr<Workers> workers,
                       const DepthOptions& options)
    : options_(validated(options)), focal_(std::max(video.fx, video.fy)),
      keyframes_(video, options.keyframes), search_({video, video, {}}, workers, options.search),
      measurement_(video, search_.videoLens(), workers),
      filter_(video, search_.videoLens(), std::move(workers)), measured_(video.size) {}

void DepthStage::forget() {
    filter_.forget();
    keyframes_.forget();
    searchedKey_ = -1;
    last_.reset();
    measuredPose_.reset();
    source_ = DepthSource::None;
}

void DepthStage::run(const Rows<const std::uint8_t>& luma, const Pose& pose,
                     const std::optional<StillSearch>& still, const PixelRect& where) {
    if (world_ != pose.world) forget();
    world_ = pose.world;
    const double seconds = last_ ? secondsBetween(*last_, pose.time) : 0;
    last_ = pose.time;
    filter_.predict(pose.T_world_video, seconds);
    const Summary before = summaryOf(where, pose);
    source_ = before.share < 1 ? DepthSource::Carried : DepthSource::None;
    const double brightness = brightnessOf(luma);
    const bool moved = hasMoved(pose, before.inverseDepth);
    const bool rechecks = !moved && isRenewed_;  // a new still shows the same view once more
    if (!where.empty() && (moved || rechecks || !isMeasured(where))) {
        fixed_.clear();
        if (!moved && !rechecks) fixKnown(where);
        if (still && still->search.pixelsPerUnit() > 0 && still->lengthError < kMostLengthError) {
            measurement_.run(still->search, still->R_still_video, still->unit, still->cells, where,
                             measured_);
            if (rechecks) filter_.forgetContradicted(measured_, where);
            filter_.fuse(measured_, where, fixed_);
            source_ = DepthSource::Still;
        }
        // While the camera rests, a keyframe brings no new evidence, unlike a new still. So the
        // keyframe must not change known depths.
        if (rechecks) fixKnown(where);
        findNeeds(pose, brightness, source_ == DepthSource::Still ? still->unit : 0, where);
        searchKeyframe(luma, pose);
        if (source_ != DepthSource::None && source_ != DepthSource::Carried) {
            if (moved || rechecks) measuredPose_ = pose.T_world_video;
            measuredWhere_ = where;
            isRenewed_ = isLost_ = false;
        }
    }
    keyframes_.add(luma, pose, brightness, before.inverseDepth);
}

void DepthStage::forget(const PixelRect& where) {
    filter_.forget(where);
    // Outside of the measured rectangle, no depth is needed. If it is needed later, the rectangle
    // grows, and its new part is measured anyway.
    isLost_ = isLost_ || !common(where, measuredWhere_).empty();
}

// True if the view differs from the view of the last measurement.
bool DepthStage::hasMoved(const Pose& pose, double inverseDepth) const {
    if (!measuredPose_) return true;
    const RigidTransform T = measuredPose_->inverse() * pose.T_world_video;
    const double turn = 2 * T.rotation.vec().norm();
    return focal_ * (turn + inverseDepth * T.translation.norm()) >= kSameView;
}

bool DepthStage::isMeasured(const PixelRect& where) const {
    return !isLost_ && around(measuredWhere_, where) == measuredWhere_;
}

// Fixes the known depths, so that the next measurement does not change them. Measuring the same
// view again would repeat the same errors, but the filter would take them for new evidence and
// reduce the variance.
void DepthStage::fixKnown(const PixelRect& where) {
    const InverseDepthField& field = filter_.field();
    fixed_.assign(field.inverseDepth.size(), 0);
    for (int y = where.y0; y < where.y1; ++y)
        for (int x = where.x0; x < where.x1; ++x) {
            const auto i = static_cast<std::size_t>(y) * field.size.width + x;
            fixed_[i] = field.isKnown(i) ? 1 : 0;
        }
}

// Finds the parts of the picture for which a keyframe would give a more accurate depth, and chooses
// a keyframe for each of these parts. One keyframe does not suit all parts: when the camera moves
// forwards, most keyframes have no parallax in the area straight ahead.
void DepthStage::findNeeds(const Pose& pose, double brightness, double stillBaseline,
                           const PixelRect& where) {
    const int columns = (where.x1 - where.x0 + kPart - 1) / kPart;
    const int rows = (where.y1 - where.y0 + kPart - 1) / kPart;
    const auto edge = [](int from, int to, int i, int count) {
        return from + (to - from) * i / count;
    };
    needs_.clear();
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const PixelRect part{
                edge(where.x0, where.x1, i, columns), edge(where.y0, where.y1, j, rows),
                edge(where.x0, where.x1, i + 1, columns), edge(where.y0, where.y1, j + 1, rows)};
            const Summary summary = summaryOf(part, pose);
            if (summary.share <= options_.enough) continue;
            const auto choice = keyframes_.choose(pose, brightness, part, summary.inverseDepth);
            if (choice && choice->angle > kWorth * stillBaseline * summary.inverseDepth)
                needs_.push_back({part, summary.share, *choice});
        }
    }
}

// Measures depth with the keyframe that findNeeds() chose for the most uncertain part of the
// picture. The measured rectangle contains all parts for which this keyframe was chosen.
void DepthStage::searchKeyframe(const Rows<const std::uint8_t>& luma, const Pose& pose) {
    if (needs_.empty()) return;
    const auto knowsMore = [](const Need& a, const Need& b) { return a.share < b.share; };
    const Keyframe& frame =
        *std::max_element(needs_.begin(), needs_.end(), knowsMore)->choice.frame;
    PixelRect where;
    for (const Need& need : needs_)
        if (need.choice.frame == &frame) where = around(where, need.part);
    const UnitPose relative = unitPose({}, frame.pose, pose);
    if (!(relative.lengthError < kMostLengthError)) return;
    if (frame.number != searchedKey_) {
        search_.setStill(frame.luma);
        searchedKey_ = frame.number;
    }
    search_.setArea(widened(where, kSupport, luma.size));
    if (!search_.run(luma, relative.T_other_frame, relative.covariance, predicted(relative, where)))
        return;
    const Eigen::Matrix3f R = search_.pose().rotation.toRotationMatrix().cast<float>();
    measurement_.run(search_, R, relative.unit, {}, where, measured_);
    filter_.fuse(measured_, where, fixed_);
    source_ = source_ == DepthSource::Still ? DepthSource::Both : DepthSource::Keyframe;
}

// Returns the inverse depth s (see EpipolarLens) of every cell of the search's area, as predicted
// from the known depth, in the search's unit of length. The result is empty if too few pixels of
// `where` have a known depth.
std::span<const float> DepthStage::predicted(const UnitPose& relative, const PixelRect& where) {
    const InverseDepthField& field = filter_.field();
    const PixelRect& area = search_.area();
    const double z =
        (relative.T_other_frame.rotation.conjugate() * relative.T_other_frame.translation).z();
    predicted_.clear();
    int inside = 0, known = 0;
    float last = 0;
    for (int y = area.y0 + kCell / 2; y < area.y1 + kCell / 2; y += kCell) {
        for (int x = area.x0 + kCell / 2; x < area.x1 + kCell / 2; x += kCell) {
            const int row = std::min(y, area.y1 - 1), column = std::min(x, area.x1 - 1);
            const auto p = static_cast<std::size_t>(row) * field.size.width + column;
            const bool counts =
                column >= where.x0 && column < where.x1 && row >= where.y0 && row < where.y1;
            if (counts) ++inside;
            if (field.isKnown(p)) {
                const double inverseDepth = field.inverseDepth[p] * relative.unit;
                last = static_cast<float>(inverseDepth / (1 + inverseDepth * z));
                if (counts) ++known;
            }
            predicted_.push_back(last);
        }
    }
    if (known < kMostlyKnown * inside) return {};
    return predicted_;
}

DepthStage::Summary DepthStage::summaryOf(const PixelRect& where, const Pose& pose) {
    const InverseDepthField& field = filter_.field();
    Summary out;
    samples_.clear();
    shares_.clear();
    for (int y = where.y0; y < where.y1; y += kSampleStep) {
        for (int x = where.x0; x < where.x1; x += kSampleStep) {
            const auto i = static_cast<std::size_t>(y) * field.size.width + x;
            if (!field.isKnown(i) || !(field.inverseDepth[i] > 0)) continue;
            samples_.push_back(field.inverseDepth[i]);
            shares_.push_back(std::sqrt(field.variance[i]) / field.inverseDepth[i]);
        }
    }
    // If no depth is known, the distance to the world's origin is used instead, because a tag is
    // usually near the origin.
    out.inverseDepth = 1 / std::max(pose.T_world_video.translation.norm(), kNearest);
    if (samples_.empty()) return out;
    out.inverseDepth = medianOf(samples_);
    out.share = std::min(medianOf(shares_), 1.0);
    return out;
}

}  // namespace mfar
