#pragma once

#include "pipeline/render/exposure.h"
#include "pipeline/render/noise_filter.h"
#include "pipeline/render/paint.h"
#include "pipeline/render/render_view.h"
#include "pipeline/render/rendered_picture.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace mfar {

/// The first surface on a ray. Depth [m] along the camera's axis; 0 if id is 0.
struct FirstHit {
    float depth = 0;
    std::uint8_t id = 0;  ///< SceneObject's number, kCatcherId, or 0: nothing
};

/// The surface seen through a pixel's centre.
struct SeenSurface {
    FirstHit hit;
    Eigen::Vector3f normal{0, 0, 0};  ///< world, unit length, towards the eye
    Paint paint{};
    float roughness = 1;
    /// Light known without a ray (FarLight and sun), above 0; sampled light is stored as a multiple
    /// of it.
    SurfaceLight far{{1, 1, 1}, {1, 1, 1}};
};

/// Result of one sample of a pixel.
struct FilmSample {
    FirstHit hit;
    Eigen::Vector3f radiance{0, 0, 0};  ///< of the object, or of the catcher with the objects there
    Eigen::Vector3f without{0, 0, 0};   ///< of the catcher without the objects
    SurfaceLight light{};               ///< of the object, if one was hit
    SurfaceLight far{{1, 1, 1}, {1, 1, 1}};  ///< see SeenSurface::far
    Paint paint{};
};

/// Light of a surface, a mean over samples. For an object: `first` is diffuse, `second` specular
/// light. For the catcher: `first` is the change by the objects, `second` the light without them.
struct KnownLight {
    Eigen::Vector3f first{0, 0, 0}, second{0, 0, 0};
    float firstSquare = 0, secondSquare = 0;  ///< means of squared luminances
    float firstCount = 0, secondCount = 0;    ///< samples; 0: unknown
};

/// Sums of the samples of one view, per pixel, row-major. Has memory for only a part of the
/// picture; pixels elsewhere are empty. Calls for different pixels may run at the same time.
class Film {
public:
    /// For the whole picture, or for a part of it.
    explicit Film(Size size) : Film(size, {0, 0, size.width, size.height}) {}
    Film(Size size, const PixelRect& where) : size_(size) { begin(where); }

    [[nodiscard]] Size size() const { return size_; }
    /// Clears all pixels and makes room for those in `where`. Never frees memory.
    void begin(const PixelRect& where);
    void clear(std::size_t pixel) { memory(pixel) = Pixel{}; }

    /// Samples taken so far, including dropped ones: the number of the next sample.
    [[nodiscard]] std::uint32_t samples(std::size_t pixel) const { return at(pixel).taken; }
    /// Samples of all pixels that were dropped because they were negative or not finite.
    [[nodiscard]] std::uint64_t dropped() const;

    void add(std::size_t pixel, const FilmSample& sample);
    /// Mean radiances of the surfaces that a pixel's samples met, and the share of the samples that
    /// met each.
    struct Means {
        Eigen::Vector3f object{0, 0, 0};
        Eigen::Vector3f with{0, 0, 0}, without{0, 0, 0};  ///< of the catcher
        float objectShare = 0, catcherShare = 0;
    };
    [[nodiscard]] Means means(std::size_t pixel) const;

    /// Sets the surface seen through the pixel's centre.
    void setCentre(std::size_t pixel, const SeenSurface& surface);
    /// Whether setCentre() was called.
    [[nodiscard]] bool isSeen(std::size_t pixel) const { return at(pixel).isSeen; }
    [[nodiscard]] const SeenSurface& centre(std::size_t pixel) const { return at(pixel).seen; }
    /// Of the object at the pixel's centre; empty if there is none.
    [[nodiscard]] GlossWords gloss(std::size_t pixel) const;
    /// Adds light of the surface at the pixel's centre from an earlier picture; it has the weight
    /// of its number of samples.
    void carry(std::size_t pixel, const KnownLight& light) { begun(pixel).carried = light; }
    /// Light of the surface at the pixel's centre, sampled and carried. Empty if the pixel shows
    /// another surface as well.
    [[nodiscard]] KnownLight known(std::size_t pixel) const;

    /// Whether only the real surface is in the pixel, and neither its samples nor carried light
    /// show a change.
    [[nodiscard]] bool isUntouched(std::size_t pixel) const;

    /// Estimated standard error of the displayed value [grey levels of 255]; infinity before two
    /// samples, sampled or carried. Assumes independent samples (those of a good sequence are
    /// better), and for an edge's coverage jittered samples, n^-3/4 (Mitchell 1996).
    [[nodiscard]] float error(std::size_t pixel, const Exposure& exposure = {}) const;

    /// One pixel of the picture. Shadow and bounced light change the real surface's value by the
    /// ratio of its modelled light with objects to that without (differential rendering, Debevec
    /// 1998): black of coverage 1 - ratio^(1/2.2) in the darkest channel; the excess of the other
    /// channels is added as colour.
    struct Resolved {
        std::array<std::uint8_t, 4> colour{};
        FirstHit hit;
        LightWords light{};  ///< of an object
    };
    [[nodiscard]] Resolved resolved(std::size_t pixel, const Exposure& exposure) const;
    /// The light of a pixel as input of a NoiseFilter; resolvedFrom() makes the pixel from its
    /// output.
    [[nodiscard]] LightPixel light(std::size_t pixel, const Exposure& exposure) const;
    /// Carries filtered light if the pixel has neither samples nor carried light.
    void remember(std::size_t pixel, const LightPixel& light);
    [[nodiscard]] Resolved resolvedFrom(const LightPixel& light, std::size_t pixel,
                                        const Exposure& exposure) const;

private:
    // Double precision: in single precision the sums of a million samples would be wrong by a
    // percent, and variances useless.
    /// A part of the light. Each sample is weighted by its paint, because the light that leaves the
    /// surface is the mean light times the mean paint.
    struct LightSum {
        Eigen::Vector3d light{0, 0, 0}, far{0, 0, 0};
        double weights = 0;
        double squares = 0;  // of the luminance of light / far, unweighted

        void add(double weight, const Eigen::Vector3f& light, const Eigen::Vector3f& far);
        /// light / far
        [[nodiscard]] Eigen::Vector3f relative() const;
    };
    struct LightSums {
        LightSum first, second;  // as in KnownLight
        std::uint32_t hits = 0;
    };
    struct Pixel {
        LightSums object, catcher;
        Eigen::Vector3d radiance{0, 0, 0};                            // of the objects
        double radianceSquares = 0;                                   // of the luminance of
                                                                      // `radiance`
        Eigen::Vector3f diffusePaint{0, 0, 0}, facingPaint{0, 0, 0};  // of the objects
        float albedoScale = 0, albedoOffset = 0;
        std::uint32_t taken = 0, lost = 0;
        SeenSurface seen;  // through the pixel's centre
        bool isSeen = false;
        FirstHit nearest, nearestCatcher;
        KnownLight carried;         // of the surface at the centre
        std::uint32_t picture = 0;  // that this pixel's values belong to
    };
    struct Shown {
        Eigen::Vector3f colour{0, 0, 0};  // premultiplied, [0, 1]
        float coverage = 0;
    };

    [[nodiscard]] static Means meansOf(const Pixel& p);
    [[nodiscard]] static bool isWhole(const Pixel& p);
    [[nodiscard]] static KnownLight knownOf(const LightSums& sums, const KnownLight& carried);
    [[nodiscard]] static Paint paintOf(const Pixel& p);
    /// Far light on the object: mean over its samples and the pixel's centre.
    [[nodiscard]] static SurfaceLight farOf(const Pixel& p);
    /// An object's light over far light; 1 where it is unknown, so that the result is the far light
    /// itself.
    [[nodiscard]] static SurfaceLight relativeOf(const KnownLight& light);
    [[nodiscard]] static float errorOfKnown(const Pixel& p, const Exposure& exposure);
    /// Empty if there is no object and no change of the light, as in most of a picture.
    [[nodiscard]] static Shown shown(const Pixel& p, const Exposure& exposure);
    [[nodiscard]] static Shown shown(const Means& m, const Exposure& exposure);
    [[nodiscard]] static Resolved resolved(const Pixel& p, const Shown& shown);
    [[nodiscard]] static FirstHit firstHit(const Pixel& p, bool changed);
    /// Empty if the stored values belong to an earlier picture.
    [[nodiscard]] const Pixel& at(std::size_t pixel) const {
        const std::optional<std::size_t> place = placeOf(pixel);
        if (!place) return kNothing;
        const Pixel& p = pixels_[*place];
        return p.picture == picture_ ? p : kNothing;
    }
    [[nodiscard]] std::optional<std::size_t> placeOf(std::size_t pixel) const {
        const auto width = static_cast<std::uint32_t>(size_.width);
        const int x = static_cast<int>(static_cast<std::uint32_t>(pixel) % width);
        const int y = static_cast<int>(static_cast<std::uint32_t>(pixel) / width);
        if (x < where_.x0 || x >= where_.x1 || y < where_.y0 || y >= where_.y1) return {};
        return static_cast<std::size_t>(y - where_.y0) *
                   static_cast<std::size_t>(where_.x1 - where_.x0) +
               static_cast<std::size_t>(x - where_.x0);
    }
    [[nodiscard]] Pixel& memory(std::size_t pixel) { return pixels_[placeOf(pixel).value()]; }
    [[nodiscard]] Pixel& begun(std::size_t pixel);

    static const Pixel kNothing;

    Size size_;
    PixelRect where_;
    std::uint32_t picture_ = 0;
    std::vector<Pixel> pixels_;
};

}  // namespace mfar
