#pragma once

#include "base/geometry.h"
#include "base/rows.h"
#include "base/workers.h"
#include "pipeline/simd/view_look_up.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace mfar::simd {

/// Fills holes, which are pixels without a rendered sample, from their surroundings by push-pull
/// (Gortler et al. 1996, section 3.5). Objects and the shadow below them are filled separately, so
/// that neither leaks into the other. CPU version of the GLES engine's HoleFiller; the pyramid is
/// computed only where it is read.
class HolePyramid {
public:
    static constexpr int kLevels = 6;

    HolePyramid(Size layer, std::shared_ptr<Workers> workers);

    struct Layer {
        Rows<std::uint32_t> colour;  ///< fill() overwrites the holes
        Rows<const std::uint32_t> state;
        PixelRect where;
    };
    /// `holes`: the layer's holes, ascending. A hole is a crack if it is at an edge, or if most of
    /// its neighbours show the same surface; then its isEdge becomes true. Cracks are always
    /// filled, other holes only with `pushPull`.
    void fill(const Layer& layer, std::span<Hole> holes, bool pushPull);

private:
    /// A texel of a pyramid level: number and colour of its largest object, and colour of the
    /// shadow catcher. Colours are premultiplied RGBA8; weights are in 1/255.
    struct Area {
        std::uint32_t object = 0, catcher = 0;
        std::uint8_t id = 0, objectWeight = 0, catcherWeight = 0;
    };
    struct Level {
        PixelRect texels;
        std::vector<Area> areas;
    };
    struct Sum {
        std::array<float, 4> rgba{};
        float weight = 0;
    };

    static Area merged(const std::array<Area, 4>& parts);
    [[nodiscard]] Area firstLevelArea(const Layer& layer, int x, int y) const;
    [[nodiscard]] Area areaAt(int level, int x, int y) const;
    void markBlocks(const PixelRect& where, std::span<const Hole> holes);
    void pull(const Layer& layer, int level);
    void fillHole(const Layer& layer, Hole& hole, bool pushPull) const;
    void addLevel(int level, int x, int y, std::uint32_t id, Sum& sum) const;
    [[nodiscard]] Sum gathered(int x, int y, std::uint32_t id, int last) const;

    int width_;
    std::shared_ptr<Workers> workers_;
    std::array<Level, kLevels> levels_;
    int levelCount_ = kLevels;
    PixelRect blocks_;  // bounds of the layer's drawn part [blocks of 64x64
                        // pixels]
    std::vector<std::uint8_t> blockWanted_;
};

}  // namespace mfar::simd
