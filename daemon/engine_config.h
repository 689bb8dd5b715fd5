#pragma once

#include "pipeline/engine/engine.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mfar {

class TomlReader;

enum class EngineWish : std::uint8_t {
    Auto,  ///< mfard chooses the engine
    Gles,
    Simd
};
[[nodiscard]] std::optional<EngineWish> engineWish(std::string_view word);

struct EngineConfig {
    EngineWish use = EngineWish::Auto;  ///< for steps whose own value is Auto
    EngineWish still = EngineWish::Auto, pyramid = EngineWish::Auto, flow = EngineWish::Auto,
               weigh = EngineWish::Auto, detail = EngineWish::Auto, occlusion = EngineWish::Auto;

    [[nodiscard]] bool isSimdAlone() const;
    [[nodiscard]] bool needsGles() const;
    bool operator==(const EngineConfig&) const = default;
};

void readEngine(TomlReader& file, EngineConfig& engine);

/// Returns `decided`, except that steps whose engine is set in the configuration get that engine.
[[nodiscard]] EngineChoice withWishes(const EngineConfig& engine, EngineChoice decided);

/// Returns "simd" or "gles" if all steps run on one engine. Otherwise, returns the engine of each
/// step, e.g. "still gles, pyramid simd, flow simd, weigh simd, detail gles, occlusion gles".
[[nodiscard]] std::string describe(const EngineChoice& choice);
[[nodiscard]] std::optional<EngineChoice> parseEngineChoice(std::string_view text);

}  // namespace mfar
