#include "daemon/engine_config.h"

#include "daemon/toml_reader.h"

#include <fmt/format.h>

#include <array>
#include <span>
#include <utility>

namespace mfar {
namespace {

constexpr std::array<std::pair<std::string_view, EngineWish>, 3> kWishes = {
    {{"auto", EngineWish::Auto}, {"gles", EngineWish::Gles}, {"simd", EngineWish::Simd}}};

struct Step {
    std::string_view name;
    EngineWish EngineConfig::* wish;
    EngineKind EngineChoice::* kind;
};

constexpr std::array<Step, 6> kSteps = {
    {{"still", &EngineConfig::still, &EngineChoice::still},
     {"pyramid", &EngineConfig::pyramid, &EngineChoice::pyramid},
     {"flow", &EngineConfig::flow, &EngineChoice::flow},
     {"weigh", &EngineConfig::weigh, &EngineChoice::weigh},
     {"detail", &EngineConfig::detail, &EngineChoice::detail},
     {"occlusion", &EngineConfig::occlusion, &EngineChoice::occlusion}}};

EngineWish wishFor(const EngineConfig& engine, const Step& step) {
    const EngineWish own = engine.*(step.wish);
    return own != EngineWish::Auto ? own : engine.use;
}

}  // namespace

std::optional<EngineWish> engineWish(std::string_view word) {
    for (const auto& [name, wish] : kWishes)
        if (name == word) return wish;
    return std::nullopt;
}

bool EngineConfig::isSimdAlone() const {
    for (const Step& step : kSteps)
        if (wishFor(*this, step) != EngineWish::Simd) return false;
    return true;
}

bool EngineConfig::needsGles() const {
    for (const Step& step : kSteps)
        if (wishFor(*this, step) == EngineWish::Gles) return true;
    return false;
}

void readEngine(TomlReader& file, EngineConfig& engine) {
    file.choice<EngineWish>("engine.use", engine.use, kWishes);
    for (const Step& step : kSteps)
        file.choice<EngineWish>(fmt::format("engine.{}", step.name), engine.*(step.wish), kWishes);
}

EngineChoice withWishes(const EngineConfig& engine, EngineChoice decided) {
    for (const Step& step : kSteps) {
        const EngineWish wish = wishFor(engine, step);
        if (wish == EngineWish::Auto) continue;
        decided.*(step.kind) = wish == EngineWish::Gles ? EngineKind::Gles : EngineKind::Simd;
    }
    return decided;
}

std::string describe(const EngineChoice& choice) {
    for (const EngineKind kind : {EngineKind::Gles, EngineKind::Simd})
        if (choice == EngineChoice::all(kind)) return std::string(nameOf(kind));
    std::string out;
    for (const Step& step : kSteps)
        out +=
            fmt::format("{}{} {}", out.empty() ? "" : ", ", step.name, nameOf(choice.*(step.kind)));
    return out;
}

// Compares the text with the description of every possible choice. There are only 64.
std::optional<EngineChoice> parseEngineChoice(std::string_view text) {
    for (unsigned bits = 0; bits < 1U << kSteps.size(); ++bits) {
        EngineChoice choice;
        for (std::size_t i = 0; i < kSteps.size(); ++i)
            choice.*(kSteps[i].kind) = (bits >> i & 1U) != 0 ? EngineKind::Simd : EngineKind::Gles;
        if (describe(choice) == text) return choice;
    }
    return std::nullopt;
}

}  // namespace mfar
