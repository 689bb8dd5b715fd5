#include "tests/stability/watched_shaders.h"

namespace mfar::stress {
namespace {

constexpr PlantedFault kPlanted[] = {
    {"picture_from_yuv.frag", "(p.x & 1) == 0 ? texel.r : texel.b",
     "(p.x & 1) == 0 ? texel.b : texel.r", "both pixels of a pair exchanged", "formats"},
    {"luma_from_video.comp", "clamp(ivec2(x, y + i), ivec2(0), target.zw - 1)", "ivec2(x, y + i)",
     "missing clamp at the picture's border", "pyramids"},
    {"luma_down.comp", "int y = 2 * at.y;", "int y = 2 * at.y + 1;", "a row off", "pyramids"},
    {"luma_from_still.comp", "clamp(4 * (at.x - kMarginWords) + i, 0, target.z - 1)", "1 << 30",
     "a place far outside of the picture", "pipeline-truth"},
    {"plan_change.comp", "p = min(p, size.xy - 1);", "", "missing clamp in the last tiles", "plan"},
    {"plan_dispatch.comp", "changed += t.x;", "changed += 1u;", "every tile counted", "plan"},
    {"flow_search.comp",
     "clamp(vec2(4 * cell - 2) + u, vec2(-7.0), vec2(l.width - 2, l.height - 2))",
     "vec2(4 * cell - 2) + u", "missing clamp of a patch", "flow2d,pipeline"},
    {"flow_search.comp", "u = best + s;", "u = best - s;", "wrong sign of a step", "flow2d-shift"},
    {"flow_propagate.comp", "c = clamp(c, ivec2(0), cells.xy - 1);", "",
     "missing clamp of a neighbour", "flow2d,pipeline"},
    {"flow_filter.comp", "c = clamp(c, ivec2(0), cells.xy - 1);", "",
     "missing clamp of a neighbour", "flow2d,pipeline"},
    {"flow_align.comp", "clamp(origin, vec2(-7.0), vec2(l.width + 2, l.height + 2))", "origin",
     "missing clamp of a bent patch", "pipeline"},
    {"flow_flag.comp", "unexplained >= offsets.z ? 1u : 0u", "uint(unexplained)",
     "a count where a flag belongs", "pipeline"},
    {"flow_list.comp", "atomicAdd(commands[target.x].x, 1u)",
     "atomicAdd(commands[target.x].x, 1u) * 64u", "entries too far apart", "pipeline"},
    {"superres_assess.comp", "d < tune.x ? 1.0 - d / tune.x : 0.0", "1.0 - d / tune.x",
     "removed guard: confidence below zero", "pipeline"},
    {"superres_assess.comp", "if (!(s.z > 0.05)) return vec2(-1e6);", "",
     "removed guard against rays beside the still's camera", "pipeline"},
    {"superres_gain.comp", "clamp(y, 0, l.height - 1) * l.pitch", "y * l.pitch",
     "missing clamp of a row", "pipeline"},
    {"superres_weigh.comp", "lowShare), 2.0)", "lowShare), 1e9)", "missing clamp of the gain",
     "weights"},
    {"superres_classify.comp", "texelFetch(cellField, clamp(c, ivec2(0), tiles.zw - 1), 0)",
     "texelFetch(cellField, c, 0)", "missing clamp of a cell", "even-picture,pipeline"},
    {"superres_sharpen.frag", "clamp(p, ivec2(0), video.xy - 1)", "p", "missing clamp of a pixel",
     "enlargement"},
    {"superres_vertical.frag", "clamp(row + i - 1, 0, video.y - 1)", "row + i - 1",
     "missing clamp of a row", "enlargement"},
    {"composite_upscale.frag", "clamp(column + 2, 0, last)", "clamp(column + 1, 0, last)",
     "wrong tap", "enlargement"},
    {"composite_blend.frag", "textureLod(still, uv, 0.0).rgb, l.w",
     "textureLod(still, uv, 0.0).rgb, 1.0 - l.w", "weights exchanged", "pipeline-truth"},
    {"composite_detail.frag", "- 128.0 / 255.0", "", "an offset left out", "even-picture"},
    {"still_low.frag", "lumaOf(sum / 16.0)", "lumaOf(sum / 8.0)", "wrong weight",
     "even-picture,pipeline-truth"},
    {"still_detail.frag", "clamp(p, ivec2(0), low.xy - 1)", "p", "missing clamp of a pixel",
     "even-picture"},
    {"depth_from_flow.comp", "- s.b.z * along", "+ s.b.z * along", "wrong sign",
     "triangulation-usual"},
    {"depth_from_flow.comp", "sigma < kUnknownSigma ? sigma : kUnknownSigma", "sigma",
     "missing clamp of sigma", "triangulation"},
    {"depth_midpoint.comp", "rho > 0.0 && rho < kLargestRho && distance <= tune.z",
     "distance <= tune.z", "removed guard", "triangulation"},
    {"depth_midpoint.comp",
     "if (!(q.x >= -0.5 && q.y >= -0.5 && q.x <= end.x && q.y <= end.y)) return false;", "",
     "removed guard against flow that is none", "triangulation"},
    {"visibility_range.frag", "is ? real.x - tune.x * real.y : 0.0", "real.x - tune.x * real.y",
     "removed guard against unknown depth", "composite"},
    {"visibility_sample.frag", "if (!known(real)) return 1.0;", "",
     "removed guard against unknown depth", "composite"},
    {"visibility_blend.frag", "texelFetch(visibility, p, 0).r * ", "", "nothing is hidden",
     "composite"},
    {"preview.frag", "1.0 / gl_FragCoord.w", "gl_FragCoord.w", "inverse depth for depth",
     "preview"},
};

}  // namespace

std::span<const PlantedFault> plantedFaults() {
    return kPlanted;
}

}  // namespace mfar::stress
