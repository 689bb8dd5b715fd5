#pragma once

#include "pipeline/render/path_tracer.h"
#include "pipeline/scene/scene.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace mfar::eval {

/// "still-life": balls and boxes next to and behind each other. "showpiece": the model of
/// showpiece() on a plane that catches its shadow.
[[nodiscard]] std::vector<std::string> warpSceneNames();
/// Short names of scenes: a scene's name, or the file's name without extension. If several scenes
/// would have the same short name, each keeps its entry of `scenes`.
[[nodiscard]] std::vector<std::string> sceneLabels(const std::vector<std::string>& scenes);
/// Returns the label with "-" for each "/", so that it can be part of a file's name.
[[nodiscard]] std::string fileStemOf(std::string label);
/// Loads a scene of warpSceneNames(), or a glTF file. The file's model keeps its size and stands on
/// a plane. Throws EvalError.
[[nodiscard]] std::shared_ptr<const Scene> warpScene(const std::string& name);

/// A camera that looks at the centre of the objects from 35 degrees above, through a slightly
/// distorting lens. It is turned by `degrees` around the objects and sees all of them.
[[nodiscard]] RenderView warpView(const Scene& scene, Size size, double degrees);

[[nodiscard]] inline bool showsObject(const RenderedPicture& picture, std::size_t pixel) {
    return picture.id[pixel] != 0 && picture.id[pixel] != kCatcherId;
}

/// mfard's options of the path tracer. With `truth`, another seed is used, so that the noise of the
/// truth is independent of the noise of mfard's pictures.
[[nodiscard]] PathTracerOptions tracerOptions(bool truth);
/// Traces the listed pixels with `samples` samples each, on all processors. Other pixels stay
/// empty.
[[nodiscard]] RenderedPicture tracePixels(const PathTracer& tracer, const RenderView& view,
                                          std::span<const std::uint32_t> pixels, int samples);
[[nodiscard]] RenderedPicture tracePicture(const PathTracer& tracer, const RenderView& view,
                                           int samples);

}  // namespace mfar::eval
