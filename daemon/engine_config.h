#pragma once

#include "pipeline/engine/engine.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mfar {

class TomlReader;

/// The configured engine of a step of the pipeline.
enum class EngineWish : std::uint8_t {
    Auto,  ///< mfard chooses the engine
    Gles,
    Simd
};
[[nodiscard]] std::optional<EngineWish> engineWish(std::string_view word);

/// Section [engine] of the configuration.
struct EngineConfig {
    EngineWish use = EngineWish::Auto;  ///< used for steps whose own value is Auto
    EngineWish still = EngineWish::Auto, pyramid = EngineWish::Auto, flow = EngineWish::Auto,
               weigh = EngineWish::Auto, detail = EngineWish::Auto, occlusion = EngineWish::Auto;

    /// Returns whether every step of the pipeline is set to SIMD, so that GLES is not needed.
    [[nodiscard]] bool isSimdAlone() const;
    /// Returns whether a step is set to GLES, so that GLES is required.
    [[nodiscard]] bool needsGles() const;
    bool operator==(const EngineConfig&) const = default;
};

/// Reads section [engine].
void readEngine(TomlReader& file, EngineConfig& engine);

/// Returns `decided`, except for the steps whose engine is configured: these get the configured
/// engine.
[[nodiscard]] EngineChoice withWishes(const EngineConfig& engine, EngineChoice decided);

/// Returns "simd" or "gles" if all steps run on that engine, otherwise a list of all steps: "still
/// gles, flow simd, ...".
[[nodiscard]] std::string describe(const EngineChoice& choice);
/// Returns the choice for which describe() returns this text, or nothing if there is none.
[[nodiscard]] std::optional<EngineChoice> parseEngineChoice(std::string_view text);

}  // namespace mfar
