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

/// What the first surface of a ray is. Depth [m] along the camera's axis, 0 with id 0.
struct FirstHit {
    float depth = 0;
    std::uint8_t id = 0;  ///< SceneObject's number, kCatcherId, or 0: nothing
};

/// What is seen through a pixel's centre.
struct SeenSurface {
    FirstHit hit;
    Eigen::Vector3f normal{0, 0, 0};  ///< world, unit length, towards the eye
    Paint paint{};
    float roughness = 1;
    /// Light that is known without a ray, above 0: the samples' is a multiple of it.
    SurfaceLight far{{1, 1, 1}, {1, 1, 1}};
};

/// What one sample of a pixel saw.
struct FilmSample {
    FirstHit hit;
    Eigen::Vector3f radiance{0, 0, 0};  ///< of the object or, with the objects there, the catcher
    Eigen::Vector3f without{0, 0, 0};   ///< of the catcher if the objects were not there
    SurfaceLight light{};               ///< of the object, where it was hit
    SurfaceLight far{{1, 1, 1}, {1, 1, 1}};  ///< as SeenSurface's
    Paint paint{};
};

/// Light of a surface, a mean over samples. Of an object: first is diffuse, second is specular
/// light; of the catcher: first is what the objects change, second is its light without them.
struct KnownLight {
    Eigen::Vector3f first{0, 0, 0}, second{0, 0, 0};
    float firstSquare = 0, secondSquare = 0;  ///< means of squared luminances
    float firstCount = 0, secondCount = 0;    ///< samples; 0: nothing is known
};

/// Sums of the samples of one view, a pixel each, row-major. Has memory for a part of the picture
/// alone; elsewhere there is nothing. Calls for different pixels may run at the same time.
class Film {
public:
    /// Of the whole picture, or of a part of it.
    explicit Film(Size size) : Film(size, {0, 0, size.width, size.height}) {}
    Film(Size size, const PixelRect& where) : size_(size) { begin(where); }

    [[nodiscard]] Size size() const { return size_; }
    /// Forgets all pixels, and has memory for those in `where`. Keeps the memory that it has.
    void begin(const PixelRect& where);
    void clear(std::size_t pixel) { memory(pixel) = Pixel{}; }

    /// Taken so far, those that were dropped too: the next one's number.
    [[nodiscard]] std::uint32_t samples(std::size_t pixel) const { return at(pixel).taken; }
    /// Samples of all pixels that were not finite or negative, and count for nothing.
    [[nodiscard]] std::uint64_t dropped() const;

    void add(std::size_t pixel, const FilmSample& sample);
    /// Mean radiances of what samples of a pixel met, and the shares of the samples that met it.
    struct Means {
        Eigen::Vector3f object{0, 0, 0};
        Eigen::Vector3f with{0, 0, 0}, without{0, 0, 0};  ///< the catcher's
        float objectShare = 0, catcherShare = 0;
    };
    [[nodiscard]] Means means(std::size_t pixel) const;

    /// What is seen through the pixel's centre.
    void setCentre(std::size_t pixel, const SeenSurface& surface);
    /// setCentre() was called.
    [[nodiscard]] bool isSeen(std::size_t pixel) const { return at(pixel).isSeen; }
    [[nodiscard]] const SeenSurface& centre(std::size_t pixel) const { return at(pixel).seen; }
    /// Light of the surface at the pixel's centre that an earlier picture knows; it counts like as
    /// many samples.
    void carry(std::size_t pixel, const KnownLight& light) { begun(pixel).carried = light; }
    /// Light of the surface at the pixel's centre, as sampled and carried. Nothing where another
    /// surface is in the pixel as well.
    [[nodiscard]] KnownLight known(std::size_t pixel) const;

    /// Whether the real surface alone is in it, and no sample or carried light knows of a change.
    [[nodiscard]] bool isUntouched(std::size_t pixel) const;

    /// Estimated standard error of the displayed value [grey levels of 255], infinity before two
    /// samples, sampled or carried. Samples are taken as independent, which those of a good
    /// sequence are better than, and an edge's coverage as that of jittered samples, n^-3/4
    /// (Mitchell 1996).
    [[nodiscard]] float error(std::size_t pixel, const Exposure& exposure = {}) const;

    /// One pixel of the picture of what there is. Shadow and bounced light change the real
    /// surface's value by the ratio of its modelled light with the objects to without (differential
    /// rendering, Debevec 1998): black of coverage 1 - ratio^(1/2.2) in the darkest channel, and
    /// what the others are brighter as added colour.
    struct Resolved {
        std::array<std::uint8_t, 4> colour{};
        FirstHit hit;
        LightWords light{};  ///< of an object
    };
    [[nodiscard]] Resolved resolved(std::size_t pixel, const Exposure& exposure) const;
    /// The light of a pixel, for a NoiseFilter, and the pixel with what that has made of it.
    [[nodiscard]] LightPixel light(std::size_t pixel, const Exposure& exposure) const;
    /// Carries a filter's light where nothing else is known.
    void remember(std::size_t pixel, const LightPixel& light);
    [[nodiscard]] Resolved resolvedFrom(const LightPixel& light, std::size_t pixel,
                                        const Exposure& exposure) const;

private:
    // In single precision a million samples would be a percent off, and a variance nothing.
    /// A part of the light, each sample weighted by the paint that it falls on: what leaves the
    /// surface is the mean light times the mean paint.
    struct LightSum {
        Eigen::Vector3d light{0, 0, 0}, far{0, 0, 0};
        double weights = 0;
        double squares = 0;  // of the luminance of light over far light, not weighted

        void add(double weight, const Eigen::Vector3f& light, const Eigen::Vector3f& far);
        /// Light over far light.
        [[nodiscard]] Eigen::Vector3f relative() const;
    };
    struct LightSums {
        LightSum first, second;  // as of KnownLight
        std::uint32_t hits = 0;
    };
    struct Pixel {
        LightSums object, catcher;
        Eigen::Vector3d radiance{0, 0, 0};                            // of the objects
        double radianceSquares = 0;                                   // of its luminance
        Eigen::Vector3f diffusePaint{0, 0, 0}, facingPaint{0, 0, 0};  // of the objects
        float albedoScale = 0, albedoOffset = 0;
        std::uint32_t taken = 0, lost = 0;
        SeenSurface seen;  // through its centre
        bool isSeen = false;
        FirstHit nearest, nearestCatcher;
        KnownLight carried;         // of the centre's surface
        std::uint32_t picture = 0;  // that it is of
    };
    struct Shown {
        Eigen::Vector3f colour{0, 0, 0};  // premultiplied, [0, 1]
        float coverage = 0;
    };

    [[nodiscard]] static Means meansOf(const Pixel& p);
    [[nodiscard]] static bool isWhole(const Pixel& p);
    [[nodiscard]] static KnownLight knownOf(const LightSums& sums, const KnownLight& carried);
    [[nodiscard]] static Paint paintOf(const Pixel& p);
    /// Far light on the object, a mean over its samples and the pixel's centre.
    [[nodiscard]] static SurfaceLight farOf(const Pixel& p);
    /// Of an object, over far light; the latter itself where nothing is known.
    [[nodiscard]] static SurfaceLight relativeOf(const KnownLight& light);
    [[nodiscard]] static float errorOfKnown(const Pixel& p, const Exposure& exposure);
    /// Nothing where objects neither are nor change the light, as in most of a picture.
    [[nodiscard]] static Shown shown(const Pixel& p, const Exposure& exposure);
    [[nodiscard]] static Shown shown(const Means& m, const Exposure& exposure);
    [[nodiscard]] static Resolved resolved(const Pixel& p, const Shown& shown);
    [[nodiscard]] static FirstHit firstHit(const Pixel& p, bool changed);
    /// Nothing where what is there is of an earlier picture.
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
