#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include "common/errors.hpp"
#include "common/output_folder.hpp"
#include "common/run_record.hpp"
#include "common/window_channel.hpp"
#include "tests/unit/common/temporary_folder.hpp"

using namespace common;
namespace fs = std::filesystem;

namespace {

Window sample_window(std::int64_t index) {
    Window window;
    window.stage = "boussinesq";
    window.index = index;
    window.t_begin = static_cast<double>(index);
    window.t_end = window.t_begin + 1;
    window.scene_digest = "abc";
    const double t = window.t_begin;
    window.datasets["/time"] = real64("s", {3}, {t, t + 0.5, t + 1});
    window.datasets["/x"] = real64("m", {2}, {0.0, 0.1});
    window.datasets["/surface_elevation"] = real32("m", {3, 2}, std::vector<float>{0, 1, 2, 3, 4, 5});
    window.datasets["/velocity"] = real32("m/s", {3, 2}, std::vector<float>(6));
    return window;
}

const std::vector<ExpectedDataset> expected = {
    {"/time", "s", {"nt"}}, {"/x", "m", {"nx"}}, {"/surface_elevation", "m", {"nt", "nx"}}};

template <class Body>
std::string input_error(const Body& body) {
    try {
        body();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no InputError";
}

bool holds(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

void flip_bit(const fs::path& path, const std::string& near) {
    std::fstream stream(path, std::ios::in | std::ios::out | std::ios::binary);
    std::string content((std::istreambuf_iterator<char>(stream)), {});
    const auto at = content.find(near);
    ASSERT_NE(at, std::string::npos);
    stream.seekp(static_cast<std::streamoff>(at));
    stream.put(static_cast<char>(content[at] ^ 1));
}

}  // namespace

TEST(DataFile, RoundTripKeepsEveryBit) {
    const TemporaryFolder folder;
    const fs::path path = folder.path / "state.h5";
    DataFile file;
    file.attributes = {{"word", std::string("text")}, {"number", 0.1}, {"whole", std::int64_t{-7}}};
    file.datasets["/a/b"] = real64("m/s", {2, 2}, {0.1, -0.0, 1e-310, 3});
    file.datasets["/c"] = integer32("-", {3}, {1, -2, 3});
    file.datasets["/d"] = unsigned64({1}, {0xffffffffffffffffull});
    file.datasets["/empty"] = real64("m", {0, 3}, {});
    write_data_file(path, file);
    const DataFile back = read_data_file(path);
    EXPECT_EQ(back.text("word"), "text");
    EXPECT_EQ(back.number("number"), 0.1);
    EXPECT_EQ(back.integer("whole"), -7);
    EXPECT_EQ(back.at("/a/b").doubles(), file.at("/a/b").doubles());
    EXPECT_TRUE(std::signbit(back.at("/a/b").doubles()[1]));
    EXPECT_EQ(back.at("/a/b").unit, "m/s");
    EXPECT_EQ(back.at("/c").integers(), file.at("/c").integers());
    EXPECT_EQ(back.at("/d").words(), file.at("/d").words());
    EXPECT_EQ(back.at("/empty").shape, (std::vector<std::size_t>{0, 3}));
}

TEST(DataFile, SameContentGivesSameBytes) {
    const TemporaryFolder folder;
    const auto bytes = [](const fs::path& path) {
        std::ifstream stream(path, std::ios::binary);
        return std::string((std::istreambuf_iterator<char>(stream)), {});
    };
    publish_window(folder.path, sample_window(0));
    const std::string first = bytes(window_path(folder.path, 0));
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // times of day in HDF5 count whole seconds
    publish_window(folder.path, sample_window(0));
    EXPECT_EQ(first, bytes(window_path(folder.path, 0)));
}

TEST(DataFile, WriteFailureIsARunErrorAndLeavesNothing) {
    const TemporaryFolder folder;
    EXPECT_THROW(write_data_file(folder.path / "absent" / "a.h5", {}), RunError);
    EXPECT_TRUE(fs::is_empty(folder.path));
}

TEST(WindowChannel, RoundTrip) {
    const TemporaryFolder folder;
    publish_window(folder.path, sample_window(0));
    const Window back = read_window(window_path(folder.path, 0), "boussinesq", expected);
    EXPECT_EQ(back.t_end, 1);
    EXPECT_EQ(back.at("/surface_elevation").floats(), sample_window(0).at("/surface_elevation").floats());
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path), {}), 1) << "a temporary file was left";
}

TEST(WindowChannel, TruncationAtAnyLengthIsNoticed) {
    const TemporaryFolder folder;
    Window window =
        sample_window(0);  // with enough values for spare space at the end of the file, were there any
    window.datasets["/more"] = real32("m", {5000}, std::vector<float>(5000, 1));
    publish_window(folder.path, window);
    const fs::path path = window_path(folder.path, 0);
    for (auto size = fs::file_size(path); size > 0;) {
        size -= std::min<std::uintmax_t>(size, size % 64 == 0 ? 61 : 1);
        fs::resize_file(path, size);
        EXPECT_TRUE(holds(input_error([&] { read_window(path, "boussinesq", expected); }), path.string()))
            << size;
    }
}

TEST(WindowChannel, FlippedBitInTheDataIsNoticed) {
    const TemporaryFolder folder;
    publish_window(folder.path, sample_window(0));
    const fs::path path = window_path(folder.path, 0);
    const float five = 5;
    flip_bit(path, std::string(reinterpret_cast<const char*>(&five), sizeof five));
    const std::string message = input_error([&] { read_window(path, "boussinesq", expected); });
    EXPECT_TRUE(holds(message, "/surface_elevation") && holds(message, "damaged")) << message;
}

TEST(WindowChannel, WrongSchemaUnitShapeAndTimesAreNamed) {
    const TemporaryFolder folder;
    const auto fault = [&](const auto& change) {
        Window window = sample_window(0);
        change(window);
        write_data_file(window_path(folder.path, 0),
                        {.attributes = {{"schema", "tsunagi." + window.stage + ".window/1"},
                                        {"stage", window.stage},
                                        {"index", window.index},
                                        {"t_begin", window.t_begin},
                                        {"t_end", window.t_end},
                                        {"scene_digest", window.scene_digest},
                                        {"input_digest", window.input_digest}},
                         .datasets = window.datasets});
        return input_error([&] { read_window(window_path(folder.path, 0), "boussinesq", expected); });
    };
    EXPECT_TRUE(holds(fault([](Window& w) { w.stage = "cmps"; }), "schema is 'tsunagi.cmps.window/1'"));
    EXPECT_TRUE(holds(fault([](Window& w) { w.index = 4; }), "holds window 4"));
    EXPECT_TRUE(holds(fault([](Window& w) { w.datasets.erase("/x"); }), "dataset /x is missing"));
    EXPECT_TRUE(
        holds(fault([](Window& w) { w.datasets["/x"].unit = "cm"; }), "/x has units 'cm', expected 'm'"));
    EXPECT_TRUE(holds(fault([](Window& w) { w.datasets["/x"] = real64("m", {3}, {0, 1, 2}); }), "has shape"));
    EXPECT_TRUE(holds(fault([](Window& w) {
                          w.datasets["/time"] = real64("s", {3}, {0, 0.6, 0.5});
                      }),
                      "/time does not increase at element 2"));
    EXPECT_TRUE(holds(fault([](Window& w) {
                          w.datasets["/time"] = real64("s", {3}, {0, 0.6, 1.5});
                      }),
                      "/time leaves the window"));
    EXPECT_TRUE(holds(fault([](Window& w) {
                          w.datasets["/x"] = real64("m", {2}, {0, NAN});
                      }),
                      "/x is not finite at element 1"));
}

TEST(WindowChannel, GarbageIsNeverPublished) {
    const TemporaryFolder folder;
    Window window = sample_window(0);
    window.datasets["/x"] = real64("m", {2}, {0, INFINITY});
    EXPECT_THROW(publish_window(folder.path, window), RunError);
    EXPECT_TRUE(fs::is_empty(folder.path));
}

TEST(WindowReader, EndsWhereWindowsEnd) {
    const TemporaryFolder folder;
    publish_window(folder.path, sample_window(0));
    WindowReader reader(folder.path, "boussinesq", expected, false);
    EXPECT_TRUE(reader.receive(0));
    EXPECT_FALSE(reader.receive(1));
    EXPECT_EQ(reader.index_at(0.5), 0);
    EXPECT_FALSE(reader.index_at(1.5));
    EXPECT_FALSE(reader.index_at(1 - 1e-15));  // the end of a window but for the last bit
    EXPECT_EQ(reader.available_until(), 1);
}

TEST(WindowReader, GapAndForeignWindowAreNamed) {
    const TemporaryFolder folder;
    publish_window(folder.path, sample_window(0));
    publish_window(folder.path, sample_window(2));
    WindowReader reader(folder.path, "boussinesq", expected, false);
    EXPECT_TRUE(reader.receive(0));
    EXPECT_TRUE(
        holds(input_error([&] { reader.receive(1); }), "window_000001.h5: missing, although later windows"));
    Window foreign = sample_window(1);
    foreign.scene_digest = "other";
    publish_window(folder.path, foreign);
    EXPECT_TRUE(holds(input_error([&] { reader.receive(1); }), "comes from another scene"));
}

TEST(WindowReader, EmptyFolderIsNamed) {
    const TemporaryFolder folder;
    WindowReader reader(folder.path, "boussinesq", expected, false);
    EXPECT_TRUE(holds(input_error([&] { reader.first(); }), "holds no windows of boussinesq"));
    WindowReader absent(folder.path / "none", "boussinesq", expected, false);
    EXPECT_TRUE(holds(input_error([&] { absent.first(); }), "no such folder"));
}

TEST(WindowReader, FollowsAStageThatIsStillWriting) {
    const TemporaryFolder folder;
    RunRecord record(folder.path, "boussinesq");
    record.write_running();
    std::jthread writer([&] {
        for (std::int64_t k = 0; k < 3; ++k) {
            std::this_thread::sleep_for(std::chrono::milliseconds(30));
            publish_window(folder.path, sample_window(k));
        }
        record.write_ended("done");
    });
    WindowReader reader(folder.path, "boussinesq", expected, true);
    std::int64_t received = 0;
    while (reader.receive(received)) ++received;
    EXPECT_EQ(received, 3);
}

TEST(WindowReader, StopsWhenTheFollowedStageFailed) {
    const TemporaryFolder folder;
    RunRecord(folder.path, "boussinesq").write_ended("failed", "blew up at t = 3 s");
    WindowReader reader(folder.path, "boussinesq", expected, true);
    try {
        reader.receive(0);
        FAIL() << "no error";
    } catch (const RunError& error) {
        EXPECT_TRUE(holds(error.what(), "blew up at t = 3 s")) << error.what();
    }
}

TEST(OutputFolder, GoesOnFromItsStateOnlyWhenAskedAndOnlyForTheSameScene) {
    const TemporaryFolder folder;
    const RunIdentity identity{"boussinesq", "abc", ""};
    {
        OutputFolder out(folder.path, identity, false);
        EXPECT_EQ(out.start(), OutputFolder::Start::fresh);
        DataFile state;
        state.attributes["step"] = std::int64_t{42};
        out.publish(sample_window(0), state);
        EXPECT_TRUE(
            holds(input_error([&] { OutputFolder second(folder.path, identity, false); }), "another run"));
    }
    {
        OutputFolder out(folder.path, identity, true);
        EXPECT_EQ(out.start(), OutputFolder::Start::go_on);
        EXPECT_EQ(out.next_window(), 1);
        EXPECT_EQ(out.state().integer("step"), 42);
    }
    EXPECT_TRUE(holds(input_error([&] {
                          OutputFolder out(folder.path, {"boussinesq", "xyz", ""}, true);
                      }),
                      "belongs to another scene"));
    RunRecord record(folder.path, "boussinesq");
    record.set_windows(1);
    record.write_ended("done");
    EXPECT_EQ(OutputFolder(folder.path, identity, false).start(), OutputFolder::Start::nothing_to_do);
    EXPECT_TRUE(holds(input_error([&] {
                          OutputFolder other(folder.path, {"dem", "abc", ""}, false);
                      }),
                      "holds a run of boussinesq"));
    EXPECT_TRUE(fs::exists(window_path(folder.path, 0))) << "another stage's window was removed";
    std::ofstream(folder.path / "notes.txt") << "the user's";
    EXPECT_EQ(OutputFolder(folder.path, {"boussinesq", "xyz", ""}, false).start(),
              OutputFolder::Start::fresh);
    EXPECT_FALSE(fs::exists(window_path(folder.path, 0)));
    EXPECT_TRUE(fs::exists(folder.path / "notes.txt")) << "a file that is not ours was removed";
}

TEST(OutputFolder, SweepsWhatAKilledWriterLeft) {
    const TemporaryFolder folder;
    std::ofstream(folder.path / ".window_000000.h5.123.tmp") << "half";
    OutputFolder out(folder.path, {"boussinesq", "abc", ""}, false);
    EXPECT_FALSE(fs::exists(folder.path / ".window_000000.h5.123.tmp"));
}

TEST(RunRecord, StatusIsReadBack) {
    const TemporaryFolder folder;
    EXPECT_EQ(read_upstream_status(folder.path).state, UpstreamStatus::State::absent);
    RunRecord record(folder.path, "cmps");
    record.add_window();
    record.write_running();
    EXPECT_EQ(read_upstream_status(folder.path).state, UpstreamStatus::State::running);
    record.set_invariant({"mass_drift", std::nan(""), "-", 0.02});
    record.set_invariant({"water balance", 0.0, "-", 1e-9});
    testing::internal::CaptureStderr();
    record.write_ended("interrupted");
    const std::string told = testing::internal::GetCapturedStderr();
    EXPECT_TRUE(holds(told, "cmps: warning: mass_drift is null -, bound 0.02")) << told;
    EXPECT_FALSE(holds(told, "water balance")) << told;
    const auto status = read_upstream_status(folder.path);
    EXPECT_EQ(status.state, UpstreamStatus::State::interrupted);
    EXPECT_EQ(status.windows, 1);
    std::ifstream stream(folder.path / "run.json");
    const std::string text((std::istreambuf_iterator<char>(stream)), {});
    EXPECT_TRUE(holds(text, "\"value\": null") && holds(text, "\"holds\": false")) << text;
}

TEST(OutputFolder, ADamagedFinishedRunIsComputedAgain) {
    const TemporaryFolder folder;
    const RunIdentity identity{"boussinesq", "abc", ""};
    OutputFolder(folder.path, identity, false).publish(sample_window(0), {});
    RunRecord record(folder.path, "boussinesq");
    record.set_windows(1);
    record.write_ended("done");
    fs::resize_file(window_path(folder.path, 0), 100);
    EXPECT_EQ(OutputFolder(folder.path, identity, false).start(), OutputFolder::Start::fresh);
}
