#include "daemon/control.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <gmock/gmock.h>
#include <stdexcept>

namespace mfar {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
using testing::HasSubstr;

struct Control : testing::Test {
    Control() {
        actions.status = [] { return ordered_json{{"state", "running"}}; };
        actions.stats = [] { return ordered_json{{"frames", 12}}; };
        actions.snapshot = [](bool screen) {
            return screen ? ScreenPicture{{1, 2}, PixelFormat::Bgra8, {3, 2, 1, 4, 7, 6, 5, 8}}
                          : ScreenPicture{{1, 1}, PixelFormat::Rgba8, {9, 8, 7, 6}};
        };
        actions.reload = [] { return "read again"; };
        actions.record = [this](const std::string& name) {
            recorded = name;
            return std::filesystem::path("/records") / name;
        };
        actions.stopRecording = [] { return ordered_json{{"video", 3}}; };
        actions.trigger = [this] { ++triggered; };
        actions.resetLearning = [this] { ++resets; };
    }
    json ask(std::string_view request) {
        answer = answerControl(actions, request);
        return json::parse(answer.line);
    }
    std::string errorOf(std::string_view request) {
        const json out = ask(request);
        EXPECT_EQ(out["ok"], false) << request;
        EXPECT_EQ(out.size(), 2U);
        EXPECT_TRUE(answer.data.empty());
        return out.value("error", "");
    }

    ControlActions actions;
    ControlAnswer answer;
    std::string recorded;
    int triggered = 0, resets = 0;
};

TEST_F(Control, ExecutesEveryCommand) {
    EXPECT_EQ(ask(R"({"command": "status"})"), (json{{"ok", true}, {"state", "running"}}));
    EXPECT_EQ(ask(R"({"command": "stats"})"), (json{{"ok", true}, {"frames", 12}}));
    EXPECT_EQ(ask(R"({"command": "reload"})"), (json{{"ok", true}, {"message", "read again"}}));
    EXPECT_EQ(ask(R"({"command": "trigger"})"), (json{{"ok", true}}));
    EXPECT_EQ(triggered, 1);
    EXPECT_EQ(ask(R"({"command": "learn", "reset": true})"), (json{{"ok", true}}));
    EXPECT_EQ(resets, 1);
    EXPECT_THAT(errorOf(R"({"command": "learn"})"), HasSubstr("needs \"reset\": true"));
    EXPECT_EQ(resets, 1);
    EXPECT_EQ(ask(R"({"command": "record", "name": "walk-1"})"),
              (json{{"ok", true}, {"folder", "/records/walk-1"}}));
    EXPECT_EQ(recorded, "walk-1");
    EXPECT_EQ(ask(R"({"command": "record", "stop": true})"), (json{{"ok", true}, {"video", 3}}));
}

TEST_F(Control, TheAnswerToSnapshotIsALineAndRgbaPixels) {
    json head = ask(R"({"command": "snapshot"})");
    EXPECT_EQ(head, (json{{"ok", true}, {"width", 1}, {"height", 1}, {"bytes", 4}}));
    EXPECT_EQ(answer.data, (std::vector<std::uint8_t>{9, 8, 7, 6}));
    head = ask(R"({"command": "snapshot", "screen": true})");
    EXPECT_EQ(head["height"], 2);
    EXPECT_EQ(answer.data, (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8}));
}

TEST_F(Control, InvalidRequestsGetOneError) {
    for (const char* text : {"", "status", "{", "[]", "7", "null", R"({"command": 7})", R"({})",
                             R"({"command": "status"} x)", "\xff\xfe", "{\"command\": \"status"})
        EXPECT_THAT(errorOf(text), HasSubstr("a request must be one line")) << text;
    EXPECT_THAT(errorOf(R"({"command": "explode"})"), HasSubstr("unknown command \"explode\""));
    EXPECT_THAT(errorOf(R"({"command": "status", "x": 1})"), HasSubstr("takes no argument \"x\""));
    EXPECT_THAT(errorOf(R"({"command": "snapshot", "screen": 1})"), HasSubstr("true or false"));
    EXPECT_THAT(errorOf(std::string(100, '[')), HasSubstr("a request must be one line"));
    EXPECT_THAT(errorOf(std::string(5000, ' ')), HasSubstr("longer than 4096"));
    EXPECT_THAT(errorOf("{\"command\": \"\xff\"}"), HasSubstr("a request must be one line"));
}

TEST_F(Control, ARecordingNameMustBeASimpleFolderName) {
    for (const char* request :
         {R"({"command": "record"})", R"({"command": "record", "name": "a", "stop": true})"})
        EXPECT_THAT(errorOf(request), HasSubstr("record needs")) << request;
    for (const char* name : {"", ".", "..", "../x", "/tmp/x", "a/b", ".hidden", "a b", "a\\nb"})
        EXPECT_THAT(errorOf(json{{"command", "record"}, {"name", name}}.dump()),
                    HasSubstr("a recording's name"))
            << name;
    EXPECT_THAT(errorOf(R"({"command": "record", "name": 7})"), HasSubstr("a recording's name"));
    EXPECT_FALSE(isFolderName(std::string(101, 'a')));
    EXPECT_EQ(errorOf(json{{"command", "record"}, {"name", std::string(101, 'a')}}.dump()),
              "a recording's name must have at most 100 characters, not 101");
    EXPECT_TRUE(isFolderName(std::string(100, 'a')));
    EXPECT_EQ(recorded, "");
}

TEST_F(Control, FailuresAreReported) {
    actions.trigger = [] { throw std::runtime_error("there is no trigger"); };
    EXPECT_EQ(errorOf(R"({"command": "trigger"})"), "there is no trigger");
    actions.status = [] { return ordered_json{{"source", "\xff camera"}}; };
    EXPECT_EQ(ask(R"({"command": "status"})")["ok"], true)
        << "a text that is not valid UTF-8 must not prevent the answer";
}

TEST_F(Control, AnObserverMayOnlyQueryStatusAndStats) {
    const auto asObserver = [&](std::string_view request) {
        return json::parse(answerControl(actions, request, ControlRole::Observer).line);
    };
    EXPECT_EQ(asObserver(R"({"command": "status"})")["ok"], true);
    EXPECT_EQ(asObserver(R"({"command": "stats"})")["ok"], true);
    for (const char* request :
         {R"({"command": "snapshot"})", R"({"command": "reload"})", R"({"command": "trigger"})",
          R"({"command": "learn", "reset": true})", R"({"command": "record", "name": "a"})",
          R"({"command": "record", "stop": true})"}) {
        const json out = asObserver(request);
        EXPECT_EQ(out["ok"], false) << request;
        EXPECT_THAT(out.value("error", ""), HasSubstr("members of group mfar-operators may"));
    }
    EXPECT_EQ(asObserver(R"({"command": "learn", "reset": true})")["error"],
              "only root, the user that runs mfard, and members of group mfar-operators may reset "
              "what was learned");
    EXPECT_EQ(recorded, "");
    EXPECT_EQ(triggered + resets, 0);
}

}  // namespace
}  // namespace mfar
