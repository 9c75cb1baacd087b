// How far a stage has come, read off run.json and its first window.
#include "coupler/stage_progress.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "common/run_record.hpp"
#include "common/window_channel.hpp"

namespace coupler {
namespace {

namespace fs = std::filesystem;

TEST(StageProgress, CountsWindowsFromTheFirstOne) {
    std::string pattern = (fs::temp_directory_path() / "tsunagi_progress_XXXXXX").string();
    const fs::path folder = ::mkdtemp(pattern.data());
    StageProgress progress("cmps", folder, {.end = 3.0, .window = 0.5});
    progress.look();
    EXPECT_FALSE(progress.simulated_until());
    EXPECT_EQ(progress.describe(), "");

    common::RunRecord record(folder, "cmps");
    record.write_running();
    progress.look();
    EXPECT_FALSE(progress.simulated_until()) << "no window yet";

    common::Window first;
    first.stage = "cmps";
    first.t_begin = 1.25;
    first.t_end = 1.75;
    common::publish_window(folder, first);
    record.set_windows(1);
    record.write_running();
    progress.look();
    EXPECT_EQ(progress.simulated_until(), 1.75);
    EXPECT_EQ(progress.describe(), "t =   1.75 of 3.00 s");

    record.set_windows(4);
    record.write_ended("done");
    progress.look();
    EXPECT_EQ(progress.simulated_until(), 3.0) << "the last window is cut at the end";
    fs::remove_all(folder);
}

}  // namespace
}  // namespace coupler
