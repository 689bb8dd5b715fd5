#include "tests/measure/eval/dnn_peer.h"
#include "tests/measure/eval/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace mfar::eval {
namespace {

std::string lowerCase(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

}  // namespace

DnnModelName dnnModelNamed(const std::filesystem::path& file) {
    const std::string name = lowerCase(file.stem().string());
    for (const char* algorithm : {"edsr", "espcn", "fsrcnn", "lapsrn"})
        for (const int scale : {2, 3, 4, 8})
            if (name.starts_with(algorithm) && name.ends_with(fmt::format("_x{}", scale)))
                return {algorithm, scale};
    throw EvalError(
        fmt::format("{}: a model's file name must be EDSR, ESPCN, FSRCNN or LapSRN and its "
                    "factor, as in EDSR_x4.pb",
                    file.string()));
}

}  // namespace mfar::eval
