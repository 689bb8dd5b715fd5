#include "pipeline/epipolar/epipolar_search.h"

#include "pipeline/epipolar/census.h"
#include "pipeline/flow/cell_field.h"
#include "pipeline/simd/luma_filters.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace mfar {
namespace {

// A pyramid level is left out if its shorter side would be less than this [px].
constexpr int kCoarsest = 60;
// Number of labels beyond infinity (s < 0) at the finest pyramid level. They are searched, because
// noise and pose errors can move the match of a distant point there.
constexpr int kBeyond = 4;
constexpr int kSmallestCanvas = 16;
constexpr int kMostStep = 30;
constexpr int kPredictedLevel = 2;  // a pixel of this pyramid level is a cell

Smoothness smoothnessFor(double noise, const EpipolarOptions& options) {
    const int step = options.stepPenalty;
    return {.step = std::clamp(static_cast<int>(step - 2 + 4.5 * noise), step, kMostStep),
            .jump = options.jumpPenalty,
            .noise = 2 * noise};
}

// Returns the weight of each neighbour in the 3-pixel filter that smooths pictures before the
// census. Up to a noise of one grey level, the weight is 0, because smoothing clean pictures causes
// a third more wrong pixels. From about two grey levels on, it is 1/4, as in the binomial filter.
float smoothingFor(double noise) {
    return static_cast<float>(std::clamp(0.2 * (noise - 1.0), 0.0, 0.25));
}

int levelsFor(Size size, const EpipolarOptions& options) {
    int levels = 1;
    while (levels < options.levels && std::min(size.width, size.height) / 2 >= kCoarsest) {
        size = {(size.width + 1) / 2, (size.height + 1) / 2};
        ++levels;
    }
    return levels;
}

std::size_t pixelsOf(Size size) {
    return static_cast<std::size_t>(size.width) * size.height;
}

std::size_t mostVectors(Size size, const EpipolarOptions& options) {
    const std::size_t finest = pixelsOf(size);
    const double longest = options.longestParallax * size.width;
    int scale = 1;
    for (int i = levelsFor(size, options); i > 1; --i) {
        size = {(size.width + 1) / 2, (size.height + 1) / 2};
        scale *= 2;
    }
    const double labels = longest / scale + kBeyond + 1;
    const auto coarsest = static_cast<std::size_t>(std::ceil(labels / SemiGlobal::kLabels));
    return std::max(finest, coarsest * pixelsOf(size));
}

/// Clamps a label to the searched range. NaN becomes the smallest label.
float soundLabel(float label, float longest) {
    return label > -kBeyond ? std::min(label, longest) : static_cast<float>(-kBeyond);
}

// If at least this number of patches is matched, normalError() is the median of their distances
// from the epipolar lines. Otherwise, it is computed from the covariance of the pose.
constexpr int kEnoughPatches = 16;

double normalErrorOf(const Matrix6& covariance, double focal) {
    constexpr double kNoLine = 1e6;
    const double variance = covariance.topLeftCorner<3, 3>().trace() / 3;
    return variance > 0 ? std::min(focal * std::sqrt(variance), kNoLine) : 0;
}

std::size_t coarseIndex(const Eigen::Vector2d& pixel, Size size, int level) {
    const double scale = 1 << level;
    const int x = std::min(static_cast<int>((pixel.x() + 0.5) / scale), size.width - 1);
    const int y = std::min(static_cast<int>((pixel.y() + 0.5) / scale), size.height - 1);
    return static_cast<std::size_t>(y) * size.width + x;
}

CameraModel partOf(CameraModel camera, const PixelRect& pixels) {
    camera.size = {pixels.x1 - pixels.x0, pixels.y1 - pixels.y0};
    camera.cx -= pixels.x0;
    camera.cy -= pixels.y0;
    return camera;
}

}  // namespace

CameraModel atScaleOf(const StereoRig& rig) {
    const auto scaled = [](int pixels, double ratio) {
        return std::max(2, static_cast<int>(std::lround(pixels * std::min(ratio, 1.0))));
    };
    return rig.still.scaledTo({scaled(rig.still.size.width, rig.video.fx / rig.still.fx),
                               scaled(rig.still.size.height, rig.video.fy / rig.still.fy)});
}

EpipolarSearch::EpipolarSearch(const StereoRig& rig, std::shared_ptr<Workers> workers,
                               const EpipolarOptions& options)
    : options_(validated(options)), whole_(rig.video), video_(rig.video), still_(atScaleOf(rig)),
      workers_(std::move(workers)), matcher_(mostVectors(rig.video.size, options)) {
    for (int i = 0; i < levelsFor(whole_.size, options_); ++i) {
        lenses_.emplace_back(whole_, i);
        levels_.push_back({lenses_.back(), {}, {}, {}, {}, {}, {}, {}, {}, {}, {}});
    }
    setArea({0, 0, whole_.size.width, whole_.size.height});
}

void EpipolarSearch::setArea(const PixelRect& pixels) {
    const int grid = 1 << (levels_.size() - 1);
    const auto up = [&](int x, int most) { return std::min((x + grid - 1) / grid * grid, most); };
    const PixelRect area{pixels.x0 / grid * grid, pixels.y0 / grid * grid,
                         up(pixels.x1, whole_.size.width), up(pixels.y1, whole_.size.height)};
    assert(area.x0 >= 0 && area.y0 >= 0 && !area.empty());
    if (area == area_) return;
    area_ = area;
    video_ = partOf(whole_, area);
    for (std::size_t l = 0; l < levels_.size(); ++l) {
        Level& level = levels_[l];
        const int scale = 1 << l;
        level.lens.cover(lenses_[l],
                         {area.x0 / scale, area.y0 / scale, (area.x1 + scale - 1) / scale,
                          (area.y1 + scale - 1) / scale});
        const std::size_t count = pixelsOf(level.lens.size());
        level.videoCensus.resize(count);
        level.base.resize(count);
        level.labels.resize(count);
    }
    s_.resize(levels_[0].labels.size());
    scratch_.resize(s_.size());
    valleys_.resize(s_.size());
}

void EpipolarSearch::setStill(const ImageView& still) {
    shrinkLuma(still, still_.size, *workers_, picture_);
    stillNoise_ = noiseOf(picture_);
}

void EpipolarSearch::setStill(const Rows<const std::uint8_t>& still) {
    shrinkLuma(still, still_.size, *workers_, picture_);
    stillNoise_ = noiseOf(picture_);
}

bool EpipolarSearch::run(const Rows<const std::uint8_t>& video, const RigidTransform& T_still_video,
                         const std::optional<Matrix6>& covariance,
                         std::span<const float> predicted) {
    assert(predicted.empty() || predicted.size() == pixelsOf(cellsOf(video_.size)));
    cut(video, area_, levels_[0].video);
    videoNoise_ = noiseOf(levels_[0].video);
    refinement_ = {};
    normalError_ = 0;
    // If s is predicted, the search needs only the pyramid levels from 0 (full size) to
    // finestLevel(). Matching patches needs levels 0 and 1.
    const int all = static_cast<int>(levels_.size());
    const int searched = predicted.empty() ? all : finestLevel() + 1;
    const int drawn = covariance ? std::min(std::max(searched, 2), all) : searched;
    for (int l = 1; l < drawn; ++l)
        halve(levels_[l - 1].video, levels_[l].video);
    const bool found = place(T_still_video, drawn) && matchAll(covariance, predicted, searched);
    if (!found || !(pixelsPerUnit_ > 0)) std::fill(s_.begin(), s_.end(), 0.0F);
    return found;
}

bool EpipolarSearch::matchAll(const std::optional<Matrix6>& covariance,
                              std::span<const float> predicted, int levels) {
    if (predicted.empty()) searchCoarsest();
    if (covariance) refine(*covariance, predicted);
    if (refinement_.accepted && !place(pose_ * refinement_.motion, levels)) return false;
    const bool again = refinement_.accepted || hasSlack(static_cast<int>(levels_.size()) - 1);
    if (again && predicted.empty()) searchCoarsest();
    if (!(pixelsPerUnit_ > 0)) return true;
    if (predicted.empty())
        searchFiner();
    else
        searchAround(predicted);
    readInverseDepth();
    return true;
}

int EpipolarSearch::finestLevel() const {
    return std::min(options_.finest, static_cast<int>(levels_.size()) - 1);
}

// Gives each full-size pixel the s of the pixel of finestLevel() that contains it. If finestLevel()
// has half size, this suffices for the flow of cells: the four middle pixels of a cell lie in four
// different pixels of half size.
void EpipolarSearch::readInverseDepth() {
    const int finest = finestLevel();
    const Level& level = levels_[finest];
    const auto perLabel = static_cast<float>((1 << finest) / pixelsPerUnit_);
    if (finest == 0) {
        median3x3(level.labels, level.lens.size(), *workers_, s_, perLabel);
        return;
    }
    median3x3(level.labels, level.lens.size(), *workers_, scratch_, perLabel);
    const Size size = levels_[0].lens.size();
    const int columns = level.lens.size().width;
    workers_->forRange(size.height, 32, [&](int first, int last) {
        for (int y = first; y < last; ++y) {
            const float* from = scratch_.data() + static_cast<std::size_t>(y >> finest) * columns;
            float* to = s_.data() + static_cast<std::size_t>(y) * size.width;
            for (int x = 0; x < size.width; ++x)
                to[x] = from[x >> finest];
        }
    });
}

bool EpipolarSearch::place(const RigidTransform& told, int levels) {
    const std::optional<RigidTransform> T_still_video = soundMotion(told);
    pose_ = T_still_video.value_or(RigidTransform{});
    const Eigen::Matrix3d R_still_video = pose_.rotation.toRotationMatrix();
    translation_ = (R_still_video.transpose() * pose_.translation).cast<float>();
    labels_ = 0;
    pixelsPerUnit_ = 0;
    if (!T_still_video || !turnStill(R_still_video, levels)) return false;
    measureParallax();
    if (pixelsPerUnit_ > 0)
        labels_ = static_cast<int>(options_.longestParallax * whole_.size.width);
    return true;
}

// Refines the pose by matching patches, which needs s. Predicted s was computed with refined poses
// and is accurate enough. Without a prediction, s comes from the coarsest pyramid level. Its pixels
// are so large that the epipolar lines of the unrefined pose still pass through the matches.
void EpipolarSearch::refine(const Matrix6& covariance, std::span<const float> predicted) {
    const PosePrior prior{translation_.cast<double>(), covariance};
    const Level& half = levels_[std::min<std::size_t>(1, levels_.size() - 1)];
    const double noise = std::max(videoNoise_, stillNoise_);
    const auto sAt = [&](const Eigen::Vector2d& pixel) {
        if (!predicted.empty()) {
            const float s = predicted[coarseIndex(pixel, cellsOf(video_.size), kPredictedLevel)];
            const double perUnit = std::max(pixelsPerUnit_, 1e-12);
            return soundLabel(static_cast<float>(s * perUnit), static_cast<float>(labels_)) /
                   perUnit;
        }
        const int coarsest = static_cast<int>(levels_.size()) - 1;
        return levels_.back().labels[coarseIndex(pixel, levels_.back().lens.size(), coarsest)] *
               (1 << coarsest) / pixelsPerUnit_;
    };
    const auto matches = matchPatches(levels_[0].pair(), half.pair(),
                                      {video_, prior, noise, pixelsPerUnit_, sAt}, *workers_);
    refinement_ = refineRelativePose(matches, prior, video_.fx);
    normalError_ = refinement_.patches < kEnoughPatches ? normalErrorOf(covariance, video_.fx)
                                                        : refinement_.normalAfter;
}

// Resamples the still as the video camera would show it from the still camera's position, in the
// frame's orientation. This needs no depth, because only the orientation changes. The result
// extends beyond the searched part of the frame by up to the longest parallax on each side.
bool EpipolarSearch::turnStill(const Eigen::Matrix3d& R_still_video, int levels) {
    const double beyond = options_.longestParallax * whole_.size.width / video_.size.width;
    turned_.place(video_, whole_, still_, R_still_video, beyond);
    if (turned_.size().width < kSmallestCanvas || turned_.size().height < kSmallestCanvas)
        return false;
    Level& fine = levels_[0];
    turned_.draw(picture_, *workers_, fine.still, fine.seen);
    fine.origin = turned_.origin();
    for (int l = 1; l < levels; ++l) {
        const Level& finer = levels_[l - 1];
        Level& level = levels_[l];
        halve(finer.still, level.still);
        level.origin = {finer.origin.x / 2, finer.origin.y / 2};
        const Size s = level.still.size;
        level.seen.resize(static_cast<std::size_t>(s.width) * s.height);
        for (int y = 0; y < s.height; ++y)
            simd::thinRow(finer.seen.data() +
                              static_cast<std::size_t>(2 * y) * finer.still.size.width,
                          s.width, level.seen.data() + static_cast<std::size_t>(y) * s.width);
    }
    return true;
}

// Computes pixelsPerUnit_. A label is a step of s by 1 / pixelsPerUnit_, so no pixel moves by more
// than one pixel per label.
void EpipolarSearch::measureParallax() {
    const EpipolarLens& lens = levels_[0].lens;
    const Size size = lens.size();
    const Eigen::Vector3f& t = translation_;
    const float norm = t.norm();
    if (!(norm > 1e-12F)) return;
    const float small = 1e-3F / norm;
    for (int j = 0; j <= 8; ++j) {
        for (int i = 0; i <= 8; ++i) {
            const std::size_t p = static_cast<std::size_t>(j * (size.height - 1) / 8) * size.width +
                                  i * (size.width - 1) / 8;
            const float x = lens.rayX(p), y = lens.rayY(p);
            const auto a = lens.project(x, y);
            const auto b =
                lens.project(x + small * (t.x() - x * t.z()), y + small * (t.y() - y * t.z()));
            pixelsPerUnit_ = std::max(
                pixelsPerUnit_, static_cast<double>(std::hypot(b.x - a.x, b.y - a.y) / small));
        }
    }
}

void EpipolarSearch::prepare(int index) {
    Level& level = levels_[index];
    const double noise = std::max(videoNoise_, stillNoise_) / (1 << index);
    const float both = smoothingFor(noise);
    const LumaImage* video = &level.video;
    const LumaImage* still = &level.still;
    if (both > 0) {
        smooth(level.video, both, level.smoothVideo);
        smooth(level.still, both, level.smoothStill);
        video = &level.smoothVideo;
        still = &level.smoothStill;
    }
    const Size canvas = still->size;
    level.stillCensus.resize(static_cast<std::size_t>(canvas.width) * canvas.height);
    workers_->forRange(video->size.height, 8, [&](int first, int last) {
        census(*video, first, last, level.videoCensus);
    });
    workers_->forRange(canvas.height, 8, [&](int first, int last) {
        census(*still, first, last, level.stillCensus, level.seen.data());
    });
}

void EpipolarSearch::searchCoarsest() {
    if (!(pixelsPerUnit_ > 0)) return;
    const int index = static_cast<int>(levels_.size()) - 1;
    Level& level = levels_[index];
    prepare(index);
    const int beyond = (kBeyond + (1 << index) - 1) >> index;
    std::fill(level.base.begin(), level.base.end(), static_cast<std::int16_t>(-beyond));
    match(index, ((labels_ >> index) + beyond + SemiGlobal::kLabels - 1) / SemiGlobal::kLabels);
}

void EpipolarSearch::searchFiner() {
    for (int i = static_cast<int>(levels_.size()) - 2; i >= finestLevel(); --i) {
        const Level& coarse = levels_[i + 1];
        prepare(i);
        centreWindows({coarse.labels, coarse.lens.size(), 2, 1}, levels_[i]);
        match(i, 1);
    }
}

void EpipolarSearch::searchAround(std::span<const float> predicted) {
    const auto labelsPerUnit = static_cast<float>(pixelsPerUnit_);
    const auto longest = static_cast<float>(labels_);
    predicted_.clear();
    for (const float s : predicted)
        predicted_.push_back(soundLabel(s * labelsPerUnit, longest));
    const int finest = finestLevel();
    prepare(finest);
    centreWindows({predicted_, cellsOf(video_.size), 1.0F / static_cast<float>(1 << finest),
                   kPredictedLevel - finest},
                  levels_[finest]);
    match(finest, 1);
}

void EpipolarSearch::match(int index, int vectors) {
    Level& level = levels_[index];
    matcher_.run(
        level.video, level.base, vectors,
        smoothnessFor(std::max(videoNoise_, stillNoise_), options_),
        [&](int y, std::uint8_t* out) { costRow(index, vectors, y, out); }, *workers_,
        std::span(valleys_).first(level.labels.size()));
    if (index > finestLevel())
        simd::labelVertices(valleys_.data(), level.labels.size(), level.labels.data());
    else
        placeLabels(index);
}

// Chooses the window of labels that each pixel searches. The window is centred on the range of the
// approximate labels around the pixel, see Coarser. If this range plus kRoom labels on both sides
// does not fit into the window, the window is the part of the widened range around the pixel's own
// approximate label.
void EpipolarSearch::centreWindows(const Coarser& coarse, Level& fine) {
    constexpr int kRoom = 2;
    const Size from = coarse.size, to = fine.lens.size();
    const float scale = coarse.scale;
    median3x3(coarse.labels, from, *workers_, scratch_);
    localRange(scratch_, from, options_.windowRadius, range_);
    for (std::size_t i = 0; i < coarse.labels.size(); ++i) {
        constexpr float kHalf = SemiGlobal::kLabels / 2.0F - kRoom;
        const float low = scale * range_.low[i], high = scale * range_.high[i];
        const float centre = high - low < 2 * kHalf
                                 ? 0.5F * (low + high)
                                 : std::clamp(scale * scratch_[i], low + kHalf, high - kHalf);
        range_.low[i] = std::round(centre - 0.5F * (SemiGlobal::kLabels - 1));
    }
    const int side = 1 << coarse.shift;
    workers_->forRange((to.height + side - 1) / side, 4, [&](int first, int last) {
        for (int j = first; j < last; ++j) {
            const float* low = range_.low.data() + static_cast<std::size_t>(j) * from.width;
            std::int16_t* row = fine.base.data() + static_cast<std::size_t>(j) * side * to.width;
            for (int x = 0; x < to.width; ++x)
                row[x] = static_cast<std::int16_t>(low[x >> coarse.shift]);
            for (int k = 1; k < std::min(side, to.height - j * side); ++k)
                std::copy_n(row, to.width, row + static_cast<std::ptrdiff_t>(k) * to.width);
        }
    });
}

}  // namespace mfar
