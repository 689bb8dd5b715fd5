#include "daemon/tools/command_failure.h"
#include "daemon/tools/ctl_arguments.h"

#include <gmock/gmock.h>

namespace mfar {
namespace {

using testing::HasSubstr;

std::string messageOf(const std::string& arguments) {
    CtlParser parser;
    try {
        parser.app.parse(arguments);
        return "";
    } catch (const CLI::ParseError& error) {
        return commandFailure(&parser.app, error);
    }
}

TEST(CommandFailure, AnUnknownCommandIsNamedWithTheValidOnes) {
    EXPECT_EQ(messageOf("explode"),
              "mfarctl: unknown command 'explode'; expected one of status, stats, reload, trigger, "
              "snapshot, record, learn\nRun with --help for more information.\n");
}

TEST(CommandFailure, AnUnknownSubcommandIsNamedWithTheValidOnes) {
    EXPECT_THAT(messageOf("learn much"),
                HasSubstr("learn: unknown command 'much'; expected one of reset\n"));
}

TEST(CommandFailure, AMissingCommandIsReported) {
    EXPECT_THAT(messageOf(""), HasSubstr("mfarctl: a command is missing; expected one of status"));
}

TEST(CommandFailure, OtherFaultsKeepTheMessageOfTheParser) {
    EXPECT_THAT(messageOf("snapshot"), HasSubstr("FILE is required"));
    EXPECT_THAT(messageOf("status now"), HasSubstr("not expected: now"));
}

TEST(CommandFailure, ASnapshotWhoseNameIsNotThatOfAPngFileIsRefused) {
    for (const char* name : {"first.jpg", "first", "first.png.part"})
        EXPECT_THAT(messageOf(std::string("snapshot ") + name), HasSubstr("must end with .png"));
    for (const char* name : {"first.png", "a/FIRST.PNG", "-", "/dev/stdout", "/dev/null"})
        EXPECT_EQ(messageOf(std::string("snapshot ") + name), "") << name;
}

}  // namespace
}  // namespace mfar
