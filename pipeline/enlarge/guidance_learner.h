#pragma once

#include "pipeline/enlarge/class_sums.h"
#include "pipeline/enlarge/filter_bank.h"
#include "pipeline/enlarge/matched_pictures.h"
#include "pipeline/enlarge/trusted_pairs.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <stop_token>

namespace mfar::enlarge {

/// Sums over sub-pixels from which the factors of Guidance are fitted by least squares. They are
/// sums of products of five values. The first four, the parts, are changes of the drawn frame:
///
/// Still: the detail that the still would add, for Guidance::still = 1
/// Video: the video's own detail that would be removed, for Guidance::video = 1
/// Light: the change because the mean of the still becomes brighter, for Guidance::light = 1
/// LightOfStill: the change of Still by the same brighter mean
///
/// The fifth value is what the frame misses: the new still minus the frame as drawn without
/// guidance. The fit approximates it by a sum of the parts with the weights still, video, light and
/// light * still.
class FactorSums {
public:
    enum Part : std::uint8_t { Still, Video, Light, LightOfStill };
    static constexpr int kParts = LightOfStill + 1;
    using Parts = Eigen::Matrix<double, kPhases, kParts>;

    void add(const Parts& parts, const Phases& missing);
    void add(const FactorSums& other);
    void fade(double share);
    [[nodiscard]] double missing2() const { return missing2_; }
    [[nodiscard]] double pixels() const { return pixels_; }
    [[nodiscard]] bool isFinite() const;
    /// Returns by how much the sum of squared errors decreases with the guidance `of`.
    [[nodiscard]] double gainOf(const Guidance& of) const;
    /// Returns the factors with the largest gainOf(), and light = 0 if not `fitsLight`. The prior
    /// of the fit is zero guidance. It counts as much as `prior` pixels.
    [[nodiscard]] Guidance best(double prior, bool fitsLight) const;

    /// All sums, to be stored. The first kOldNumbers do not contain the parts of the light.
    static constexpr std::size_t kNumbers = 16, kOldNumbers = 7;
    [[nodiscard]] std::array<double, kNumbers> stored() const;
    /// Returns false, and changes nothing, if a number is out of range.
    [[nodiscard]] bool restore(const std::array<double, kNumbers>& numbers);

private:
    using Weights = Eigen::Matrix<double, kParts, 1>;
    [[nodiscard]] Guidance withLight(double light, double prior) const;
    [[nodiscard]] double lightFor(const Guidance& of, double prior) const;

    Eigen::Matrix<double, kParts, kParts> products_ = decltype(products_)::Zero();
    Weights withMissing_ = Weights::Zero();
    double missing2_ = 0, pixels_ = 0;
};

/// Learns FilterBank::guidance(). A new still shows what a frame that was drawn with an older still
/// should have looked like. Guidance is the set of factors with which the frame would have been
/// most similar to the new still. The method is recursive least squares with forgetting, and its
/// prior is zero guidance. Some tiles are used for a check and not for learning: guidance is used
/// only while it makes these tiles more similar to the new stills.
///
/// The weight of the whole detail of a still (LookUpCell::weight) is not learned in this way.
/// Warping removes a part of a still's finest detail, so the warped new still has less detail than
/// the scene. A learned weight would be too low by 0.25 to 0.35 (synthetic scenes). For the same
/// reason, guidance is too low, but this is harmless.
class GuidanceLearner {
public:
    /// Learns from one frame that was matched with two stills. `truth` is its match with the new
    /// still. `older` is its match with the older still, with which the frame was drawn. Returns
    /// false if the frames' sizes differ, if too few pixels are trusted in both stills, or if
    /// `stop` was requested.
    bool add(const TrustedPairs& truth, const MatchedPictures& older, const FilterBank& filters,
             const std::stop_token& stop = {});

    [[nodiscard]] const Guidance& guidance() const { return guidance_; }
    [[nodiscard]] std::uint64_t pairs() const { return pairs_; }
    [[nodiscard]] double gainDb() const;

    /// stored() returns the state of the learner, to be kept for a later run of mfard. restore()
    /// returns false if a number is out of range. The numbers from kOldNumbers on concern
    /// Guidance::light. Files of older versions do not have them; restore() then needs zeros.
    static constexpr std::size_t kOldNumbers = 3 + 2 * FactorSums::kOldNumbers;
    static constexpr std::size_t kNumbers = 4 + 2 * FactorSums::kNumbers;
    [[nodiscard]] std::array<double, kNumbers> stored() const;
    [[nodiscard]] bool restore(const std::array<double, kNumbers>& numbers);

private:
    FactorSums learned_, held_;
    Guidance guidance_;
    std::uint64_t pairs_ = 0;
};

}  // namespace mfar::enlarge
