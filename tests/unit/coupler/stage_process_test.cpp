// A child process: its ending, its messages and its use of the machine.
#include "coupler/stage_process.hpp"

#include <gtest/gtest.h>
#include <signal.h>

#include "common/errors.hpp"

namespace coupler {
namespace {

std::vector<std::string> shell(const std::string& text) {
    return {"/bin/sh", "-c", text};
}

TEST(StageProcess, TellsExitStatusOutputAndMessages) {
    StageProcess process(shell("echo result; echo first >&2; echo last >&2; exit 3"));
    wait_for_end(process);
    EXPECT_EQ(process.ending().status, 3);
    EXPECT_EQ(process.ending().signal, 0);
    EXPECT_FALSE(process.ending().is_done());
    EXPECT_EQ(process.output(), "result\n");
    EXPECT_EQ(process.take_messages(), (std::vector<std::string>{"first", "last"}));
    EXPECT_TRUE(process.take_messages().empty());
}

TEST(StageProcess, KeepsALastLineWithoutItsEnd) {
    StageProcess process(shell("printf 'no newline' >&2"));
    wait_for_end(process);
    EXPECT_TRUE(process.ending().is_done());
    EXPECT_EQ(process.take_messages(), std::vector<std::string>{"no newline"});
}

TEST(StageProcess, TellsASignalFromAnExit) {
    StageProcess process(shell("kill -9 $$"));
    wait_for_end(process);
    EXPECT_EQ(process.ending().signal, SIGKILL);
    EXPECT_FALSE(process.ending().is_done());
    EXPECT_EQ(process.ending().describe(), "killed by signal 9 (Killed)");
}

TEST(StageProcess, PassesSignalsOn) {
    StageProcess process(shell("trap 'exit 130' INT; echo ready >&2; while :; do sleep 0.01; done"));
    while (process.take_messages().empty()) process.poll();
    process.send(SIGINT);
    wait_for_end(process);
    EXPECT_EQ(process.ending().status, 130);
}

TEST(StageProcess, ReadsMoreThanAPipeHolds) {
    StageProcess process(shell("head -c 300000 /dev/zero | tr '\\0' x; echo; exit 0"));
    wait_for_end(process);
    EXPECT_EQ(process.output().size(), 300001u);
}

TEST(StageProcess, MeasuresMemoryAndTime) {
    StageProcess process(shell("exec head -c 50000000 /dev/zero | tail -c 50000000 > /dev/null"));
    wait_for_end(process);
    EXPECT_GT(process.ending().wall_seconds, 0);
    EXPECT_GT(process.ending().peak_memory, 1e5);  // any process holds more than 100 kB
}

TEST(StageProcess, AProgramThatIsNotThereSaysSo) {
    StageProcess process({"/no/such/program"});
    wait_for_end(process);
    EXPECT_EQ(process.ending().status, common::exit_failed);
    EXPECT_EQ(process.take_messages(),
              std::vector<std::string>{"cannot start /no/such/program: No such file or directory"});
}

}  // namespace
}  // namespace coupler
