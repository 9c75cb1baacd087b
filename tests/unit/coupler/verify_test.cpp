// `coupler verify` on small folders: each kind of fault is found and named.
#include "coupler/verify.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "common/run_record.hpp"
#include "common/window_channel.hpp"

namespace coupler {
namespace {

namespace fs = std::filesystem;

/// A folder that goes with the test.
class Verify : public ::testing::Test {
 protected:
    Verify() {
        std::string pattern = (fs::temp_directory_path() / "tsunagi_verify_XXXXXX").string();
        folder_ = ::mkdtemp(pattern.data());
    }
    ~Verify() override { fs::remove_all(folder_); }

    common::Window window(std::int64_t index) const {
        const double begin = 0.5 * static_cast<double>(index);
        common::Window window;
        window.stage = "boussinesq";
        window.index = index;
        window.t_begin = begin;
        window.t_end = begin + 0.5;
        window.scene_digest = "scene";
        window.datasets = {{"/time", common::real64("s", {2}, {begin, begin + 0.5})},
                           {"/x", common::real64("m", {3}, {0, 1, 2})},
                           {"/still_water_depth", common::real64("m", {3}, {1, 1, 1})},
                           {"/surface_elevation", common::real32("m", {2, 3}, std::vector<float>(6, 0.1f))},
                           {"/velocity", common::real32("m/s", {2, 3}, std::vector<float>(6, 0.2f))}};
        return window;
    }
    void publish(const common::Window& window) const { common::publish_window(folder_, window); }
    void end_run(std::int64_t windows, double mass_drift = 0) const {
        common::RunRecord record(folder_, "boussinesq");
        record.set_digests("scene", "");
        record.set_windows(windows);
        record.set_invariant({.name = "mass drift", .value = mass_drift, .unit = "-", .bound = 0.02});
        record.write_ended("done");
    }
    /// Three sound windows and their run.json.
    void write_sound_run() const {
        for (std::int64_t index = 0; index < 3; ++index) publish(window(index));
        end_run(3);
    }
    void expect_fault(const std::string& text) const {
        const FolderReport report = verify_folder(folder_, "boussinesq");
        ASSERT_EQ(report.faults.size(), 1u) << ::testing::PrintToString(report.faults);
        EXPECT_NE(report.faults[0].find(text), std::string::npos) << report.faults[0];
    }
    fs::path path(std::int64_t index) const { return common::window_path(folder_, index); }

    fs::path folder_;
};

TEST_F(Verify, FindsASoundRunSound) {
    write_sound_run();
    const FolderReport report = verify_folder(folder_, "boussinesq");
    EXPECT_TRUE(report.faults.empty()) << report.faults[0];
    EXPECT_EQ(report.windows, 3);
    EXPECT_EQ(report.t_begin, 0);
    EXPECT_EQ(report.t_end, 1.5);
}

TEST_F(Verify, FindsAGapInTime) {
    write_sound_run();
    common::Window late = window(2);
    late.t_begin = 1.1;
    late.datasets.at("/time") = common::real64("s", {2}, {1.1, 1.5});
    publish(late);
    expect_fault("begins at 1.1 s, the window before it ends at 1 s");
}

TEST_F(Verify, FindsAWindowOfAnotherScene) {
    write_sound_run();
    common::Window other = window(1);
    other.scene_digest = "other";
    publish(other);
    expect_fault("window_000001.h5: comes from another scene");
}

TEST_F(Verify, FindsATruncatedWindow) {
    write_sound_run();
    fs::resize_file(path(1), fs::file_size(path(1)) - 1);
    expect_fault("window_000001.h5");  // and no second fault about the time it leaves open
}

TEST_F(Verify, FindsAMissingWindow) {
    write_sound_run();
    fs::remove(path(1));
    expect_fault("window_000001.h5: no such file");
}

TEST_F(Verify, FindsADatasetInOtherUnits) {
    write_sound_run();
    common::Window feet = window(0);
    feet.datasets.at("/x").unit = "ft";
    publish(feet);
    expect_fault("dataset /x has units 'ft', expected 'm'");
}

TEST_F(Verify, FindsAnInvariantOutOfItsBound) {
    write_sound_run();
    end_run(3, 0.03);
    expect_fault("invariant mass drift is 0.03 -, its bound is 0.02");
}

TEST_F(Verify, FindsARunThatIsNotDone) {
    write_sound_run();
    common::RunRecord record(folder_, "boussinesq");
    record.set_digests("scene", "");
    record.set_windows(3);
    record.write_ended("failed", "disk full");
    expect_fault("the run is not done but failed: disk full");
}

TEST_F(Verify, LooksAtFurtherRunsBesideTheChain) {
    const fs::path chain = folder_;
    folder_ = chain / "waves";
    fs::create_directory(folder_);
    write_sound_run();
    EXPECT_EQ(verify_chain(chain), 0);
    folder_ = chain / "waves_higher";
    fs::create_directory(folder_);
    write_sound_run();
    EXPECT_EQ(verify_chain(chain), 0);
    end_run(3, 0.03);
    EXPECT_EQ(verify_chain(chain), 1);
    folder_ = chain;
}

TEST_F(Verify, FindsBlocksOfAnotherFlow) {
    FolderReport flow, blocks;
    flow.stage = "cmps";
    flow.folder = "flow";
    flow.windows = blocks.windows = 1;
    flow.t_end = blocks.t_end = 1;
    flow.scene_digest = "a";
    blocks.folder = "blocks";
    blocks.input_digest = "b";
    verify_input(blocks, flow);
    ASSERT_EQ(blocks.faults.size(), 1u);
    EXPECT_NE(blocks.faults[0].find("was computed from other cmps windows"), std::string::npos);
}

TEST_F(Verify, FindsBlocksThatOutlastTheFlow) {
    FolderReport flow, blocks;
    flow.folder = "flow";
    flow.windows = blocks.windows = 1;
    flow.t_end = 1;
    blocks.t_end = 2;
    blocks.folder = "blocks";
    verify_input(blocks, flow);
    ASSERT_EQ(blocks.faults.size(), 1u);
    EXPECT_NE(blocks.faults[0].find("covers 0 to 2 s, its input in flow only 0 to 1 s"), std::string::npos);
}

}  // namespace
}  // namespace coupler
