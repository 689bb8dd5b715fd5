#include "daemon/control.h"
#include "tests/fuzz/target.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <string_view>

namespace {

using namespace mfar;
using nlohmann::ordered_json;

/// Set by the action `record`, which cannot report a fault by an exception: answerControl() catches
/// exceptions of actions.
bool recordsElsewhere = false;

/// True if a recording of this name would not be a visible folder in the folder of recordings. Does
/// not use isFolderName(), which is under test.
bool leadsElsewhere(std::string_view name) {
    return name.empty() || name.front() == '.' ||
           name.find_first_of(std::string_view("/\0", 2)) != name.npos;
}

ControlActions actions() {
    ControlActions out;
    out.status = [] { return ordered_json{{"state", "running\xff"}}; };
    out.stats = [] { return ordered_json{{"frames", 12}}; };
    out.snapshot = [](bool screen) {
        return ScreenPicture{
            {1, 1}, screen ? PixelFormat::Bgra8 : PixelFormat::Rgba8, {1, 2, 3, 4}};
    };
    out.reload = [] { return std::string("read again"); };
    out.record = [](const std::string& name) {
        recordsElsewhere = leadsElsewhere(name);
        return std::filesystem::path(name);
    };
    out.stopRecording = []() -> ordered_json { throw std::runtime_error("nothing is recorded"); };
    out.trigger = [] {};
    out.resetLearning = [] {};
    return out;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const ControlActions kActions = actions();
    recordsElsewhere = false;
    const ControlAnswer answer = answerControl(kActions, test::textOf(data, size));
    test::requireThat(!recordsElsewhere,
                      "a recording name that is not a single folder name was accepted");
    test::requireThat(answer.line.find('\n') == std::string::npos,
                      "the answer has more than one line");
    const auto body = nlohmann::json::parse(answer.line);
    test::requireThat(body.at("ok").is_boolean(), "the answer's \"ok\" is not true or false");
    test::requireThat(body.value("bytes", std::size_t{0}) == answer.data.size(),
                      "the answer's \"bytes\" differs from the number of bytes sent");
    return 0;
}
