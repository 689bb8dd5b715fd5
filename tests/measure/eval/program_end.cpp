#include "tests/measure/eval/program_end.h"

#include "daemon/exit_code.h"
#include "hal/virtual/image_files.h"
#include "hal/virtual/recording.h"
#include "pipeline/track/tag_map.h"
#include "tests/measure/eval/report.h"

#include <fmt/format.h>

#include <stdexcept>

namespace mfar::eval {
namespace {

template <class... Errors>
bool isOneOf(const std::exception& error) {
    return ((dynamic_cast<const Errors*>(&error) != nullptr) || ...);
}

}  // namespace

int endedBy(const std::exception& error, std::string_view program) {
    fmt::print(stderr, "{}: {}\n", program, error.what());
    return isOneOf<EvalError, RecordingError, TagMapError, ImageFileError, Failure,
                   std::invalid_argument>(error)
               ? kWrongInput
               : 1;
}

}  // namespace mfar::eval
