#pragma once

#include "pipeline/render/exposure.h"
#include "pipeline/render/noise_filter.h"
#include "pipeline/render/render_view.h"
#include "pipeline/render/rendered_picture.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mfar {

/// What the first surface of a ray is. Depth [m] along the camera's axis, 0 with id 0.
struct FirstHit {
    float depth = 0;
    std::uint8_t id = 0;  ///< SceneObject's number, kCatcherId, or 0: nothing
};

/// What one sample of a pixel saw.
struct FilmSample {
    FirstHit hit;
    Eigen::Vector3f radiance{0, 0, 0};    ///< of the object or, with the objects there, the catcher
    Eigen::Vector3f without{0, 0, 0};     ///< of the catcher if the objects were not there
    Eigen::Vector3f baseColour{0, 0, 0};  ///< of the object, where it was hit
};

/// Sums of the samples of one view, a pixel each, row-major. Calls for different pixels may run at
/// the same time.
class Film {
public:
    explicit Film(Size size);

    [[nodiscard]] Size size() const { return size_; }
    /// All pixels, at no cost.
    void clear() { ++picture_; }
    void clear(std::size_t pixel) { pixels_[pixel] = Pixel{}; }

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
    void setCentre(std::size_t pixel, const FirstHit& hit);

    /// Estimated standard error of the displayed value [grey levels of 255], infinity before two
    /// samples. Samples are taken as independent, which those of a good sequence are better than,
    /// and an edge's coverage as that of jittered samples, n^-3/4 (Mitchell 1996).
    [[nodiscard]] float error(std::size_t pixel, const Exposure& exposure = {}) const;

    /// One pixel of the picture of what there is. Shadow and bounced light change the real
    /// surface's value by the ratio of its modelled light with the objects to without (differential
    /// rendering, Debevec 1998): black of coverage 1 - ratio^(1/2.2) in the darkest channel, and
    /// what the others are brighter as added colour.
    struct Resolved {
        std::array<std::uint8_t, 4> colour{};
        FirstHit hit;
    };
    [[nodiscard]] Resolved resolved(std::size_t pixel, const Exposure& exposure) const;
    /// The same before it is quantised, for a NoiseFilter, and of what that has made of it.
    [[nodiscard]] NoisyPixel noisy(std::size_t pixel, const Exposure& exposure) const;
    [[nodiscard]] Resolved resolvedFrom(const NoisyPixel& filtered, std::size_t pixel) const;

private:
    struct Pixel {
        // In single precision a million samples would be a percent off, and a variance nothing.
        Eigen::Vector3d object{0, 0, 0}, with{0, 0, 0}, without{0, 0, 0};
        Eigen::Vector3f baseColour{0, 0, 0};  // of the objects
        double objectSquares = 0;             // of luminance
        double changeSquares = 0;             // of the luminance's change on the catcher
        std::uint32_t taken = 0, lost = 0, objectHits = 0, catcherHits = 0;
        FirstHit centre, nearest, catcher;
        std::uint32_t picture = 0;  // that it is of
    };
    struct Shown {
        Eigen::Vector3f colour{0, 0, 0};  // premultiplied, [0, 1]
        float coverage = 0;
    };

    [[nodiscard]] static Means meansOf(const Pixel& p);
    /// Nothing where objects neither are nor change the light, as in most of a picture.
    [[nodiscard]] static Shown shown(const Pixel& p, const Exposure& exposure);
    [[nodiscard]] static Shown shown(const Means& m, const Exposure& exposure);
    [[nodiscard]] static Resolved resolved(const Pixel& p, const Shown& shown);
    [[nodiscard]] static FirstHit firstHit(const Pixel& p, bool changed);
    /// Nothing where what is there is of an earlier picture.
    [[nodiscard]] const Pixel& at(std::size_t pixel) const {
        const Pixel& p = pixels_[pixel];
        return p.picture == picture_ ? p : kNothing;
    }
    [[nodiscard]] Pixel& begun(std::size_t pixel);

    static const Pixel kNothing;

    Size size_;
    std::uint32_t picture_ = 0;
    std::vector<Pixel> pixels_;
};

}  // namespace mfar
