#pragma once

#include "pipeline/render/exposure.h"
#include "pipeline/render/film_memory.h"
#include "pipeline/render/noise_filter.h"
#include "pipeline/render/paint.h"
#include "pipeline/render/render_view.h"
#include "pipeline/render/rendered_picture.h"

#include <Eigen/Core>

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace mfar {

/// The first surface on a ray. `depth` is measured along the optical axis [m]; it is 0 if `id` is
/// 0.
struct FirstHit {
    float depth = 0;
    std::uint8_t id = 0;  ///< SceneObject's number or kCatcherId; 0: no surface was hit
};

struct SeenSurface {
    FirstHit hit;
    Eigen::Vector3f normal{0, 0, 0};  ///< world frame, unit length, towards the camera's side
    Paint paint{};
    float roughness = 1;
    /// Light on the surface that is known without tracing a ray (from FarLight and the sun). It is
    /// above 0. Sampled light is stored as a multiple of it.
    SurfaceLight far{{1, 1, 1}, {1, 1, 1}};
};

struct FilmSample {
    FirstHit hit;
    Eigen::Vector3f radiance{0, 0, 0};  ///< radiance of the hit surface, with all objects
    Eigen::Vector3f without{0, 0, 0};   ///< radiance of the shadow catcher without any object
    SurfaceLight light{};               ///< light on the hit object
    SurfaceLight far{{1, 1, 1}, {1, 1, 1}};
    Paint paint{};
};

/// Light of a surface, averaged over samples. For an object, `first` is diffuse and `second` is
/// specular light. For the shadow catcher, `first` is the change caused by objects and `second` is
/// the light without objects. The light of an object is stored as a multiple of SeenSurface::far.
struct KnownLight {
    Eigen::Vector3f first{0, 0, 0}, second{0, 0, 0};
    float firstSquare = 0, secondSquare = 0;  ///< means of the samples' squared luminances
    float firstCount = 0, secondCount = 0;    ///< numbers of samples; 0: unknown light
};

/// Sums of the samples of each pixel of one view. Pixels are numbered row-major. A block of pixels
/// gets memory when one of its pixels is first used, so unused parts cost neither time nor memory.
/// Threads may process different pixels at the same time.
class Film {
public:
    /// Number of pixels in a block. A tile of Slices has four blocks. The tile's pixels with even
    /// column and even row share one block.
    static constexpr std::size_t kBlockPixels = 16;
    /// Memory that several films may share.
    [[nodiscard]] static std::shared_ptr<FilmMemory> makeMemory();

    explicit Film(Size size, std::shared_ptr<FilmMemory> memory = makeMemory());

    [[nodiscard]] Size size() const { return size_; }
    /// Clears all pixels, and returns their blocks to the FilmMemory.
    void begin();
    void clear(std::size_t pixel) { begun(pixel) = Pixel{}; }

    /// Asks the processor to load a pixel that will soon be used, so that later code need not wait
    /// for memory.
    void prefetch(std::size_t pixel) const {
        const auto* line = reinterpret_cast<const std::byte*>(&at(pixel));
        for (std::size_t i = 0; i < sizeof(Pixel); i += kCacheLine)
            __builtin_prefetch(line + i);
    }

    /// Number of samples so far, including dropped ones; also the index of the next sample.
    [[nodiscard]] std::uint32_t samples(std::size_t pixel) const { return at(pixel).taken; }
    /// Number of dropped samples of all pixels. A sample is dropped if its light is negative or not
    /// finite.
    [[nodiscard]] std::uint64_t dropped() const;

    void add(std::size_t pixel, const FilmSample& sample);
    /// Mean radiance of a pixel's samples. `object` is the mean over the samples that hit an
    /// object. `with` and `without` are means over the samples that hit the shadow catcher: its
    /// radiance with objects, and its radiance if no object existed. `objectShare` and
    /// `catcherShare`: number of samples that hit an object or the shadow catcher, divided by the
    /// number of all samples that were not dropped.
    struct Means {
        Eigen::Vector3f object{0, 0, 0};
        Eigen::Vector3f with{0, 0, 0}, without{0, 0, 0};
        float objectShare = 0, catcherShare = 0;
    };
    [[nodiscard]] Means means(std::size_t pixel) const;

    void setCentre(std::size_t pixel, const SeenSurface& surface);
    [[nodiscard]] bool isSeen(std::size_t pixel) const { return at(pixel).isSeen; }
    [[nodiscard]] const SeenSurface& centre(std::size_t pixel) const { return at(pixel).seen; }
    [[nodiscard]] GlossWords gloss(std::size_t pixel) const;
    /// Stores light that an earlier picture measured on the surface at the pixel's centre. The
    /// light's number of samples is its weight.
    void carry(std::size_t pixel, const KnownLight& light) { begun(pixel).carried = light; }
    /// Returns the light of the surface at the pixel's centre, from this picture's samples and from
    /// carry(). Samples of other surfaces are ignored.
    [[nodiscard]] KnownLight known(std::size_t pixel) const;

    /// True if the pixel shows only the real surface, and no object changes its light.
    [[nodiscard]] bool isUntouched(std::size_t pixel) const;

    /// Estimated standard error of the displayed value [grey levels of 255]. It is infinite with
    /// fewer than two samples, traced or carried. The estimate assumes independent samples; the
    /// errors of a low-discrepancy sequence are smaller. At an edge, the error of the coverage is
    /// proportional to n^-3/4, as for jittered samples (Mitchell 1996).
    [[nodiscard]] float error(std::size_t pixel, const Exposure& exposure = {}) const;

    /// One pixel of the picture. Shadow and bounced light multiply the value of the real surface by
    /// a ratio: modelled light with objects, divided by modelled light without objects
    /// (differential rendering, Debevec 1998). The colour channel with the smallest ratio gives a
    /// black layer of coverage 1 - ratio^(1/2.2). The excess of the other channels is added as
    /// colour.
    struct Resolved {
        std::array<std::uint8_t, 4> colour{};
        FirstHit hit;
        LightWords light{};  ///< light on the object; unused for the catcher
    };
    [[nodiscard]] Resolved resolved(std::size_t pixel, const Exposure& exposure) const;
    /// Returns a pixel's light as input of a NoiseFilter. resolvedFrom() converts the filter's
    /// output to a pixel.
    [[nodiscard]] LightPixel light(std::size_t pixel, const Exposure& exposure) const;
    /// Returns a pixel of the picture from filtered light. At an edge, the pixel shows a mixture of
    /// all its surfaces. If `layered` is true, it shows only the surface that has the filtered
    /// light.
    [[nodiscard]] Resolved resolvedFrom(const LightPixel& light, std::size_t pixel,
                                        const Exposure& exposure, bool layered = false) const;

private:
    // The sums need double precision. In single precision, sums of a million samples would be wrong
    // by a percent, and variances would be useless.
    struct LightSum {
        Eigen::Vector3d light{0, 0, 0}, far{0, 0, 0};
        double weights = 0;
        double squares = 0;  // sum of (luminance of the quotient light / far)^2, unweighted

        void add(double weight, const Eigen::Vector3f& light, const Eigen::Vector3f& far);
        [[nodiscard]] Eigen::Vector3f relative() const;
    };
    struct LightSums {
        LightSum first, second;
        std::uint32_t hits = 0;
    };
    struct Pixel {
        // Members that all functions read come first, so that they share cache lines.
        std::uint32_t taken = 0, lost = 0;
        std::uint32_t objectHits = 0;  // number of samples that hit any object
        bool isSeen = false;
        SeenSurface seen;
        FirstHit nearest, nearestCatcher;
        KnownLight carried;
        /// `object` sums the samples of the object at the pixel's centre. If no object is there, it
        /// sums the samples of all objects.
        LightSums catcher, object;
        Eigen::Vector3d radiance{0, 0, 0};
        double radianceSquares = 0;
        Eigen::Vector3f diffusePaint{0, 0, 0}, facingPaint{0, 0, 0};
        float albedoScale = 0, albedoOffset = 0;
    };
    static constexpr std::size_t kCacheLine = 64;
    struct Shown {
        Eigen::Vector3f colour{0, 0, 0};
        float coverage = 0;
    };

    [[nodiscard]] static Means meansOf(const Pixel& p);
    [[nodiscard]] static bool isWhole(const Pixel& p);
    [[nodiscard]] static bool hasObjectAtCentre(const Pixel& p) {
        return p.seen.hit.id != 0 && p.seen.hit.id != kCatcherId;
    }
    [[nodiscard]] static KnownLight knownOf(const LightSums& sums, const KnownLight& carried);
    [[nodiscard]] static Paint paintOf(const Pixel& p);
    /// Returns the pixel's far light (see SeenSurface::far): the weighted mean of the far light at
    /// the samples on the object and of the far light at the pixel's centre.
    [[nodiscard]] static SurfaceLight farOf(const Pixel& p);
    [[nodiscard]] static SurfaceLight relativeOf(const KnownLight& light);
    [[nodiscard]] static float errorOfKnown(const Pixel& p, const Exposure& exposure);
    [[nodiscard]] static Shown shown(const Pixel& p, const Exposure& exposure);
    [[nodiscard]] static Shown shown(const Means& m, const Exposure& exposure);
    [[nodiscard]] static Resolved resolved(const Pixel& p, const Shown& shown);
    [[nodiscard]] static FirstHit firstHit(const Pixel& p, bool changed);
    /// Returns an empty pixel if the pixel was not used since begin().
    [[nodiscard]] const Pixel& at(std::size_t pixel) const {
        const std::size_t place = placeOf(pixel);
        const Block& block = blocks_[place / kBlockPixels];
        const std::size_t i = place % kBlockPixels;
        if (block.picture.load(std::memory_order_acquire) != picture_) return kNothing;
        return (block.begun.load(std::memory_order_relaxed) >> i & 1U) != 0 ? block.pixels[i]
                                                                            : kNothing;
    }
    /// Returns the index of the pixel's data, counted through all blocks. The pixels of a tile lie
    /// together, in sampling order, so that a sparsely sampled tile uses few blocks.
    [[nodiscard]] std::size_t placeOf(std::size_t pixel) const;
    [[nodiscard]] Pixel& begun(std::size_t pixel);

    struct Block {
        Pixel* pixels = nullptr;                // valid in the picture `picture`
        std::atomic<std::uint32_t> picture{0};  // the last picture that used the block
        std::atomic<std::uint32_t> begun{0};    // bit n: pixel n was constructed
    };
    void addBlock(Block& block);

    /// Blocks of memory, which the destructor gives back.
    struct Held {
        std::shared_ptr<FilmMemory> memory;
        std::vector<std::byte*> blocks;

        explicit Held(std::shared_ptr<FilmMemory> from) : memory(std::move(from)) {}
        ~Held() { giveBack(); }
        Held(Held&& other) noexcept = default;
        Held& operator=(Held&& other) noexcept {
            std::swap(memory, other.memory);
            std::swap(blocks, other.blocks);
            return *this;
        }
        void giveBack() {
            if (!blocks.empty()) memory->giveBack(blocks);
            blocks.clear();
        }
    };

    static const Pixel kNothing;

    Size size_;
    std::size_t tilesAcross_ = 0, blockCount_ = 0;
    std::uint32_t picture_ = 1;
    std::unique_ptr<Block[]> blocks_;
    std::unique_ptr<std::mutex> mutex_;  // held while a block gets its memory
    Held held_;
};

}  // namespace mfar
