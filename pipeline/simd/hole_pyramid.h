#pragma once

#include "base/geometry.h"
#include "base/rows.h"
#include "base/workers.h"
#include "pipeline/simd/view_look_up.h"
#include "pipeline/warp/warp_options.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace mfar::simd {

/// Fills holes, which are pixels without a rendered sample, from their surroundings by push-pull
/// (Gortler et al. 1996, section 3.5). Virtual objects and the shadow catcher are filled
/// separately, so that neither colour leaks into the other. CPU version of the GLES engine's
/// HoleFiller. The pyramid is computed only where it is read.
class HolePyramid {
public:
    static constexpr int kLevels = 6;

    HolePyramid(Size layer, std::shared_ptr<Workers> workers);

    /// Pictures of ViewLookUp. `where`: the part of them that is drawn.
    struct Layer {
        Rows<std::uint32_t> colour;  ///< fill() overwrites the holes
        Rows<const std::uint32_t> state;
        PixelRect where;
    };
    /// `holes`: the layer's holes. A hole is a crack if its isEdge is true, or if at least five of
    /// its eight neighbours show the hole's surface. Cracks are filled whatever `filling` is, and
    /// their isEdge is set to true. `filling` selects the other holes that are filled. A hole
    /// without known colours in its surroundings stays unfilled.
    void fill(const Layer& layer, std::span<Hole> holes, HoleFilling filling);

private:
    /// A texel of a pyramid level: number (`id`) and colour (`object`) of the object with the
    /// largest weight, and colour of the shadow catcher. Colours are premultiplied RGBA8; weights
    /// are in 1/255.
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
    void fillHole(const Layer& layer, Hole& hole, HoleFilling filling) const;
    void addLevel(int level, int x, int y, std::uint32_t id, Sum& sum) const;
    [[nodiscard]] Sum gathered(int x, int y, std::uint32_t id, int last) const;

    int width_;
    std::shared_ptr<Workers> workers_;
    std::array<Level, kLevels> levels_;
    int levelCount_ = kLevels;
    PixelRect blocks_;  // the drawn part of the layer [blocks of 64x64 px]
    std::vector<std::uint8_t> blockWanted_;
};

}  // namespace mfar::simd
