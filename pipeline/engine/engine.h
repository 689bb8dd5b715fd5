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
    Simd   ///< the host's SIMD lanes
};
/// "gles", "simd".
[[nodiscard]] std::string_view nameOf(EngineKind kind);

/// Which engine does which step.
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
    /// All steps on the engine that the environment variable MFAR_ENGINE names, "simd" or "gles"
    /// (default): for measuring programs and tests, which name none.
    [[nodiscard]] static EngineChoice fromEnvironment();
    /// Does any step run there?
    [[nodiscard]] bool uses(EngineKind kind) const {
        return still == kind || pyramid == kind || flow == kind || weigh == kind ||
               detail == kind || occlusion == kind;
    }
    bool operator==(const EngineChoice&) const = default;
};

/// What steps are made for.
struct StepSetup {
    StereoRig rig;
    Size output;  ///< of the picture
    Flow2dOptions flow2d{};
    std::shared_ptr<Workers> workers{};
    Transfers* transfers = nullptr;  ///< counts what steps move; null: not counted
};

/// Makes the steps of one kind. Must outlive them.
class Engine {
public:
    virtual ~Engine() = default;
    [[nodiscard]] virtual std::unique_ptr<StillStep> still() = 0;
    [[nodiscard]] virtual std::unique_ptr<PyramidStep> pyramid() = 0;
    [[nodiscard]] virtual std::unique_ptr<FlowStep> flow() = 0;
    [[nodiscard]] virtual std::unique_ptr<WeighStep> weigh() = 0;
    [[nodiscard]] virtual std::unique_ptr<DetailStep> detail() = 0;
    [[nodiscard]] virtual std::unique_ptr<OcclusionStep> occlusion(Size layer) = 0;
    /// `layer`: the camera at the layer's resolution. What it draws lies where occlusion() reads
    /// it. Throws std::invalid_argument for an option out of range.
    [[nodiscard]] virtual std::unique_ptr<WarpStep> warp(const CameraModel& layer,
                                                         const WarpOptions& options) = 0;

    /// Prepares a new still for the steps that weigh and draw: frames allocate nothing for it.
    virtual void take(const StillPictures&) {}
    /// Lets the work begin that has been asked for.
    virtual void flush() {}
    /// Waits until it is done: for measurements.
    virtual void finish() {}
    /// The frame's memory is no longer read after this.
    virtual void finishReading() {}
    /// Reads cameras' memory without a copy; null: everything is uploaded. It must outlive this.
    virtual void setImporter(PlaneImporter*) {}
    /// Why zero-copy import failed; returned once.
    [[nodiscard]] virtual std::optional<std::string> takeImportFault() { return std::nullopt; }
};

/// Needs a current GL context for its whole life. Throws GlError.
[[nodiscard]] std::unique_ptr<Engine> makeGlesEngine(const StepSetup& setup);
[[nodiscard]] std::unique_ptr<Engine> makeSimdEngine(const StepSetup& setup);

}  // namespace mfar
