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
    /// Chooses one engine for all steps: the one that the environment variable MFAR_ENGINE names
    /// ("simd" or "gles", the default). For benchmarks and tests, which do not choose an engine
    /// themselves.
    [[nodiscard]] static EngineChoice fromEnvironment();
    /// True if at least one step runs on this engine.
    [[nodiscard]] bool uses(EngineKind kind) const {
        return still == kind || pyramid == kind || flow == kind || weigh == kind ||
               detail == kind || occlusion == kind;
    }
    bool operator==(const EngineChoice&) const = default;
};

/// Common arguments for creating steps.
struct StepSetup {
    StereoRig rig;
    Size output;  ///< size of the output picture
    Flow2dOptions flow2d{};
    std::shared_ptr<Workers> workers{};
    Transfers* transfers = nullptr;  ///< counts the bytes that steps transfer; null: not counted
};

/// Creates the steps of one engine. The steps must not outlive it.
class Engine {
public:
    virtual ~Engine() = default;
    [[nodiscard]] virtual std::unique_ptr<StillStep> still() = 0;
    [[nodiscard]] virtual std::unique_ptr<PyramidStep> pyramid() = 0;
    [[nodiscard]] virtual std::unique_ptr<FlowStep> flow() = 0;
    [[nodiscard]] virtual std::unique_ptr<WeighStep> weigh() = 0;
    [[nodiscard]] virtual std::unique_ptr<DetailStep> detail() = 0;
    [[nodiscard]] virtual std::unique_ptr<OcclusionStep> occlusion(Size layer) = 0;
    /// `layer`: the camera at the resolution of the virtual layer. The step draws into memory that
    /// the step of occlusion() reads directly. Throws std::invalid_argument if an option is out of
    /// range.
    [[nodiscard]] virtual std::unique_ptr<WarpStep> warp(const CameraModel& layer,
                                                         const WarpOptions& options) = 0;

    /// Prepares a new still for the weigh and detail steps, so that they allocate nothing while
    /// they process frames.
    virtual void take(const StillPictures&) {}
    /// Submits the work requested so far.
    virtual void flush() {}
    /// Waits until all work is done; for benchmarks.
    virtual void finish() {}
    /// Waits until the steps no longer read the memory of the frame.
    virtual void finishReading() {}
    /// Sets the importer that gives the engine access to camera memory without a copy; null: all
    /// pictures are uploaded. The importer must outlive the engine.
    virtual void setImporter(PlaneImporter*) {}
    /// Why zero-copy import failed; returned once.
    [[nodiscard]] virtual std::optional<std::string> takeImportFault() { return std::nullopt; }
};

/// The engine needs a current GL context for its whole lifetime. Throws GlError.
[[nodiscard]] std::unique_ptr<Engine> makeGlesEngine(const StepSetup& setup);
[[nodiscard]] std::unique_ptr<Engine> makeSimdEngine(const StepSetup& setup);

}  // namespace mfar
