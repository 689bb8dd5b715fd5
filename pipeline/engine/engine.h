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

enum class EngineKind : std::uint8_t { Gles, Simd };
/// Returns "gles" or "simd".
[[nodiscard]] std::string_view nameOf(EngineKind kind);

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
    /// Returns a choice with the same engine for all steps: Simd if the environment variable
    /// MFAR_ENGINE is "simd", otherwise Gles. Benchmarks and tests use this choice unless they
    /// choose an engine themselves.
    [[nodiscard]] static EngineChoice fromEnvironment();
    [[nodiscard]] bool uses(EngineKind kind) const {
        return still == kind || pyramid == kind || flow == kind || weigh == kind ||
               detail == kind || occlusion == kind;
    }
    bool operator==(const EngineChoice&) const = default;
};

struct StepSetup {
    StereoRig rig;
    Size output;
    Flow2dOptions flow2d{};
    std::shared_ptr<Workers> workers{};
    Transfers* transfers = nullptr;
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
    /// `layer` is the video camera at the resolution of the virtual layer. The engine's occlusion
    /// step can read the result of the warp step without a copy. Throws std::invalid_argument if an
    /// option is out of range.
    [[nodiscard]] virtual std::unique_ptr<WarpStep> warp(const CameraModel& layer,
                                                         const WarpOptions& options) = 0;

    /// Prepares a new still for the flow, weigh and detail steps, so that they allocate nothing
    /// while they process frames.
    virtual void take(const StillPictures&) {}
    /// Submits all work of the steps to the GPU, without waiting.
    virtual void flush() {}
    /// Waits until the GPU has finished all work. Used by benchmarks.
    virtual void finish() {}
    /// Waits until the steps no longer read the memory of the current video frame.
    virtual void finishReading() {}
    /// Sets the importer that lets the engine read camera memory without a copy. The importer must
    /// outlive the engine. Null: all pictures are uploaded.
    virtual void setImporter(PlaneImporter*) {}
    /// If an import of camera memory has failed since the last call, returns the reason. Otherwise
    /// returns nullopt.
    [[nodiscard]] virtual std::optional<std::string> takeImportFault() { return std::nullopt; }
};

/// The returned engine needs a current GL context for its whole lifetime. Throws GlError.
[[nodiscard]] std::unique_ptr<Engine> makeGlesEngine(const StepSetup& setup);
[[nodiscard]] std::unique_ptr<Engine> makeSimdEngine(const StepSetup& setup);

}  // namespace mfar
