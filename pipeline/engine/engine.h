#pragma once

#include "pipeline/engine/steps.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace mfar {

class WarpStep;
class Workers;
struct WarpOptions;

enum class EngineKind : std::uint8_t {
    Gles,  ///< OpenGL ES 3.1 shaders
    Simd   ///< SIMD kernels on the CPU
};
/// Returns "gles" or "simd".
[[nodiscard]] std::string_view nameOf(EngineKind kind);

/// The engine that runs each step.
struct EngineChoice {
    EngineKind still = EngineKind::Gles;
    EngineKind pyramid = EngineKind::Gles;
    EngineKind flow = EngineKind::Gles;
    EngineKind weigh = EngineKind::Gles;
    EngineKind detail = EngineKind::Gles;
    EngineKind occlusion = EngineKind::Gles;

    [[nodiscard]] static EngineChoice all(EngineKind kind) {
        return {kind, kind, kind, kind, kind, kind};
    }
    /// Returns one engine for all steps: the one that the environment variable MFAR_ENGINE names
    /// ("simd", or "gles" by default). For benchmarks and tests that do not choose an engine
    /// themselves.
    [[nodiscard]] static EngineChoice fromEnvironment();
    /// True if at least one step runs on this engine.
    [[nodiscard]] bool uses(EngineKind kind) const {
        return still == kind || pyramid == kind || flow == kind || weigh == kind ||
               detail == kind || occlusion == kind;
    }
    bool operator==(const EngineChoice&) const = default;
};

/// Arguments that creating any step needs.
struct StepSetup {
    StereoRig rig;
    Size output;  ///< size of the output picture
    Flow2dOptions flow2d{};
    std::shared_ptr<Workers> workers{};
    Transfers* transfers = nullptr;  ///< counts the bytes that steps transfer; null: not counted
};

/// Creates the steps of one engine. The steps must not outlive the Engine.
class Engine {
public:
    virtual ~Engine() = default;
    [[nodiscard]] virtual std::unique_ptr<StillStep> still() = 0;
    [[nodiscard]] virtual std::unique_ptr<PyramidStep> pyramid() = 0;
    [[nodiscard]] virtual std::unique_ptr<FlowStep> flow() = 0;
    [[nodiscard]] virtual std::unique_ptr<WeighStep> weigh() = 0;
    [[nodiscard]] virtual std::unique_ptr<DetailStep> detail() = 0;
    [[nodiscard]] virtual std::unique_ptr<OcclusionStep> occlusion(Size layer) = 0;
    /// `layer`: the video camera at the resolution of the virtual layer. The created step draws
    /// into memory that the step created by occlusion() reads directly. Throws
    /// std::invalid_argument if an option is out of range.
    [[nodiscard]] virtual std::unique_ptr<WarpStep> warp(const CameraModel& layer,
                                                         const WarpOptions& options) = 0;

    /// Prepares a new still for the weigh and detail steps, so that they allocate nothing while
    /// they process frames.
    virtual void take(const StillPictures&) {}
    /// Submits the work that the steps have requested so far to the GPU.
    virtual void flush() {}
    /// Waits until the GPU has done all work; for benchmarks.
    virtual void finish() {}
    /// Waits until the steps no longer read the memory of the current video frame.
    virtual void finishReading() {}
    /// Sets the importer that gives the engine access to camera memory without a copy; null: all
    /// pictures are uploaded. The importer must outlive the engine.
    virtual void setImporter(PlaneImporter*) {}
    /// Returns why an import of camera memory without a copy failed. Each failure is returned once;
    /// empty: there was none.
    [[nodiscard]] virtual std::optional<std::string> takeImportFault() { return std::nullopt; }
};

/// The engine needs a current GL context for its whole lifetime. Throws GlError.
[[nodiscard]] std::unique_ptr<Engine> makeGlesEngine(const StepSetup& setup);
[[nodiscard]] std::unique_ptr<Engine> makeSimdEngine(const StepSetup& setup);

}  // namespace mfar
