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

/// Fills holes from their surroundings by push-pull (Gortler et al. 1996, section 3.5), apart for
/// objects and the shadow below them, so that neither leaks into the other. HoleFiller on the host:
/// the pyramid is made only where it is looked up.
class HolePyramid {
public:
    static constexpr int kLevels = 6;

    HolePyramid(Size layer, std::shared_ptr<Workers> workers);

    /// A layer as ViewLookUp leaves it.
    struct Layer {
        Rows<std::uint32_t> colour;  ///< drawn into
        Rows<const std::uint32_t> state;
        PixelRect where;
    };
    /// `holes`: of that layer, ascending. Cracks, of which most neighbours show the same surface,
    /// are always filled and marked as edges; others where `pushPull` asks for it.
    void fill(const Layer& layer, std::span<Hole> holes, bool pushPull);

private:
    /// Of an area: the object with most of it and what it shows, what the catcher shows. RGBA8
    /// premultiplied; weights [1/255].
    struct Area {
        std::uint32_t object = 0, catcher = 0;
        std::uint8_t id = 0, objectWeight = 0, catcherWeight = 0;
    };
    struct Level {
        PixelRect texels;  // of the level
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
    PixelRect blocks_;                       // of 64 pixels each way, around the layer's part
    std::vector<std::uint8_t> blockWanted_;  // row-major
};

}  // namespace mfar::simd
