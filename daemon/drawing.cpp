#include "daemon/drawing.h"

#include "daemon/session_engines.h"

namespace mfar {
namespace {

PipelineOptions pipelineOptions(const Config& config, Size output, const EngineChoice& engines) {
    PipelineOptions options;
    options.mode = config.superres.mode;
    options.output = output;
    options.skipUnchanged = config.superres.skipUnchanged;
    options.engines = engines;
    return options;
}

}  // namespace

Drawing::Drawing(const Config& config, const StereoRig& rig, Size output,
                 const std::unique_ptr<GlContext>& gl)
    : gpu(gl), validation(config.validate ? std::make_unique<gpu::Validation>() : nullptr),
      engines(chooseEngines(config, gl.get(), rig, output)),
      pipeline(rig, pipelineOptions(config, output, engines)),
      objects(config.virtualLayer, rig, pipeline), tracing(config.virtualLayer.budgetMs),
      banner(pipeline.outputSize()) {
    pipeline.setMeasure(config.status.measure);
    pipeline.setImporter(gl ? gl->planeImporter() : nullptr);
}

}  // namespace mfar
