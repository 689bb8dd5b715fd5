#pragma once

#include "base/gl/pass.h"
#include "pipeline/engine/params/detail.h"
#include "pipeline/plan/tile_work.h"

#include <string>

namespace mfar {

struct TilePass {
    explicit TilePass(const char* fragment, const char* defines = "")
        : whole(fragment, defines), tiles("tile_rect.vert", fragment, defines) {}

    void run(bool all, const params::DrawTiles& params, gpu::Bindings bindings,
             const gpu::Framebuffer& target, const gpu::InstanceList& list) {
        if (all)
            whole.run(params, bindings, target);
        else
            tiles.runTiles(params, bindings, target, list);
    }

    gpu::DrawPass<params::DrawTiles> whole, tiles;
};

/// Programs that draw the output in mode Detail. `enlarged` draws only the enlarged video. The
/// others add the still's detail: `whole` to the whole frame, `tiles` to listed tiles, and `plain`
/// to listed tiles of class Trusted. `define` is empty or one line of GLSL for all programs.
struct DetailPasses {
    explicit DetailPasses(const std::string& define = "")
        : enlarged("composite_enlarge.frag", define.c_str()),
          whole("composite_detail.frag", define),
          tiles("tile_rect.vert", "composite_detail.frag", define),
          plain("tile_rect.vert", "composite_detail.frag", "#define PLAIN_TILE\n" + define) {}

    TilePass enlarged;
    gpu::DrawPass<params::DrawTiles> whole, tiles, plain;
};

}  // namespace mfar
