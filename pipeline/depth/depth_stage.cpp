#include "pipeline/depth/depth_stage.h"

#include "pipeline/flow/cell_field.h"

#include <algorithm>
#include <cmath>

namespace mfar {
namespace {

constexpr int kCell = 4;
constexpr int kSampleStep = 5;     // [px]
constexpr double kSameView = 0.3;  // [px]
constexpr double kNearest = 0.01;  // [m]
// A keyframe is worth a search when it sees so many times the still's parallax.
constexpr double kWorth = 2;
// A search starts from what is known when so much of the picture is.
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
      measurement_(video, workers), filter_(video, std::move(workers)), measured_(video.size) {}

void DepthStage::forget() {
    filter_.forget();
    keyframes_.forget();
    searchedKey_ = -1;
    last_.reset();
    measuredPose_.reset();
    source_ = DepthSource::None;
}

void DepthStage::run(const LumaImage& luma, const Pose& pose,
                     const std::optional<StillSearch>& still, const PixelRect& where) {
    const double seconds = last_ ? static_cast<double>((pose.time - *last_).count()) * 1e-9 : 0;
    last_ = pose.time;
    filter_.predict(pose.T_world_video, seconds);
    const Summary before = summaryOf(where, pose);
    source_ = before.share < 1 ? DepthSource::Carried : DepthSource::None;
    if (!seesMore(pose, before.rho)) return;
    if (still && still->search.pixelsPerUnit() > 0) {
        measurement_.run(still->search, still->R_still_video, still->unit, still->cells, where,
                         measured_);
        filter_.fuse(measured_, where);
        source_ = DepthSource::Still;
    }
    const Summary now = summaryOf(where, pose);
    const double brightness = brightnessOf(luma);
    const auto choice = keyframes_.choose(pose, brightness, now.rho);
    const double stillAngle = still ? still->unit * now.rho : 0;
    if (choice && now.share > options_.enough && choice->angle > kWorth * stillAngle)
        searchKeyframe(luma, pose, *choice, where);
    keyframes_.add(luma, pose, brightness, now.rho);
}

// The same view measured again would only make its errors look smaller.
bool DepthStage::seesMore(const Pose& pose, double rho) {
    if (measuredPose_) {
        const RigidTransform T = measuredPose_->inverse() * pose.T_world_video;
        const double turn = 2 * T.rotation.vec().norm();
        if (focal_ * (turn + rho * T.translation.norm()) < kSameView) return false;
    }
    measuredPose_ = pose.T_world_video;
    return true;
}

void DepthStage::searchKeyframe(const LumaImage& luma, const Pose& pose,
                                const Keyframes::Choice& choice, const PixelRect& where) {
    if (choice.frame->number != searchedKey_) {
        search_.setStill(viewOf(choice.frame->luma));
        searchedKey_ = choice.frame->number;
    }
    const UnitPose relative = unitPose({}, choice.frame->pose, pose);
    if (!search_.run(luma, relative.T_other_frame, relative.covariance, predicted(relative)))
        return;
    const Eigen::Matrix3f R = search_.pose().rotation.toRotationMatrix().cast<float>();
    measurement_.run(search_, R, relative.unit, {}, where, measured_);
    filter_.fuse(measured_, where);
    source_ = source_ == DepthSource::Still ? DepthSource::Both : DepthSource::Keyframe;
}

// s of every cell as the search counts it; empty when too little is known to start from.
std::span<const float> DepthStage::predicted(const UnitPose& relative) {
    const InverseDepthField& field = filter_.field();
    const Size cells = cellsOf(field.size);
    const double z =
        (relative.T_other_frame.rotation.conjugate() * relative.T_other_frame.translation).z();
    predicted_.clear();
    int known = 0;
    float last = 0;  // beside what is not known
    for (int j = 0; j < cells.height; ++j) {
        for (int i = 0; i < cells.width; ++i) {
            const int x = std::min(kCell * i + 2, field.size.width - 1);
            const int y = std::min(kCell * j + 2, field.size.height - 1);
            const auto p = static_cast<std::size_t>(y) * field.size.width + x;
            if (field.isKnown(p)) {
                const double rho = field.rho[p] * relative.unit;
                last = static_cast<float>(rho / (1 + rho * z));
                ++known;
            }
            predicted_.push_back(last);
        }
    }
    if (known < kMostlyKnown * static_cast<double>(predicted_.size())) return {};
    return predicted_;
}

DepthStage::Summary DepthStage::summaryOf(const PixelRect& where, const Pose& pose) {
    const InverseDepthField& field = filter_.field();
    Summary out;
    samples_.clear();
    std::vector<float> shares;
    for (int y = where.y0; y < where.y1; y += kSampleStep) {
        for (int x = where.x0; x < where.x1; x += kSampleStep) {
            const auto i = static_cast<std::size_t>(y) * field.size.width + x;
            if (!field.isKnown(i) || !(field.rho[i] > 0)) continue;
            samples_.push_back(field.rho[i]);
            shares.push_back(std::sqrt(field.variance[i]) / field.rho[i]);
        }
    }
    // The world's origin, where a tag is, as long as nothing is known.
    out.rho = 1 / std::max(pose.T_world_video.translation.norm(), kNearest);
    if (samples_.empty()) return out;
    out.rho = medianOf(samples_);
    out.share = std::min(medianOf(shares), 1.0);
    return out;
}

}  // namespace mfar
