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
/// "gles", "simd".
[[nodiscard]] std::string_view nameOf(EngineKind kind);

/// The engine of each step.
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
    /// All steps on the engine named by the environment variable MFAR_ENGINE, "simd" or "gles"
    /// (default). For benchmarks and tests, which do not choose an engine themselves.
    [[nodiscard]] static EngineChoice fromEnvironment();
    /// True when at least one step runs on this engine.
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

/// Creates the steps of one kind. Must outlive them.
class Engine {
public:
    virtual ~Engine() = default;
    [[nodiscard]] virtual std::unique_ptr<StillStep> still() = 0;
    [[nodiscard]] virtual std::unique_ptr<PyramidStep> pyramid() = 0;
    [[nodiscard]] virtual std::unique_ptr<FlowStep> flow() = 0;
    [[nodiscard]] virtual std::unique_ptr<WeighStep> weigh() = 0;
    [[nodiscard]] virtual std::unique_ptr<DetailStep> detail() = 0;
    [[nodiscard]] virtual std::unique_ptr<OcclusionStep> occlusion(Size layer) = 0;
    /// `layer`: the camera at the layer's resolution. The step draws into memory that occlusion()
    /// reads directly. Throws std::invalid_argument for an option out of range.
    [[nodiscard]] virtual std::unique_ptr<WarpStep> warp(const CameraModel& layer,
                                                         const WarpOptions& options) = 0;

    /// Prepares a new still for the weigh and detail steps, so that frames need no allocation for
    /// it.
    virtual void take(const StillPictures&) {}
    /// Submits the work requested so far.
    virtual void flush() {}
    /// Waits until all work is done; for benchmarks.
    virtual void finish() {}
    /// Waits until the frame's memory is no longer read.
    virtual void finishReading() {}
    /// Sets the importer that reads camera memory without a copy; null: everything is uploaded. The
    /// importer must outlive the engine.
    virtual void setImporter(PlaneImporter*) {}
    /// Why zero-copy import failed; returned once.
    [[nodiscard]] virtual std::optional<std::string> takeImportFault() { return std::nullopt; }
};

/// Needs a current GL context for its whole lifetime. Throws GlError.
[[nodiscard]] std::unique_ptr<Engine> makeGlesEngine(const StepSetup& setup);
[[nodiscard]] std::unique_ptr<Engine> makeSimdEngine(const StepSetup& setup);

}  // namespace mfar
