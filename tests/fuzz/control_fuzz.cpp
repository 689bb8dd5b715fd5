#include "daemon/control.h"
#include "tests/fuzz/target.h"

#include <nlohmann/json.hpp>

#include <filesystem>

namespace {

using namespace mfar;
using nlohmann::ordered_json;

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
        test::requireThat(isFolderName(name) && name.find('/') == name.npos,
                          "a recording name that is not a single folder name was accepted");
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
    const ControlAnswer answer = answerControl(kActions, test::textOf(data, size));
    test::requireThat(answer.line.find('\n') == std::string::npos,
                      "the answer has more than one line");
    const auto body = nlohmann::json::parse(answer.line);
    test::requireThat(body.at("ok").is_boolean(), "the answer's \"ok\" is not true or false");
    test::requireThat(body.value("bytes", std::size_t{0}) == answer.data.size(),
                      "the answer's \"bytes\" differs from the number of bytes sent");
    return 0;
}
