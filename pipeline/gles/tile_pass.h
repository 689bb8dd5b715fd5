#pragma once

#include "base/gl/pass.h"
#include "pipeline/engine/params/detail.h"
#include "pipeline/plan/tile_work.h"

#include <string>

namespace mfar {

/// The same shader in two programs: one for the whole target, one for a list of tiles.
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

/// Composites of mode Detail, without (`enlarged`) and with the still's detail. `define` is one
/// line of GLSL, or empty.
struct DetailPasses {
    explicit DetailPasses(const std::string& define = "")
        : enlarged("composite_upscale.frag", define.c_str()),
          whole("composite_detail.frag", define),
          tiles("tile_rect.vert", "composite_detail.frag", define),
          plain("tile_rect.vert", "composite_detail.frag", "#define PLAIN_TILE\n" + define) {}

    TilePass enlarged;
    gpu::DrawPass<params::DrawTiles> whole, tiles, plain;
};

}  // namespace mfar
